"""Pickle of worlds, saved states and findings: their C++ parts as bytes. Importing this makes them known to `pickle`."""
from __future__ import annotations

import copyreg
from typing import Any

from . import _core


def model_of(data: bytes) -> _core.Model:
    """The compiled world of its bytes. Raises WorldError if they are damaged, or of another version."""
    return _core.model_of(data)


def save_of(model: _core.Model, tick: int, seed: int, given: int, states: bytes, orders: bytes,
            check: int) -> _core.Save:
    """The saved state of its parts. Raises SaveError if they are damaged, or of another version."""
    return _core.save_of(model, tick, seed, given, states, orders, check)


def finding_of(*parts: Any) -> _core.Diagnostic:
    """The finding of its parts."""
    return _core.Diagnostic(*parts)


def _parts_of(finding: _core.Diagnostic) -> tuple[Any, ...]:
    return (finding.severity, finding.file, finding.line, finding.code, finding.message, finding.remedy)


copyreg.pickle(_core.Model, lambda model: (model_of, (_core.model_bytes(model),)))
copyreg.pickle(_core.Save, lambda save: (save_of, save.parts()))
copyreg.pickle(_core.Diagnostic, lambda finding: (finding_of, _parts_of(finding)))
