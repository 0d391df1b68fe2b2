"""The commands `roboss record`, `plot`, `analyse` and `calibrate` (docs/analysis.md)."""
from __future__ import annotations

import argparse
import difflib
import json
import sys
import time
from pathlib import Path
from typing import Any, Iterable, NoReturn, Optional, Sequence

from ..errors import ArgumentError, RobossError
from ..outputs import check_output

OK, BAD_INPUT, WRONG_USAGE, FAILED, INTERRUPTED = 0, 1, 2, 3, 130  # docs/command-line.md
_EXIT_CODES = """Exit codes: 0 done, 1 an input is wrong or missing, 2 wrong usage, 3 the run failed or a file cannot be written,
130 interrupted by Ctrl-C."""


class Parser(argparse.ArgumentParser):
    """A parser whose errors look like those of the program."""

    def __init__(self, *args: Any, examples: str = "", **options: Any):
        super().__init__(*args, epilog=f"{examples}\n\n{_EXIT_CODES}" if examples else None,
                         formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False, **options)

    def error(self, message: str) -> NoReturn:
        if message.startswith("unrecognized arguments: "):
            word = message.split(": ", 1)[1].split()[0]
            known = [option for action in self._actions for option in action.option_strings]
            near = difflib.get_close_matches(word.split("=")[0], known, n=1)
            remedy = f"did you mean '{near[0]}'?" if near else f"see `{self.prog} --help`"
            message = f"'{self.prog}' has no option '{word}'" if word.startswith("-") else \
                f"'{self.prog}' does not expect '{word}'"
        else:
            remedy = f"see `{self.prog} --help`"
        complain(message, "wrong-usage", remedy)
        sys.exit(WRONG_USAGE)


class Progress:
    """Lines on standard error, at most one per second."""

    def __init__(self, command: str, quiet: bool):
        self._command, self._quiet, self._last = command, quiet, time.monotonic()

    def __call__(self, text: str) -> None:
        now = time.monotonic()
        if not self._quiet and now - self._last >= 1:
            self._last = now
            print(f"roboss {self._command}: {text}", file=sys.stderr, flush=True)

    def note(self, text: str) -> None:
        """A line that is not left out but by --quiet."""
        if not self._quiet:
            print(f"roboss {self._command}: {text}", file=sys.stderr, flush=True)

    def note_if(self, text: str) -> None:
        """A note, if there is something to say."""
        if text:
            self.note(text)


def complain(message: str, code: str = "", remedy: str = "") -> None:
    """Prints an error as the program does."""
    print(f"roboss: {message}" + (f" [{code}]" if code else "") + (f"\n  remedy: {remedy}" if remedy else ""), file=sys.stderr)


def check_file(path: str, kind: Optional[str] = None, reads: Iterable[object] = ()) -> None:
    """Refuses a file to write whose folder does not exist, or that check_output() refuses, before anything is computed."""
    if not Path(path).absolute().parent.is_dir():
        raise ArgumentError(f"there is no folder for '{path}'", "make it, or choose another one", "no-file")
    check_output(path, kind, reads)


def main(arguments: Sequence[str]) -> NoReturn:
    """Runs `roboss ARGUMENTS`; the first names the command. Ends the process."""
    from . import analyse_command, calibrate_command, plot_command, record_command
    command = {"record": record_command, "plot": plot_command, "analyse": analyse_command,
               "calibrate": calibrate_command}[arguments[0]]
    try:
        parser = command.parser()  # names of variables may stand behind options; kinds of reports do not go with that
        parse = parser.parse_args if command in (analyse_command, calibrate_command) else parser.parse_intermixed_args
        options = parse(list(arguments[1:]))
        result = command.run(options)
        if options.json:
            print(json.dumps(result, indent=2))
        sys.exit(OK)
    except KeyboardInterrupt:
        sys.exit(INTERRUPTED)
    except BrokenPipeError:
        sys.exit(OK)
    except RobossError as error:
        complain(error.message, error.code, error.remedy)
        sys.exit(FAILED if error.code in ("run-failed", "not-finite") else BAD_INPUT)
    except ModuleNotFoundError as error:
        complain(f"the Python package '{error.name}' is missing", "no-package",
                 "pip install pyarrow mcap matplotlib scipy, or roboss with its extra: roboss[analysis]")
        sys.exit(BAD_INPUT)
    except OSError as error:
        what = f"'{error.filename}': {error.strerror}" if error.filename else str(error)  # pyarrow gives no file name
        complain(what, "cannot-write", "choose another file or folder")
        sys.exit(FAILED)
