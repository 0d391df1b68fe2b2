"""What can be recorded of a run: variables of robots, joints, links and sensors, by name."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, Iterable, Optional, Union

import numpy as np

from ..errors import ArgumentError, SensorError, UnknownNameError
from ..names import unknown
from ..robots import Floats, Robots
from ..run import Run
from .messages import AS_MESSAGES, WORLD_CONTACTS, MessageVariable, Messages, kinds_of, sensor_names
from .recording import POSE, TWIST, Column, matches

_Read = Callable[[Robots], Any]  # gives (N, parts)


@dataclass(frozen=True)
class _Kind:
    """A variable that all robots of a type have: its name behind the robot's, its parts, and how to read it."""

    name: str
    parts: tuple[tuple[str, str], ...]  # (name, unit); ("", unit) of one number
    frame: str
    read: _Read

    def columns(self, robot: str) -> list[Column]:
        variable = f"{robot}.{self.name}"
        return [Column(variable + (f".{part}" if part else ""), variable, unit, self.frame) for part, unit in self.parts]


class Variables:
    """Variables of a run that match patterns; `read` gives their values at the present tick.

    Names are ROBOT.WHAT: `car_3.pose`, `car_3.speed`, `arm.elbow.effort` (a joint), `arm.tool.pose` (a link),
    `car_3.laser.ranges` (a sensor). docs/analysis.md lists them. A pattern matches variables or
    single columns: `*.pose`, `car_3.pose.x`; `*` and `?` stop at dots, `**` does not: `car_3.**` is all of a robot.

    Args:
        run: a Simulation or RemoteSimulation.
        patterns: None: all.
        messages: choose messages, too: images, contact points, what radios heard (`messages`).
        every: time between two samples, s. Messages that would be incomplete, as those of radios, are left out (`left_out`).

    Raises:
        UnknownNameError: a pattern matches nothing.
        ArgumentError: a pattern matches only messages, which were not wanted (code "no-numbers"), or only such that are left
            out ("bad-value").
    """

    def __init__(self, run: Run, patterns: Union[str, Iterable[str], None] = None, messages: bool = False, every: float = 0.0):
        wanted = None if patterns is None else [patterns] if isinstance(patterns, str) else list(patterns)
        self.columns: list[Column] = []  #: of the arrays of read()
        self._parts: list[tuple[Robots, _Read, list[int]]] = []
        unmatched = set(wanted or ())
        known: list[str] = []
        for robots in _by_type(run):
            for kind in _kinds(robots):
                rows, places = [], []
                for row, robot in enumerate(robots.names):
                    columns = kind.columns(robot)
                    known.append(columns[0].variable)
                    hit = [p for p in wanted or () if any(matches(p, column) for column in columns)]
                    chosen = [wanted is None or any(matches(p, column) for p in hit) for column in columns]
                    unmatched -= set(hit)
                    if any(chosen):
                        rows.append(row)
                        places.append([len(self.columns) + n for n in range(len(columns))])
                        self.columns += columns
                if rows:
                    some = robots if len(rows) == len(robots) else robots[np.array(rows)]
                    self._parts.append((some, kind.read, [place for row in places for place in row]))
        self.messages = Messages(run)  #: those that match; of read_messages()
        self.left_out: list[str] = []  #: messages that match, but need samples more often
        unmatched = self._choose_messages(run, wanted, unmatched, known, messages, every)
        for pattern in unmatched:
            raise unknown("variable", pattern, known)
        self._chosen = [number for number, column in enumerate(self.columns)
                        if wanted is None or any(matches(p, column) for p in wanted)]
        self._all = len(self.columns)
        self.columns = [self.columns[number] for number in self._chosen]

    def _choose_messages(self, run: Run, wanted: Optional[list[str]], unmatched: set[str], known: list[str],
                         takes: bool, every: float) -> set[str]:
        """Adds the messages that match to self.messages, and all to the known names; gives the patterns that still match nothing."""
        if not takes and not unmatched:
            return unmatched  # sensors are not asked in vain
        chosen = Messages(run)

        seldom: dict[str, tuple[str, float]] = {}  # by pattern: a message that it matches, and its longest pause

        def fits(name: str, longest: float = np.inf) -> bool:
            known.append(name)
            hit = [pattern for pattern in wanted or () if matches(pattern, Column(name, name))]
            if takes and every > longest + 1e-9:
                seldom.update((pattern, (name, longest)) for pattern in hit)
                self.left_out += [name] if hit or wanted is None else []
                return False
            unmatched.difference_update(hit)
            return wanted is None or bool(hit)

        before = set(unmatched)
        if fits(WORLD_CONTACTS.name):
            chosen.add_world_contacts()
        for robots in _by_type(run):
            for kind in kinds_of(robots):
                rows = [row for row, robot in enumerate(robots.names) if fits(kind.variable(robot).name, kind.longest)]
                if rows:
                    chosen.add(robots if len(rows) == len(robots) else robots[np.array(rows)], kind)
        for pattern in unmatched & seldom.keys():
            name, longest = seldom[pattern]
            raise ArgumentError(f"'{name}' with {every:g} s between two samples: its sensor keeps messages for {longest:g} s",
                                f"sample at least every {longest:g} s (--every), or leave '{pattern}' out", "bad-value")
        if takes:
            self.messages = chosen
        elif before != unmatched:
            raise ArgumentError(f"'{min(before - unmatched)}' names messages, not numbers",
                                "write them into a file with `roboss record`, or analysis.record_file()", "no-numbers")
        return unmatched

    def read(self) -> Floats:
        """Values at the present tick, (columns,)."""
        out = np.empty(self._all)
        for robots, read, places in self._parts:
            values = np.asarray(read(robots), dtype=float).ravel()
            if values.size != len(places):
                raise ArgumentError(f"a sensor of '{robots.names[0]}' changed the number of its values", "leave it out",
                                    "changed-length")
            out[places] = values
        return out[self._chosen]


