"""Recordings as MCAP: a channel for each variable with JSON messages and their JSON Schema, so Foxglove shows them.

Poses are messages of foxglove.PoseInFrame, which 3D panels draw, images those of foxglove.RawImage, scans of lasers those
of foxglove.LaserScan or PointCloud. The facts of a recording are the metadata "roboss".
"""
from __future__ import annotations

import base64
import json
import os
from typing import Any, Mapping, Sequence, Union

import numpy as np
from mcap.reader import make_reader
from mcap.writer import CompressionType, Writer

from ..errors import ArgumentError
from ..robots import Floats
from .messages import MessageVariable
from .recording import Column, Recording

_POSE = (("pose", "position", "x"), ("pose", "position", "y"), ("pose", "position", "z"), ("pose", "orientation", "x"),
         ("pose", "orientation", "y"), ("pose", "orientation", "z"), ("pose", "orientation", "w"))
_NUMBER, _WHOLE, _TEXT = {"type": "number"}, {"type": "integer"}, {"type": "string"}
_VECTOR = {"type": "object", "properties": {axis: _NUMBER for axis in "xyz"}}
_TURN = {"type": "object", "properties": {axis: _NUMBER for axis in "xyzw"}}
_STAMP = {"type": "object", "title": "time", "properties": {"sec": _WHOLE, "nsec": _WHOLE}}
#: JSON Schemas of the types of fields (messages.Layout).
_TYPES: dict[str, dict[str, Any]] = {
    "text": _TEXT, "whole": _WHOLE, "number": _NUMBER, "vector": _VECTOR,
    "pose": {"type": "object", "title": "foxglove.Pose", "properties": {"position": _VECTOR, "orientation": _TURN}},
    "packed fields": {"type": "array", "items": {"type": "object", "title": "foxglove.PackedElementField", "properties": {
        "name": _TEXT, "offset": _WHOLE, "type": _WHOLE}}},
    "bytes": {"type": "string", "contentEncoding": "base64"}, "texts": {"type": "array", "items": _TEXT},
    "numbers": {"type": "array", "items": _NUMBER}, "rows": {"type": "array", "items": {"type": "array", "items": _NUMBER}}}


class McapWriter:
    """Writes samples to a file as they come; only the last megabyte is in memory. A context."""

    def __init__(self, path: Union[str, os.PathLike], columns: Sequence[Column], facts: Mapping[str, Any],
                 messages: Sequence[MessageVariable] = ()):
        self._stream = open(path, "wb")
        self._writer = Writer(self._stream, compression=CompressionType.ZSTD)
        self._writer.start(profile="", library="roboss")
        self._writer.add_metadata("roboss", {"facts": json.dumps(facts)})
        numbers: dict[str, list[int]] = {}
        for number, column in enumerate(columns):
            numbers.setdefault(column.variable, []).append(number)
        self._channels = [_Channel(self._writer, columns, *item) for item in numbers.items()]
        self._message_channels = [_MessageChannel(self._writer, variable) for variable in messages]
        self._row = 0

    def add(self, time: float, values: Floats, messages: Sequence[Any] = ()) -> None:
        """Writes a sample: the values of the columns, and those of the messages."""
        stamp = int(round(time * 1e9))
        for channel in self._channels:
            self._writer.add_message(channel.id, stamp, channel.message(values, stamp), stamp, self._row)
        for message_channel, value in zip(self._message_channels, messages):
            if value is None:  # its robot is not there
                continue
            self._writer.add_message(message_channel.id, stamp, message_channel.message(value, stamp), stamp, self._row)
        self._row += 1

    def __enter__(self) -> McapWriter:
        return self

    def __exit__(self, *_: Any) -> None:
        """Ends the file: also after an error it has all samples so far."""
        self._writer.finish()
        self._stream.close()


def read_mcap(path: Union[str, os.PathLike]) -> Recording:
    """Reads the numbers of what McapWriter wrote. Raises ValueError if the channels have messages at different times."""
    with open(path, "rb") as stream:
        reader = make_reader(stream)
        variables = {number: channel for number, channel in reader.get_summary().channels.items() if "variable" in channel.metadata}
        channels = {number: channel for number, channel in variables.items() if "roboss" in channel.metadata}
        messages = [channel.metadata["variable"] for number, channel in variables.items() if number not in channels]
        if messages and not channels:
            raise ArgumentError(f"'{os.fspath(path)}' holds only messages, not numbers: {', '.join(messages[:12])}",
                                "record numbers, too; the package mcap reads messages", "no-numbers")
        if not channels:
            raise ValueError("it has no channels with numbers of RoBOSS")
        facts = next((json.loads(entry.metadata["facts"]) for entry in reader.iter_metadata() if entry.name == "roboss"), {})
        rows: dict[int, list[list[float]]] = {number: [] for number in channels}
        places = {number: json.loads(channel.metadata["roboss"]) for number, channel in channels.items()}
        times: dict[int, None] = {}
        for _, channel, message in reader.iter_messages([channel.topic for channel in channels.values()]):
            times[message.log_time] = None
            data = json.loads(message.data)
            rows[channel.id].append([_at(data, place["path"]) for place in places[channel.id]])
    if any(len(values) != len(times) for values in rows.values()):
        raise ValueError("its channels are not those of a recording of RoBOSS")
    columns = [Column(place["name"], channel.metadata["variable"], place["unit"], place["frame"])
               for number, channel in channels.items() for place in places[number]]
    values = np.concatenate([np.array(rows[number], dtype=float).reshape(len(times), -1) for number in channels], axis=1)
    return Recording(np.array(list(times)) / 1e9, columns, values, facts, messages)


