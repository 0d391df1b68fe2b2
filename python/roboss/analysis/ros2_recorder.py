"""`roboss record --ros2`: a run as ROS 2 would have recorded it."""
from __future__ import annotations

import os
from typing import Iterable, Iterator, NamedTuple, Optional, Union

from .. import _core
from ..names import unknown
from ..outputs import check_output
from ..run import Run
from .recorder import Progress, Recorded, Source, later_runs, located, opened, samples
from .recording import matches_path


class Topic(NamedTuple):
    """A topic of ROS 2.

    Attributes:
        name: "/car_3/scan".
        type: "sensor_msgs/msg/LaserScan".
        hash: of the type, "RIHS01_...".
        definition: of the type, in the format ros2msg.
        latched: who comes later gets the last message, too (durability "transient_local").
    """

    name: str
    type: str
    hash: str
    definition: str
    latched: bool


def record_ros2(source: Source, path: Union[str, os.PathLike], patterns: Union[str, Iterable[str], None] = None, *,
                until: Optional[float] = None, every: float = 0.01, start: Optional[float] = None,
                branch: Optional[int] = None, progress: Optional[Progress] = None, name: str = "") -> Recorded:
    """Records the topics that the robots of a run have in ROS 2 (docs/ros2.md), with messages as ROS 2 encodes them.

    Args:
        path: ends in .mcap: that file, with the profile ros2. Else a new folder: a rosbag2.
        patterns: of topics: "/car_3/scan", "/car_*/odom", "/car_3/**"; None: all.
        every: time between two messages of topics that have no rate of their own, s. A sensor with an `<update_rate>` has
            its own rate, as far as `every` allows.
        others: as of record_file().

    Raises:
        UnknownNameError: a pattern matches no topic.

    For instance `record_ros2("crossroads.sdf", "run.mcap", ["/tf*", "/car_3/**"], until=10)`.
    """
    wanted = None if patterns is None else [patterns] if isinstance(patterns, str) else list(patterns)
    run, last, ending = opened(source, start, until, branch)
    check_output(path, reads=[located(source, branch, until)[0]])
    topics = _Topics(run, wanted)
    topics.check_patterns(later_runs(run, last))
    done = Recorded([], 0, first=run.time, left_out=tuple(topics.left_out))
    from .ros2_file import Ros2Writer
    facts = {"source": name or ending, "world": run.world.name, "world_hash": run.world.hash, "dt": run.dt}
    with Ros2Writer(path, facts) as writer:
        for sim in samples(run, last, every):
            for topic in topics.follow():
                writer.add_topic(topic)
            stamp = int(round(sim.time * 1e9))
            for topic_name, message in topics.messages():
                writer.add(topic_name, stamp, message)
            done.samples, done.last = done.samples + 1, sim.time
            if progress:
                progress(sim.time, last)
        done.variables = list(writer.counts)
        done.messages = sum(writer.counts.values())
    return done


def topics_of(source: Source, start: Optional[float] = None, until: Optional[float] = None,
              branch: Optional[int] = None) -> list[Topic]:
    """All topics of a run, as record_ros2() has them."""
    run, _, _ = opened(source, start, until, branch)
    return _Topics(run, None).chosen


class _Topics:
    """The chosen topics of a run whose robots may come and go."""

    def __init__(self, run: Run, wanted: Optional[list[str]]):
        self._run, self._wanted = run, wanted
        self._renew()
        self.left_out: list[str] = self._core.left_out  #: sensors that have no messages in ROS 2

    def check_patterns(self, later: Iterable[Run]) -> None:
        """Raises UnknownNameError if a pattern matches no topic, neither here nor in the runs of worlds to come."""
        names = [topic.name for topic in self._all]
        for run in later:
            names += [row[0] for row in _core.Ros2Topics(run._simulations[0]).topics]
        for pattern in self._wanted or ():
            if not any(matches_path(pattern, name) for name in names):
                raise unknown("topic", pattern, names)

    def _renew(self) -> None:
        self._hash = self._run.world.hash
        self._core = _core.Ros2Topics(self._run._simulations[0])
        self._all = [Topic(*row) for row in self._core.topics]
        chosen = [self._is_wanted(topic.name) for topic in self._all]
        self._core.select(chosen)
        self.chosen = [topic for topic, is_chosen in zip(self._all, chosen) if is_chosen]
        self._is_new = True

    def _is_wanted(self, name: str) -> bool:
        return self._wanted is None or any(matches_path(pattern, name) for pattern in self._wanted)

    def follow(self) -> list[Topic]:
        """Turns to the robots that are there now; the topics, if these are others than at the call before."""
        if self._hash != self._run.world.hash:
            self._renew()
        return self.chosen if self._is_new else []

    def messages(self) -> Iterator[tuple[str, bytes]]:
        """Topics and bytes of the messages at the present tick."""
        if self._is_new:
            self._is_new = False
            yield from self._named(self._core.latched(self._run.tick))
        yield from self._named(self._core.messages(self._run._simulations[0]))

    def _named(self, messages: list[tuple[int, bytes]]) -> Iterator[tuple[str, bytes]]:
        for number, message in messages:
            yield self._all[number].name, message