class ChangingVariables(Variables):
    """Variables of a recording in which robots come and go: columns of all of them, no number (nan) where one is not there.

    Args:
        run: that goes through the recording.
        later: a run of each world to come.
        others: as of Variables. A pattern has to match in one of the worlds.
    """

    def __init__(self, run: Run, later: Iterable[Run], patterns: Union[str, Iterable[str], None], messages: bool, every: float):
        wanted = None if patterns is None else [patterns] if isinstance(patterns, str) else list(patterns)
        self._run, self._options = run, {"messages": messages, "every": every}
        self._wanted: dict[str, Optional[list[str]]] = {}  # patterns that match, by world
        columns: dict[str, Column] = {}
        shown: dict[str, MessageVariable] = {}
        self.left_out = []
        for each in (run, *later):
            here = wanted if wanted is None else [pattern for pattern in wanted if self._matches(each, pattern)]
            self._wanted[each.world.hash] = here
            found = Variables(each, here, **self._options)
            columns.update((column.name, column) for column in found.columns if column.name not in columns)
            shown.update((variable.name, variable) for variable in found.messages.variables if variable.name not in shown)
            self.left_out += [name for name in found.left_out if name not in self.left_out]
        for pattern in wanted or ():
            if not any(pattern in here for here in self._wanted.values() if here is not None):
                Variables(run, [pattern], **self._options)  # raises: it matches nothing
        self.columns = list(columns.values())
        self.messages = _ChangingMessages(self, list(shown.values()))
        self._place = {name: number for number, name in enumerate(columns)}
        self._now, self._hash = Variables(run, self._wanted[run.world.hash], **self._options), run.world.hash

    def _matches(self, run: Run, pattern: str) -> bool:
        try:
            Variables(run, [pattern], **self._options)
        except UnknownNameError:
            return False
        return True

    def now(self) -> Variables:
        """Those of the present world."""
        if self._run.world.hash != self._hash:
            self._hash = self._run.world.hash
            self._now = Variables(self._run, self._wanted[self._hash], **self._options)
        return self._now

    def read(self) -> Floats:
        out = np.full(len(self.columns), np.nan)
        now = self.now()
        out[[self._place[column.name] for column in now.columns]] = now.read()
        return out


class _ChangingMessages(Messages):
    """Messages of a recording in which robots come and go; None where one is not there."""

    def __init__(self, of: ChangingVariables, variables: list[MessageVariable]):
        super().__init__(of._run)
        self.variables, self._of = variables, of

    def read(self) -> list[Any]:
        now = self._of.now().messages
        values = dict(zip((variable.name for variable in now.variables), now.read()))
        return [values.get(variable.name) for variable in self.variables]


