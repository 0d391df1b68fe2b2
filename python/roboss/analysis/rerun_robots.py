"""Robots of a run as entities of Rerun: one for each robot, below it one for each link, with shapes and sensors."""
from __future__ import annotations

from collections import Counter
from typing import Any, Iterable, Iterator, Optional

import numpy as np
import rerun as rr
import rerun.blueprint as rrb

from ..journal import _Replay
from ..robots import Floats, Robots
from ..run import Run
from .messages import sensor_names
from .rerun_shapes import Scene, looks_of_journal, mount_of

ROBOTS = ("world", "robots")
_HELD = 2**20     # numbers of poses that are in memory before they are written
_NEAREST_M = 2.0  # from the eye to a lone robot, along x
_SAME = 1e-7      # of a pose: Rerun's numbers have 24 bits


class DrawnRobots:
    """The robots of a run in a recording stream, at each of its samples; also those that come and go.

    Args:
        stream: of the recording.
        run: whose present tick each sample shows.
        sensors: names of sensors, "car_3.laser", that have an entity of their own.
    """

    def __init__(self, stream: rr.RecordingStream, run: Run, sensors: Iterable[str]):
        self._stream, self._run, self._sensors = stream, run, frozenset(sensors)
        self._looks = looks_of_journal(run.world) if isinstance(run, _Replay) else None
        self._hash = ""
        self._parts: list[_Part] = []
        self._samples: list[tuple[np.timedelta64, list[Floats]]] = []  # time and the poses of each part
        self._mounts: dict[str, list[object]] = {}  # entity paths of the sensors
        self._shown: set[str] = set()               # names of robots
        self._has_scenery = False

    def path_of(self, sensor: str) -> Optional[list[object]]:
        """The entity path of a sensor, "car_3.laser"; None: it has no place on its robot."""
        return self._mounts.get(sensor)

    def add(self, stamp: np.timedelta64) -> None:
        """Takes the poses at the present tick. The stream's time is that already."""
        if self._run.world.hash != self._hash:
            self.flush()
            self._follow()
        self._samples.append((stamp, [part.read() for part in self._parts]))
        if len(self._samples) * sum(part.numbers for part in self._parts) >= _HELD:
            self.flush()

    def eye(self) -> Optional[rrb.EyeControls3D]:
        """From where all robots are in view, as they are now; None: there are none. Scenery may be endless."""
        places = np.concatenate([np.empty((0, 3)), *(part.places() for part in self._parts)])
        if not len(places):
            return None
        low, high = places.min(axis=0), places.max(axis=0)
        middle, reach = (low + high) / 2, _NEAREST_M + np.linalg.norm(high - low) / 2
        return rrb.EyeControls3D(position=middle + reach * np.array([-1, -1, 0.8]), look_target=middle, eye_up=[0, 0, 1])

    def flush(self) -> None:
        """Writes the poses that are in memory."""
        samples, self._samples = self._samples, []
        if samples:
            times = rr.TimeColumn("sim_time", duration=[stamp for stamp, _ in samples])
            for number, part in enumerate(self._parts):
                part.write(self._stream, times, np.array([poses[number] for _, poses in samples]))

    def _follow(self) -> None:
        """Turns to the world of the present tick: draws what has come, and clears what has gone."""
        world = self._run.world
        self._hash, scene = world.hash, Scene(world, self._looks or world._looks)
        for gone in self._shown - set(world.robots):
            self._stream.log([*ROBOTS, gone], rr.Clear(recursive=True))
        if not self._has_scenery:
            for name, shape in _by_name(scene.statics):
                self._stream.log(["world", "scenery", name], *scene.drawn(shape), static=True)
            self._has_scenery = True
        types: dict[int, list[int]] = {}
        for number, name in enumerate(world.robots):
            types.setdefault(world._types[number], []).append(number)
            if name not in self._shown:
                self._draw(scene, number)
        self._shown = set(world.robots)
        self._parts = [_Part(Robots(self._run, numbers)) for numbers in types.values()]

    def _draw(self, scene: Scene, number: int) -> None:
        """Logs the shapes and the chosen sensors of a robot."""
        robot, kind = Robots(self._run, [number]), scene.type_of(number)
        name, = robot.names
        for link in kind["links"]:
            for shape_name, shape in _by_name(link["visuals"]):
                self._stream.log([*ROBOTS, name, link["name"], "visuals", shape_name], *scene.drawn(shape))
        for place, sensor in enumerate(sensor_names(robot)):
            mount = mount_of(robot, place, kind) if f"{name}.{sensor}" in self._sensors else None
            if mount is not None:
                path: list[object] = [*ROBOTS, name, mount[0], sensor]
                self._mounts[f"{name}.{sensor}"] = path
                self._stream.log(path, *mount[1])


class _Part:
    """Robots of one type."""

    def __init__(self, robots: Robots):
        self._robots, self._links = robots, robots.links
        self._last = np.full((len(robots), 1 + len(self._links), 7), np.nan)  # that were written
        self.numbers = 7 * len(robots) * (1 + len(self._links))

    def places(self) -> Floats:
        """Positions of the robots at the present tick, (robots, 3)."""
        return np.array(self._robots.pose[:, :3])

    def read(self) -> Floats:
        """Poses of the robots and their links in the world at the present tick, (robots, 1 + links, 7)."""
        return np.stack([self._robots.pose, *(self._robots.link_pose(link) for link in self._links)], axis=1)

    def write(self, stream: rr.RecordingStream, times: rr.TimeColumn, poses: Floats) -> None:
        """Writes the poses of the robots in the world, and those of links on their robots. What has not moved since it was
        written last is left out."""
        poses[:, :, 1:] = relative(poses[:, :, :1], poses[:, :, 1:])
        moved = np.any(~(np.abs(poses - self._last) <= _SAME), axis=(0, 3))
        for row, place in np.argwhere(moved):
            path = [*ROBOTS, self._robots.names[row], *self._links[max(0, place - 1):place]]
            stream.send_columns(rr.new_entity_path(path), indexes=[times], columns=rr.Transform3D.columns(
                translation=poses[:, row, place, :3], quaternion=poses[:, row, place, 3:]), strict=True)
        self._last[moved] = poses[-1][moved]


def _by_name(shapes: list[dict[str, Any]]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Shapes with a name of its own each: of equal ones the second gets `_2`."""
    counts: Counter[str] = Counter()
    for shape in shapes:
        name = shape["name"] or "shape"
        counts[name] += 1
        yield name + (f"_{counts[name]}" if counts[name] > 1 else ""), shape


def relative(outer: Floats, inner: Floats) -> Floats:
    """Poses `inner` in the axes of the poses `outer`: (..., 7) each, x y z and a quaternion x y z w."""
    u, w = -outer[..., 3:6], outer[..., 6:]  # the inverse rotation
    moved, v, s = inner[..., :3] - outer[..., :3], inner[..., 3:6], inner[..., 6:]
    turned = moved + 2 * np.cross(u, np.cross(u, moved) + w * moved)
    scalar = w * s - np.sum(u * v, axis=-1, keepdims=True)
    return np.concatenate([turned, w * v + s * u + np.cross(u, v), scalar], axis=-1)
