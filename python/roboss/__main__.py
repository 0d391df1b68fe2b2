"""The command `roboss`: `python -m roboss run WORLD`, or `roboss run WORLD` where the package is installed.

It is the program of docs/command-line.md, with the same options, output and exit codes: this process becomes that one.
The commands `record`, `plot`, `analyse` and `calibrate` are Python (roboss.analysis) and run here.
The viewer's page lies beside it, in program/share/roboss/web.
"""
from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import NoReturn

ANALYSIS = ("record", "plot", "analyse", "calibrate")
PROGRAM = Path(__file__).parent / "program" / "bin" / "roboss"


def main() -> NoReturn:
    """Becomes the program, with the arguments of this process."""
    words = sys.argv[1:]
    if words[:1] == ["help"] and words[1:2] and words[1] in ANALYSIS:
        words = [words[1], "--help"]
    if words[:1] and words[0] in ANALYSIS:
        from .analysis.command import main as analyse
        analyse(words)
    try:
        os.execv(PROGRAM, ["roboss", *sys.argv[1:]])
    except OSError as error:
        sys.exit(f"roboss: {PROGRAM} cannot be started: {error.strerror}\n  remedy: install the package again, on a file "
                 "system that allows programs (no 'noexec')")


if __name__ == "__main__":
    main()
