"""Files that functions and commands write: none replaces an input or a file of another kind."""
from __future__ import annotations

import os
from pathlib import Path
from typing import Iterable, Optional, Union

from . import _core
from .errors import ArgumentError
from .names import file_path

_Path = Union[str, os.PathLike]
#: Kinds of files by the endings of their names.
KINDS = {".csv": "table", ".parquet": "parquet", ".mcap": "mcap", ".rrd": "rrd", ".png": "png", ".svg": "svg", ".pdf": "pdf",
         ".html": "html"}


def check_output(path: _Path, kind: Optional[str] = None, reads: Iterable[object] = ()) -> None:
    """Refuses a file to write that is read, too (also by a link), or that exists and is of another kind. A folder, and a file
    whose kind is not known, must be new.

    Args:
        kind: what is written; None: what the ending of its name says.
        reads: paths of inputs; what is no path is ignored.

    Raises:
        ArgumentError: codes "output-is-input", "other-kind", "output-exists".
    """
    path = file_path("path", path)
    kind = kind or KINDS.get(Path(path).suffix.lower())
    if os.path.isdir(path) or (kind is None and os.path.isfile(path)):
        raise ArgumentError(f"'{path}' exists and is " + ("a folder" if os.path.isdir(path) else "a file of another kind"),
                            "name a new one, or remove it yourself", "output-exists")
    if kind is not None:
        _core.check_output(path, kind, [os.fspath(read) for read in reads if isinstance(read, (str, os.PathLike))])
