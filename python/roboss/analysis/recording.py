"""Recording: variables of a run over time, as tables; what `roboss record` writes and `plot` and `analyse` read."""
from __future__ import annotations

import functools
import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Iterable, Mapping, Optional, Sequence, Union

import numpy as np

from ..errors import ArgumentError, RobossError
from ..names import file_path, unknown
from ..outputs import check_output
from ..robots import Floats

if TYPE_CHECKING:
    from ..run import Run
    from .csv_file import CsvWriter
    from .mcap_file import McapWriter
    from .messages import MessageVariable
    from .parquet_file import ParquetWriter
    from .rerun_file import RerunWriter

SUFFIXES = (".parquet", ".mcap", ".csv")  # that are written and read
WRITTEN = (*SUFFIXES, ".rrd")             # that are written
_RERUN = "pip install 'rerun-sdk>=0.41', or roboss with its extra: roboss[rerun]"
#: Parts of poses and twists, with their units.
POSE = (("x", "m"), ("y", "m"), ("z", "m"), ("qx", ""), ("qy", ""), ("qz", ""), ("qw", ""))
TWIST = (("vx", "m/s"), ("vy", "m/s"), ("vz", "m/s"), ("wx", "rad/s"), ("wy", "rad/s"), ("wz", "rad/s"))


@dataclass(frozen=True)
class Column:
    """A column of numbers.

    Attributes:
        name: "car_3.pose.x".
        variable: what it is a part of: "car_3.pose".
        unit: "m", "rad/s"; "" for ratios, counts, parts of quaternions.
        frame: in whose axes it is: "world", or "".
    """

    name: str
    variable: str
    unit: str = ""
    frame: str = ""


class Recording:
    """Columns of numbers over time.

    Attributes:
        time: (T,), s, ascending.
        columns: descriptions of the columns, in their order.
        values: (T, columns).
        facts: what else is known: "world", "world_hash", "dt", "source", "mass_kg" (by robot), "gravity".
        messages: names of variables of the file that hold messages (images, contact points); they have no columns here.

    >>> recording = roboss.analysis.record(roboss.example("crossroads.sdf"), ["car_3.speed", "car_3.pose"], until=0.1)
    >>> recording["car_3.speed"].shape, recording["car_3.pose"].shape, recording["car_3.pose.z"].shape
    ((11,), (11, 7), (11,))
    """

    def __init__(self, time: Floats, columns: Sequence[Column], values: Floats, facts: Union[dict[str, Any], None] = None,
                 messages: Sequence[str] = ()):
        self.time, self.columns, self.values, self.facts = time, tuple(columns), values, dict(facts or {})
        self.messages = tuple(messages)
        if values.shape != (len(time), len(self.columns)):
            raise ArgumentError(f"values of shape {values.shape} for {len(time)} times and {len(self.columns)} columns",
                                code="bad-shape")

    @property
    def variables(self) -> tuple[str, ...]:
        """Names of the variables, in the order of their columns."""
        return tuple(dict.fromkeys(column.variable for column in self.columns))

    def select(self, patterns: Union[str, Iterable[str]]) -> list[int]:
        """Numbers of the columns of variables, or single columns, that match one of the patterns (`*`, `?`, `[...]`, `**`).

        Raises UnknownNameError where a pattern matches none, ArgumentError where it matches only messages (code "no-numbers").
        """
        found: dict[int, None] = {}
        for pattern in [patterns] if isinstance(patterns, str) else patterns:
            some = [number for number, column in enumerate(self.columns) if matches(pattern, column)]
            if not some:
                raise self._missing(pattern)
            found.update(dict.fromkeys(some))
        return list(found)

    def __getitem__(self, name: str) -> Floats:
        """(T,) of a column or of a variable of one column, (T, columns) of a variable of several."""
        numbers = [number for number, column in enumerate(self.columns) if name in (column.name, column.variable)]
        if not numbers:
            raise self._missing(name)
        return self.values[:, numbers[0]] if len(numbers) == 1 else self.values[:, numbers]

    def _missing(self, pattern: str) -> RobossError:
        """The exception: no column matches."""
        for name in self.messages:
            if matches(pattern, Column(name, name)):
                return ArgumentError(f"'{name}' holds messages, not numbers", "leave it out; pyarrow and mcap read messages",
                                     "no-numbers")
        return unknown("variable", pattern, self.variables)

    def __contains__(self, name: str) -> bool:
        return any(name in (column.name, column.variable) for column in self.columns)

    def __repr__(self) -> str:
        return f"<roboss.analysis.Recording: {len(self.variables)} variables, {len(self.time)} times>"


def matches(pattern: str, column: Column) -> bool:
    """Whether the pattern names the column, or the variable that it is a part of. `*` and `?` stop at dots, `**` does not.

    >>> speed, pose = Column("car_3.odometer.speed", "car_3.odometer.speed"), Column("car_3.pose.x", "car_3.pose")
    >>> [matches(pattern, speed) for pattern in ("car_*.speed", "car_3.*.speed", "car_3.**", "**.speed")]
    [False, True, True, True]
    >>> [matches(pattern, pose) for pattern in ("*.pose", "car_[1-4].pose.?", "car_3.*", "car_3")]
    [True, True, True, False]
    """
    found = _expression(pattern)
    return found(column.variable) is not None or found(column.name) is not None