class _Channel:
    """A variable's channel, and its columns."""

    def __init__(self, writer: Writer, all_columns: Sequence[Column], variable: str, numbers: list[int]):
        self.numbers = numbers
        columns = [all_columns[n] for n in numbers]
        self.frame = columns[0].frame or "world"
        parts = [column.name[len(variable) + 1:] or "value" for column in columns]
        self.is_pose = parts == ["x", "y", "z", "qx", "qy", "qz", "qw"]
        self.paths: list[tuple[str, ...]] = list(_POSE) if self.is_pose else [(part,) for part in parts]
        name = "foxglove.PoseInFrame" if self.is_pose else "roboss." + variable.split(".")[-1]
        schema = writer.register_schema(name, "jsonschema", json.dumps(self._schema(columns)).encode())
        places = [{"name": c.name, "unit": c.unit, "frame": c.frame, "path": path} for c, path in zip(columns, self.paths)]
        self.id = writer.register_channel(_topic(variable), "json", schema,
                                          {"roboss": json.dumps(places), "variable": variable})

    def _schema(self, columns: list[Column]) -> dict[str, Any]:
        if not self.is_pose:
            return {"type": "object", "properties": {path[0]: {"type": "number", "description": column.unit}
                                                     for path, column in zip(self.paths, columns)}}
        return {"title": "foxglove.PoseInFrame", "type": "object", "properties": {
            "timestamp": _STAMP, "frame_id": _TEXT, "pose": _TYPES["pose"]}}

    def message(self, row: Any, stamp: int) -> bytes:
        """The bytes of the message of a row."""
        data: dict[str, Any] = _headed(stamp, self.frame) if self.is_pose else {}
        for path, number in zip(self.paths, self.numbers):
            inner = data
            for part in path[:-1]:
                inner = inner.setdefault(part, {})
            inner[path[-1]] = _plain(float(row[number]))
        return json.dumps(data).encode()


class _MessageChannel:
    """The channel of a variable whose values are messages."""

    def __init__(self, writer: Writer, variable: MessageVariable):
        self.variable = variable
        schema = writer.register_schema(variable.layout.name, "jsonschema", json.dumps(self._schema()).encode())
        self.id = writer.register_channel(_topic(variable.name), "json", schema, {"variable": variable.name})

    def _schema(self) -> dict[str, Any]:
        layout = self.variable.layout
        fields = {name: {**_TYPES[kind], "description": layout.units.get(name, "")} if layout.units.get(name) else _TYPES[kind]
                  for name, kind in layout.fields.items()}
        if layout.listed:
            fields = {layout.listed: {"type": "array", "items": {"type": "object", "properties": fields}}}
        return {"title": layout.name, "type": "object", "properties": {"timestamp": _STAMP, "frame_id": _TEXT, **fields}}

    def message(self, value: Any, stamp: int) -> bytes:
        """The bytes of the message of a value."""
        data = _headed(stamp, self.variable.frame)
        data.update({self.variable.layout.listed: _plain(value)} if self.variable.layout.listed else _plain(value))
        return json.dumps(data).encode()


def _topic(variable: str) -> str:
    return "/" + variable.replace(".", "/")


def _headed(stamp: int, frame: str) -> dict[str, Any]:
    return {"timestamp": {"sec": stamp // 10**9, "nsec": stamp % 10**9}, "frame_id": frame}


def _plain(value: Any) -> Any:
    """What JSON can hold: null for numbers that are not finite, bytes as base64."""
    if isinstance(value, float):
        return value if np.isfinite(value) else None
    if isinstance(value, bytes):
        return base64.b64encode(value).decode()
    if isinstance(value, list):
        return [_plain(part) for part in value]
    return {name: _plain(part) for name, part in value.items()} if isinstance(value, dict) else value


def _at(data: Any, path: list[str]) -> float:
    for part in path:
        data = data[part]
    return np.nan if data is None else data
