"""Recordings as Parquet: one table, a column for each number, the first is "time"; units and frames as field metadata.

The metadata keys are "unit", "frame" and "variable" of a field, and "roboss" (JSON: the facts) of the table. Messages are
columns of structures, or of lists of them.
"""
from __future__ import annotations

import json
import os
from typing import Any, Mapping, Sequence, Union

import numpy as np
import pyarrow
import pyarrow.parquet

from ..robots import Floats
from .messages import Layout, MessageVariable
from .recording import Column, Recording

_GROUP_BYTES = 64 << 20  # of a row group, which is held in memory
_GROUP_ROWS = 1 << 17    # at most
def _numbers_of(names: str) -> pyarrow.DataType:
    return pyarrow.struct([(name, pyarrow.float64()) for name in names])


_TYPES = {"text": pyarrow.string(), "whole": pyarrow.int64(), "number": pyarrow.float64(), "bytes": pyarrow.binary(),
          "vector": _numbers_of("xyz"), "pose": pyarrow.struct([("position", _numbers_of("xyz")), ("orientation", _numbers_of("xyzw"))]),
          "packed fields": pyarrow.list_(pyarrow.struct([("name", pyarrow.string()), ("offset", pyarrow.int64()), ("type", pyarrow.int64())])),
          "texts": pyarrow.list_(pyarrow.string()),
          "numbers": pyarrow.list_(pyarrow.float64()), "rows": pyarrow.list_(pyarrow.list_(pyarrow.float64()))}


class ParquetWriter:
    """Writes samples to a file as they come, in row groups of some 64 MiB. A context."""

    def __init__(self, path: Union[str, os.PathLike], columns: Sequence[Column], facts: Mapping[str, Any],
                 messages: Sequence[MessageVariable] = ()):
        fields = [pyarrow.field("time", pyarrow.float64(), nullable=False, metadata={"unit": "s"})]
        for column in columns:
            notes = {"unit": column.unit, "frame": column.frame, "variable": column.variable}
            fields.append(pyarrow.field(column.name, pyarrow.float64(), metadata=notes))
        for variable in messages:
            notes = {"frame": variable.frame, "variable": variable.name, "units": json.dumps(dict(variable.layout.units))}
            fields.append(pyarrow.field(variable.name, _type_of(variable.layout), metadata=notes))
        self._schema = pyarrow.schema(fields, metadata={"roboss": json.dumps(facts)})
        self._writer = pyarrow.parquet.ParquetWriter(path, self._schema, compression="zstd")
        self._times: list[float] = []
        self._rows: list[Floats] = []
        self._messages: list[list[Any]] = [[] for _ in messages]
        self._bytes = 0

    def add(self, time: float, values: Floats, messages: Sequence[Any] = ()) -> None:
        """Writes a sample: the values of the columns, and those of the messages."""
        self._times.append(time)
        self._rows.append(values)
        self._bytes += values.nbytes
        for kept, value in zip(self._messages, messages):
            kept.append(value)
            self._bytes += _size(value)
        if self._bytes >= _GROUP_BYTES or len(self._times) >= _GROUP_ROWS:
            self._flush()

    def _flush(self) -> None:
        table = np.array(self._rows).reshape(len(self._times), -1)
        arrays = [pyarrow.array(self._times), *(pyarrow.array(np.ascontiguousarray(values)) for values in table.T)]
        arrays += [pyarrow.array(values, type=self._schema.field(len(arrays) + number).type)
                   for number, values in enumerate(self._messages)]
        self._writer.write_table(pyarrow.Table.from_arrays(arrays, schema=self._schema), row_group_size=len(self._times))
        for kept in (self._times, self._rows, *self._messages):
            kept.clear()
        self._bytes = 0

    def __enter__(self) -> ParquetWriter:
        return self

    def __exit__(self, *_: Any) -> None:
        """Ends the file: also after an error it has all samples so far."""
        if self._times:
            self._flush()
        self._writer.close()


def read_parquet(path: Union[str, os.PathLike]) -> Recording:
    """Reads the numbers of it. Other tables are read, too, if they have a column "time"; their columns have no units then."""
    file = pyarrow.parquet.ParquetFile(path)
    fields = [field for field in file.schema_arrow
              if pyarrow.types.is_floating(field.type) or pyarrow.types.is_integer(field.type)]
    if "time" not in (field.name for field in fields):
        raise ValueError("it has no column 'time'")
    table = file.read(columns=[field.name for field in fields])
    columns, values, time = [], [], np.array([])
    for field in fields:
        data = table[field.name].to_numpy().astype(float)
        notes = {key.decode(): value.decode() for key, value in (field.metadata or {}).items()}
        if field.name == "time":
            time = data
        else:
            columns.append(Column(field.name, notes.get("variable", field.name), notes.get("unit", ""), notes.get("frame", "")))
            values.append(data)
    facts = json.loads((file.schema_arrow.metadata or {}).get(b"roboss", b"{}"))
    messages = [field.name for field in file.schema_arrow if b"units" in (field.metadata or {})]
    return Recording(time, columns, np.array(values).T.reshape(len(time), len(columns)), facts, messages)


def _type_of(layout: Layout) -> pyarrow.DataType:
    fields = pyarrow.struct([(name, _TYPES[kind]) for name, kind in layout.fields.items()])
    return pyarrow.list_(fields) if layout.listed else fields


def _size(value: Any) -> int:
    """About how many bytes a message takes in memory."""
    if isinstance(value, (bytes, str)):
        return len(value) + 50
    if isinstance(value, dict):
        return 200 + sum(_size(part) for part in value.values())
    return 60 + sum(_size(part) for part in value) if isinstance(value, list) else 30
