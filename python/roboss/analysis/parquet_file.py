"""Recordings as Parquet: one table, a column for each number, the first is "time"; units and frames as field metadata.

The metadata keys are "unit", "frame" and "variable" of a field, and "roboss" (JSON: the facts) of the table.
"""
from __future__ import annotations

import json
import os
from typing import Union

import numpy as np
import pyarrow
import pyarrow.parquet

from .recording import Column, Recording


def write_parquet(recording: Recording, path: Union[str, os.PathLike]) -> None:
    """Writes the recording."""
    fields = [pyarrow.field("time", pyarrow.float64(), nullable=False, metadata={"unit": "s"})]
    for column in recording.columns:
        facts = {"unit": column.unit, "frame": column.frame, "variable": column.variable}
        fields.append(pyarrow.field(column.name, pyarrow.float64(), metadata=facts))
    schema = pyarrow.schema(fields, metadata={"roboss": json.dumps(recording.facts)})
    arrays = [pyarrow.array(recording.time), *(pyarrow.array(np.ascontiguousarray(values)) for values in recording.values.T)]
    pyarrow.parquet.write_table(pyarrow.Table.from_arrays(arrays, schema=schema), path, compression="zstd")


def read_parquet(path: Union[str, os.PathLike]) -> Recording:
    """Reads it. Other tables are read, too, if they have a column "time"; their columns have no units then."""
    table = pyarrow.parquet.read_table(path)
    columns, values, time = [], [], None
    for field, data in zip(table.schema, table.columns):
        facts = {key.decode(): value.decode() for key, value in (field.metadata or {}).items()}
        if field.name == "time":
            time = data.to_numpy().astype(float)
        elif pyarrow.types.is_floating(field.type) or pyarrow.types.is_integer(field.type):
            columns.append(Column(field.name, facts.get("variable", field.name), facts.get("unit", ""), facts.get("frame", "")))
            values.append(data.to_numpy().astype(float))
    if time is None:
        raise ValueError("it has no column 'time'")
    facts = json.loads((table.schema.metadata or {}).get(b"roboss", b"{}"))
    return Recording(time, columns, np.array(values).T.reshape(len(time), len(columns)), facts)