def matches_path(pattern: str, name: str) -> bool:
    """Whether the pattern names a topic. `*` and `?` stop at slashes, `**` does not.

    >>> [matches_path(pattern, "/car_3/front/scan") for pattern in ("/car_*/*", "/car_3/**", "**/scan", "/car_3/front/s?an")]
    [False, True, True, True]
    """
    return _expression(pattern, "/")(name) is not None


@functools.cache
def _expression(pattern: str, separator: str = ".") -> Callable[[str], Any]:
    """The pattern as a regular expression that is matched in full."""
    words = {"**": ".*", "*": f"[^{separator}]*", "?": f"[^{separator}]"}
    parts = re.split(r"(\*\*|\*|\?|\[!?[^]]+\])", pattern)
    text = "".join(words.get(part) or (part.replace("[!", "[^") if part.startswith("[") else re.escape(part)) for part in parts)
    return re.compile(text).fullmatch


def write(recording: Recording, path: Union[str, os.PathLike]) -> None:
    """Writes a file; its name says the format: .parquet, .mcap, .csv or .rrd. Raises ArgumentError for another name."""
    with writer_of(path, recording.columns, recording.facts) as writer:
        for time, values in zip(recording.time.tolist(), recording.values):
            writer.add(time, values)


def writer_of(path: Union[str, os.PathLike], columns: Sequence[Column], facts: Mapping[str, Any],
              messages: Sequence[MessageVariable] = (),
              run: Optional[Run] = None) -> Union[ParquetWriter, McapWriter, CsvWriter, RerunWriter]:
    """A writer of the format that the name of the file says, which takes one sample after the other.

    Args:
        messages: a table (.csv) takes none.
        run: that a Rerun recording (.rrd) draws at each sample; None: it has only the numbers and messages.

    Raises:
        ArgumentError: the file has another name, or is there and of another kind.
        RobossError: the package of the format is missing (code "no-package").
    """
    suffix = _suffix(path, WRITTEN)
    check_package(suffix)
    check_output(path)
    if suffix == ".csv":
        from .csv_file import CsvWriter
        return CsvWriter(path, columns, facts)
    if suffix == ".parquet":
        from .parquet_file import ParquetWriter
        return ParquetWriter(path, columns, facts, messages)
    if suffix == ".rrd":
        from .rerun_file import RerunWriter
        return RerunWriter(path, columns, facts, messages, run)
    from .mcap_file import McapWriter
    return McapWriter(path, columns, facts, messages)


def read(path: Union[str, os.PathLike]) -> Recording:
    """Reads the numbers of a file of `write`, or of `roboss record`, or of a table (.csv). Its messages (images, contact
    points) are left out: pyarrow and mcap read them.

    Raises:
        RobossError: there is no such file (code "no-file"), or it cannot be read ("no-recording").
    """
    existing(path)
    suffix = Path(path).suffix
    try:
        if _suffix(path, SUFFIXES) == ".csv":
            from .csv_file import read_csv
            return read_csv(path)
        if suffix == ".parquet":
            from .parquet_file import read_parquet
            return read_parquet(path)
        from .mcap_file import read_mcap
        return read_mcap(path)
    except RobossError:
        raise
    except Exception as error:  # whatever the libraries raise for what is missing or damaged
        if isinstance(error, ImportError):
            raise
        raise RobossError(f"'{os.fspath(path)}' cannot be read: {error}", "give a file that `roboss record` wrote",
                          "no-recording") from error


def existing(path: Union[str, os.PathLike]) -> str:
    """The path of a file that exists. Raises ArgumentError (code "no-file") if it does not."""
    name = file_path("path", path)
    if not Path(name).is_file():
        raise ArgumentError(f"there is no file '{name}'", "check its name", "no-file")
    return name


def check_package(suffix: str) -> None:
    """Refuses a format whose package is missing. Raises RobossError (code "no-package")."""
    if suffix != ".rrd":
        return
    try:
        from rerun import RecordingStream
    except ImportError:
        raise RobossError("the Python package 'rerun-sdk' is missing, which writes .rrd", _RERUN, "no-package") from None
    if not hasattr(RecordingStream, "set_log_time_enabled"):
        raise RobossError("the Python package 'rerun-sdk' is too old to write .rrd", _RERUN, "no-package")


def _suffix(path: Union[str, os.PathLike], known: Sequence[str]) -> str:
    suffix = Path(path).suffix
    if suffix not in known:
        remedy = "record the run as .parquet, .mcap or .csv: what is written for Rerun is not read here" if suffix in WRITTEN else \
            f"end the name in {', '.join(known[:-1])} or {known[-1]}"
        raise ArgumentError(f"a recording named '{os.fspath(path)}'", remedy, "unknown-format")
    return suffix
