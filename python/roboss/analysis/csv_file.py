"""Tables of measurements as CSV: a line with the names of the columns, one of which is "time" (s), then numbers.

A line "# roboss {JSON}" before the table holds what the other formats keep as metadata: facts, and for each column its
variable, unit and frame. Tables of other programs do without it.
"""
from __future__ import annotations

import csv
import json
import os
from typing import Any, Mapping, Sequence, Union

import numpy as np

from ..errors import ArgumentError
from ..robots import Floats
from .recording import POSE, TWIST, Column, Recording

_GROUPS = {"pose": dict(POSE), "command": dict(POSE), "twist": dict(TWIST)}  # variables of several columns: units of their parts
_UNITS = {"x": "m", "y": "m", "z": "m", "yaw": "rad", "speed": "m/s"}  # of ROBOT.x ...


_HEAD = "# roboss "


class CsvWriter:
    """Writes samples to a table as they come. A context. Numbers are written in full, so reading gives the same bits."""

    def __init__(self, path: Union[str, os.PathLike], columns: Sequence[Column], facts: Mapping[str, Any]):
        self._stream = open(path, "w", newline="", encoding="utf-8")
        notes = {column.name: [column.variable, column.unit, column.frame] for column in columns}
        self._stream.write(_HEAD + json.dumps({"facts": dict(facts), "columns": notes}) + "\r\n")
        self._rows = csv.writer(self._stream)
        self._rows.writerow(["time", *(column.name for column in columns)])

    def add(self, time: float, values: Floats, messages: Sequence[Any] = ()) -> None:
        """Writes a sample: the values of the columns; NaN is an empty cell. A table takes no messages."""
        self._rows.writerow([repr(float(time)), *("" if value != value else repr(value) for value in values.tolist())])

    def __enter__(self) -> CsvWriter:
        return self

    def __exit__(self, *_: object) -> None:
        """Ends the file: also after an error it has all samples so far."""
        self._stream.close()


def read_csv(path: Union[str, os.PathLike]) -> Recording:
    """Reads a table. Columns stand between commas, semicolons or tabs, whichever the first line has; empty cells are NaN.
    Lines that are empty or begin with # do not count. Names are those of `roboss record`: arm.tool.pose.x to arm.tool.pose.qw
    are one variable, and so are the columns of X.command and X.twist, in any order. Units are known where the name tells them,
    or from the metadata of CsvWriter.

    Raises:
        ArgumentError: a line has too few or too many cells, or a cell is no number, or there is no column "time" (code
            "bad-table"), with the line.
    """
    names: list[str] = []
    rows: list[list[float]] = []
    head: dict[str, Any] = {"facts": {}, "columns": {}}
    with open(path, newline="", encoding="utf-8-sig") as stream:
        for number, line in enumerate(stream, 1):
            if line.startswith(_HEAD) and not names:
                head = json.loads(line[len(_HEAD):])
            if not line.strip() or line.startswith("#"):
                continue
            where = f"{os.fspath(path)}:{number}"
            delimiter = delimiter if names else max(",;\t", key=line.count)
            cells = [cell.strip() for cell in next(csv.reader([line], delimiter=delimiter))]
            if not names:
                names = _checked(cells, where)
            else:
                rows.append(_numbers(cells, names, where))
    if not names:
        raise ArgumentError(f"'{os.fspath(path)}' is empty", "give a line with the names of the columns, then numbers", "bad-table")
    values = np.array(rows, dtype=float).reshape(len(rows), len(names))
    time = names.index("time")
    known = head["columns"]
    columns = [Column(name, *known[name]) if name in known else _column(name) for name in names]
    variables = [column.variable for column in columns]
    order = sorted((number for number in range(len(names)) if number != time),
                   key=lambda number: (variables.index(variables[number]), _place(columns[number]), number))
    return Recording(values[:, time], [columns[number] for number in order], values[:, order], head["facts"])


def _column(name: str) -> Column:
    """The column, and the variable that it is a part of."""
    variable, _, part = name.rpartition(".")
    units = _GROUPS.get(variable.rpartition(".")[2], {})
    if part in units:
        return Column(name, variable, units[part])
    return Column(name, name, _UNITS.get(part, "") if name.count(".") == 1 else "")


def _place(column: Column) -> int:
    """Where the column stands in its variable."""
    parts = list(_GROUPS.get(column.variable.rpartition(".")[2], ()))
    part = column.name[len(column.variable) + 1:]
    return parts.index(part) if part in parts else 0


def _checked(names: list[str], where: str) -> list[str]:
    """The names of the columns."""
    if "time" not in names:
        raise ArgumentError(f"{where}: no column 'time'; there is {', '.join(names[:8])}",
                            "name the columns in the first line: time, robot.x ..., as `roboss record` does", "bad-table")
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise ArgumentError(f"{where}: two columns are named '{twice[0]}'", "give each its own name", "bad-table")
    return names


def _numbers(cells: Sequence[str], names: Sequence[str], where: str) -> list[float]:
    if len(cells) != len(names):
        raise ArgumentError(f"{where}: {len(cells)} cells for {len(names)} columns", "leave cells empty, not out", "bad-table")
    values = []
    for cell, name in zip(cells, names):
        try:
            values.append(float(cell) if cell else np.nan)
        except ValueError:
            raise ArgumentError(f"{where}: '{cell}' in column '{name}' is no number", "write numbers with a point; leave cells "
                                "without a value empty", "bad-table") from None
    return values
