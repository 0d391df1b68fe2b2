"""Recordings as MCAP: a channel for each variable with JSON messages and their JSON Schema, so Foxglove shows them.

Poses are messages of foxglove.PoseInFrame, which 3D panels draw. The facts of a recording are the metadata "roboss".
"""
from __future__ import annotations

import json
import os
from typing import Any, Union

import numpy as np
from mcap.reader import make_reader
from mcap.writer import CompressionType, Writer

from .recording import Column, Recording

_POSE = (("pose", "position", "x"), ("pose", "position", "y"), ("pose", "position", "z"), ("pose", "orientation", "x"),
         ("pose", "orientation", "y"), ("pose", "orientation", "z"), ("pose", "orientation", "w"))
_NUMBER = {"type": "number"}


def write_mcap(recording: Recording, path: Union[str, os.PathLike]) -> None:
    """Writes the recording."""
    with open(path, "wb") as stream:
        writer = Writer(stream, compression=CompressionType.ZSTD)
        writer.start(profile="", library="roboss")
        writer.add_metadata("roboss", {"facts": json.dumps(recording.facts)})
        channels = [_Channel(writer, recording, variable) for variable in recording.variables]
        for row, time in enumerate(recording.time):
            stamp = int(round(float(time) * 1e9))
            for channel in channels:
                writer.add_message(channel.id, stamp, channel.message(recording.values[row], stamp), stamp, row)
        writer.finish()


def read_mcap(path: Union[str, os.PathLike]) -> Recording:
    """Reads what write_mcap wrote. Raises ValueError if the channels have messages at different times."""
    with open(path, "rb") as stream:
        reader = make_reader(stream)
        channels = {number: channel for number, channel in reader.get_summary().channels.items()
                    if "roboss" in channel.metadata}
        facts = next((json.loads(entry.metadata["facts"]) for entry in reader.iter_metadata() if entry.name == "roboss"), {})
        rows: dict[int, list[list[float]]] = {number: [] for number in channels}
        places = {number: json.loads(channel.metadata["roboss"]) for number, channel in channels.items()}
        times: dict[int, None] = {}
        for _, channel, message in reader.iter_messages():
            if channel.id in channels:
                times[message.log_time] = None
                data = json.loads(message.data)
                rows[channel.id].append([_at(data, place["path"]) for place in places[channel.id]])
    if any(len(values) != len(times) for values in rows.values()) or not channels:
        raise ValueError("its channels are not those of a recording of RoBOSS")
    columns = [Column(place["name"], channel.metadata["variable"], place["unit"], place["frame"])
               for number, channel in channels.items() for place in places[number]]
    values = np.concatenate([np.array(rows[number], dtype=float).reshape(len(times), -1) for number in channels], axis=1)
    return Recording(np.array(list(times)) / 1e9, columns, values, facts)


class _Channel:
    """A variable's channel, and its columns."""

    def __init__(self, writer: Writer, recording: Recording, variable: str):
        self.numbers = [n for n, column in enumerate(recording.columns) if column.variable == variable]
        columns = [recording.columns[n] for n in self.numbers]
        self.frame = columns[0].frame or "world"
        parts = [column.name[len(variable) + 1:] or "value" for column in columns]
        self.is_pose = parts == ["x", "y", "z", "qx", "qy", "qz", "qw"]
        self.paths: list[tuple[str, ...]] = list(_POSE) if self.is_pose else [(part,) for part in parts]
        name = "foxglove.PoseInFrame" if self.is_pose else "roboss." + variable.split(".")[-1]
        schema = writer.register_schema(name, "jsonschema", json.dumps(self._schema(columns)).encode())
        places = [{"name": c.name, "unit": c.unit, "frame": c.frame, "path": path} for c, path in zip(columns, self.paths)]
        self.id = writer.register_channel("/" + variable.replace(".", "/"), "json", schema,
                                          {"roboss": json.dumps(places), "variable": variable})

    def _schema(self, columns: list[Column]) -> dict[str, Any]:
        if not self.is_pose:
            return {"type": "object", "properties": {path[0]: {"type": "number", "description": column.unit}
                                                     for path, column in zip(self.paths, columns)}}
        whole = {"type": "integer"}
        vector = {"type": "object", "properties": {axis: _NUMBER for axis in "xyz"}}
        turn = {"type": "object", "properties": {axis: _NUMBER for axis in "xyzw"}}
        return {"title": "foxglove.PoseInFrame", "type": "object", "properties": {
            "timestamp": {"type": "object", "title": "time", "properties": {"sec": whole, "nsec": whole}},
            "frame_id": {"type": "string"},
            "pose": {"type": "object", "title": "foxglove.Pose", "properties": {"position": vector, "orientation": turn}}}}

    def message(self, row: Any, stamp: int) -> bytes:
        """The bytes of the message of a row."""
        data: dict[str, Any] = {}
        if self.is_pose:
            data = {"timestamp": {"sec": stamp // 10**9, "nsec": stamp % 10**9}, "frame_id": self.frame}
        for path, number in zip(self.paths, self.numbers):
            inner = data
            for part in path[:-1]:
                inner = inner.setdefault(part, {})
            value = float(row[number])
            inner[path[-1]] = value if np.isfinite(value) else None  # JSON has no infinity
        return json.dumps(data).encode()


def _at(data: Any, path: list[str]) -> float:
    for part in path:
        data = data[part]
    return np.nan if data is None else data