def yaw(quat_xyzw: Floats) -> Floats:
    """Heading of orientations, (...,): rad, about z, from (..., 4)."""
    x, y, z, w = np.moveaxis(quat_xyzw, -1, 0)
    return np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def _by_type(run: Run) -> list[Robots]:
    """The robots of the run, a set for each type."""
    types: dict[int, list[int]] = {}
    for number, kind in enumerate(run.world._types):
        types.setdefault(kind, []).append(number)
    return [Robots(run, numbers) for numbers in types.values()]


def _kinds(robots: Robots) -> list[_Kind]:
    return [*_of_base(robots), *_of_joints(robots), *_of_links(robots), *_of_sensors(robots)]


def _of_base(robots: Robots) -> list[_Kind]:
    kinds = [_Kind("pose", POSE, "world", lambda r: r.pose)]
    for number, axis in enumerate("xyz"):
        kinds.append(_Kind(axis, (("", "m"),), "world", lambda r, n=number: r.pose[:, n]))
    kinds.append(_Kind("yaw", (("", "rad"),), "world", lambda r: yaw(r.pose[:, 3:])))
    if robots._facts.free_base:
        kinds += [_Kind("twist", TWIST, "world", lambda r: r.twist),
                  _Kind("speed", (("", "m/s"),), "", lambda r: np.linalg.norm(r.twist[:, :3], axis=1))]
    return kinds + [_Kind("energy", (("kinetic", "J"), ("potential", "J")), "", lambda r: r.energy),
                    _Kind("contacts", (("", ""),), "", _contacts),
                    _Kind("touching", (("", ""),), "", lambda r: r.touching)]


def _contacts(robots: Robots) -> Floats:
    """Contact points of each robot that carry a force."""
    contacts = robots.simulation.contacts
    count = np.bincount(contacts["robot_a"], minlength=len(robots._world.robots))
    others = contacts["robot_b"][contacts["robot_b"] >= 0]
    return (count + np.bincount(others, minlength=len(count)))[list(robots.ids)]


def _of_joints(robots: Robots) -> list[_Kind]:
    kinds = []
    for number, (joint, unit) in enumerate(zip(robots.joints, robots._facts.units)):
        effort, power = ("N", "W") if unit == "m" else ("N m", "W")
        kinds += [_Kind(f"{joint}.position", (("", unit),), "", lambda r, n=number: r.joint_position[:, n]),
                  _Kind(f"{joint}.velocity", (("", unit + "/s"),), "", lambda r, n=number: r.joint_velocity[:, n]),
                  _Kind(f"{joint}.effort", (("", effort),), "", lambda r, n=number: r.joint_effort[:, n]),
                  _Kind(f"{joint}.power", (("", power),), "",
                        lambda r, n=number: r.joint_effort[:, n] * r.joint_velocity[:, n])]
    return kinds


def _of_links(robots: Robots) -> list[_Kind]:
    kinds = []
    for link in robots.links:
        kinds += [_Kind(f"{link}.pose", POSE, "world", lambda r, n=link: r.link_pose(n)),
                  _Kind(f"{link}.twist", TWIST, "world", lambda r, n=link: r.link_twist(n))]
    return kinds


def _of_sensors(robots: Robots) -> list[_Kind]:
    kinds = []
    for number, name in enumerate(sensor_names(robots)):
        sensor = robots[:1]._sensor(number)
        if any(word in sensor.kind for word in AS_MESSAGES):
            continue
        try:
            readings, units = sensor.read_all(), sensor.units
        except SensorError:  # it cannot measure in this world
            continue
        for value, array in readings.items():
            if isinstance(array, np.ndarray) and array.dtype.kind in "fiub":
                count = array[0].size
                parts = tuple((str(n), units.get(value, "")) for n in range(count)) if array.ndim > 1 else \
                    (("", units.get(value, "")),)
                kinds.append(_Kind(f"{name}.{value}", parts, "", lambda r, n=number, v=value: r._sensor(n).read_all()[v]))
    return kinds
