"""Recordings as ROS 2 makes them: MCAP with messages in CDR and their definitions, alone or in the folder of a rosbag2."""
from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any, Mapping, Union

from mcap.writer import CompressionType, Writer

from .ros2_recorder import Topic

_NEVER = {"sec": 9223372036, "nsec": 854775807}  # how ROS 2 writes a duration without an end


class Ros2Writer:
    """Writes messages as they come; only the last megabyte is in memory. A context.

    Args:
        path: ends in .mcap: that file. Else a new folder, a rosbag2 of version 9 with one file and metadata.yaml.
        facts: what else is known of the run: the metadata "roboss" of the file.
    """

    def __init__(self, path: Union[str, os.PathLike], facts: Mapping[str, Any]):
        self._folder = None if Path(path).suffix == ".mcap" else Path(path)
        if self._folder:
            self._folder.mkdir()
        self._file = self._folder / f"{self._folder.name}_0.mcap" if self._folder else Path(path)
        self._stream = open(self._file, "wb")
        self._writer = Writer(self._stream, compression=CompressionType.ZSTD)
        self._writer.start(profile="ros2", library="roboss")
        self._writer.add_metadata("roboss", {"facts": json.dumps(facts)})
        self._schemas: dict[str, int] = {}    # numbers by type
        self._channels: dict[str, int] = {}   # numbers by topic
        self._topics: dict[str, Topic] = {}
        self.counts: dict[str, int] = {}      #: messages by topic
        self._first = self._last = 0          # times of the first and the last message, ns
        self._total = 0                       # messages

    def add_topic(self, topic: Topic) -> None:
        """A topic without messages so far. One that is there stays."""
        if topic.name in self._channels:
            return
        if topic.type not in self._schemas:
            self._schemas[topic.type] = self._writer.register_schema(topic.type, "ros2msg", topic.definition.encode())
        self._channels[topic.name] = self._writer.register_channel(
            topic.name, "cdr", self._schemas[topic.type],
            {"offered_qos_profiles": json.dumps([_quality(topic)]), "topic_type_hash": topic.hash})
        self._topics[topic.name] = topic
        self.counts[topic.name] = 0

    def add(self, topic: str, stamp: int, message: bytes) -> None:
        """A message of a topic at a time, ns."""
        self._first = stamp if self._total == 0 else self._first
        self._last = max(self._last, stamp)
        self._writer.add_message(self._channels[topic], stamp, message, stamp, self.counts[topic])
        self.counts[topic] += 1
        self._total += 1

    def __enter__(self) -> Ros2Writer:
        return self

    def __exit__(self, *_: Any) -> None:
        """Ends the file: also after an error it has all messages so far."""
        self._writer.finish()
        self._stream.close()
        if self._folder:
            (self._folder / "metadata.yaml").write_text(json.dumps(self._metadata(), indent=2) + "\n")  # JSON is YAML

    def _metadata(self) -> dict[str, Any]:
        start, duration = {"nanoseconds_since_epoch": self._first}, {"nanoseconds": self._last - self._first}
        topics = [{"topic_metadata": {"name": topic.name, "type": topic.type, "serialization_format": "cdr",
                                      "offered_qos_profiles": [_quality(topic)], "type_description_hash": topic.hash},
                   "message_count": self.counts[name]} for name, topic in self._topics.items()]
        return {"rosbag2_bagfile_information": {
            "version": 9, "storage_identifier": "mcap", "duration": duration, "starting_time": start,
            "message_count": self._total, "topics_with_message_count": topics, "compression_format": "",
            "compression_mode": "", "relative_file_paths": [self._file.name],
            "files": [{"path": self._file.name, "starting_time": start, "duration": duration, "message_count": self._total}],
            "custom_data": None, "ros_distro": "jazzy"}}


def _quality(topic: Topic) -> dict[str, Any]:
    """The quality of service that its publisher would offer, as rosbag2 writes it."""
    return {"history": "keep_last", "depth": 1 if topic.latched or topic.name == "/clock" else 10, "reliability": "reliable",
            "durability": "transient_local" if topic.latched else "volatile", "deadline": _NEVER, "lifespan": _NEVER,
            "liveliness": "automatic", "liveliness_lease_duration": _NEVER, "avoid_ros_namespace_conventions": False}
