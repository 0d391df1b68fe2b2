"""Observation and action specs for learning, made from robots, with names, units and bounds of columns."""
from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Callable, Iterable, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import ArgumentError
from .names import filled, names_of, unknown

if TYPE_CHECKING:
    from .robots import Robots
    from .sensor_description import ValueDescription
    from .sensors import Sensor

Floats = NDArray[np.float64]
_Read = Callable[["Robots"], Sequence[Floats]]  # the present values of some Columns, in one go
_Part = tuple[Sequence["Columns"], _Read]


@dataclass(frozen=True, eq=False)
class Columns:
    """Columns that belong together: a sensor's reading, all joint positions ...

    Attributes:
        name: "joint_position", "twist", the name of a sensor, or of one of its values ("compass.heading").
        names: of the columns.
        unit: of all of them.
        frame: in whose axes they are, as ValueDescription.frame; "": they have no direction.
        low, high: bounds, (columns,); infinite where there are none.
    """

    name: str
    names: tuple[str, ...]
    unit: str
    frame: str
    low: Floats
    high: Floats


class _Spec:
    """Columns one behind the other."""

    parts: tuple[Columns, ...]  #: in the order of the columns

    @property
    def names(self) -> tuple[str, ...]:
        """Of all columns."""
        return tuple(name for part in self.parts for name in part.names)

    @property
    def units(self) -> tuple[str, ...]:
        """Of all columns."""
        return tuple(part.unit for part in self.parts for _ in part.names)

    @property
    def low(self) -> Floats:
        """Least values, (columns,)."""
        return np.concatenate([part.low for part in self.parts])

    @property
    def high(self) -> Floats:
        """Largest values, (columns,)."""
        return np.concatenate([part.high for part in self.parts])

    @property
    def space(self) -> Any:
        """The bounds of one robot as a gymnasium.spaces.Box of float32. Needs `roboss[envs]`."""
        from gymnasium.spaces import Box
        return Box(self.low.astype(np.float32), self.high.astype(np.float32))

    def __len__(self) -> int:
        return sum(len(part.names) for part in self.parts)

    def __repr__(self) -> str:
        parts = ", ".join(f"{part.name} ({len(part.names)}{' ' + part.unit if part.unit else ''})" for part in self.parts)
        return f"<roboss.{type(self).__name__} of {len(self)} columns: {parts}>"


class ObservationSpec(_Spec):
    """The observation of robots as one array. Robots.observation_spec makes it."""

    def __init__(self, robots: Robots, parts: Sequence[_Part]):
        self.parts = tuple(columns for group, _ in parts for columns in group)
        self._robots, self._reads = robots, [read for _, read in parts]

    def read(self) -> NDArray[np.float32]:
        """The present values, (N, columns), within the bounds: ranges without an echo are the largest one."""
        found = [values for read in self._reads for values in read(self._robots)]
        rows = self._robots._rows
        all_columns = np.concatenate([values.reshape(*rows, -1) for values in found], axis=-1)
        return np.clip(all_columns, self.low, self.high).astype(np.float32)


class ActionSpec(_Spec):
    """The actions of robots as one array. Robots.action_spec makes it."""

    def __init__(self, robots: Robots, columns: Columns, give: Callable[[Floats], None]):
        self.parts, self._robots, self._give = (columns,), robots, give

    def give(self, actions: ArrayLike) -> None:
        """Orders what the actions say from the next tick on, in the units of the columns; beyond the bounds: the bound.

        Args:
            actions: (N, columns); one row for all robots; one number.
        """
        values = filled("actions", actions, (*self._robots._rows, len(self)))
        self._give(np.clip(values, self.low, self.high))

    def give_scaled(self, actions: ArrayLike) -> None:
        """The same with numbers from -1 to 1, from the lower to the upper bound of each column.

        Raises ArgumentError (code "no-bounds") if a column has none.
        """
        if not np.isfinite([self.low, self.high]).all():
            free = [name for name, low, high in zip(self.names, self.low, self.high) if not np.isfinite([low, high]).all()]
            raise ArgumentError(f"{', '.join(free)}: there are no bounds to scale to", "give bounds, or use give()", "no-bounds")
        scaled = np.clip(filled("actions", actions, (*self._robots._rows, len(self))), -1, 1)
        self._give(self.low + 0.5 * (scaled + 1) * (self.high - self.low))


def observation_spec(robots: Robots, parts: Optional[Iterable[str]]) -> ObservationSpec:
    """See Robots.observation_spec."""
    known: dict[str, Callable[[], _Part]] = {
        "joint_position": lambda: _joints(robots, "joint_position"), "joint_velocity": lambda: _joints(robots, "joint_velocity"),
        "pose": lambda: _of_base("pose", ("x", "y", "z", "qx", "qy", "qz", "qw")),
        "twist": lambda: _of_base("twist", ("vx", "vy", "vz", "wx", "wy", "wz"))}
    sensors = {name: robots[name] for name in robots.sensors}
    if parts is None:
        names = [*(["joint_position", "joint_velocity"] if robots._facts.axes else []),
                 *(name for name, sensor in sensors.items() if _fits(sensor))]
    else:
        names = names_of("parts", parts)
    found: list[_Part] = []
    for name in names:
        if name in known:
            found.append(known[name]())
        elif name in sensors:
            found.append(_values(sensors[name]))
        else:
            raise unknown("part of an observation", name, [*known, *sensors])
    if not found:
        raise ArgumentError("an observation without columns", "name parts of it", "no-columns")
    return ObservationSpec(robots, found)


def action_spec(robots: Robots, mode: Optional[str], command: Optional[str], low: Optional[ArrayLike],
                high: Optional[ArrayLike]) -> ActionSpec:
    """See Robots.action_spec."""
    if (mode is None) == (command is None):
        raise ArgumentError("an action is the mode of the joints' motors or a command", "give mode or command")
    if command is not None:
        number = robots._command(command)
        name, fields, is_list, _ = robots._facts.commands[number]
        if is_list:
            raise ArgumentError(f"command '{name}' is a list of rows", "use Robots.command", "is-list")
        names, units = tuple(field for field, _ in fields), {unit for _, unit in fields}
        bounds = np.full((len(names), 2), [-np.inf, np.inf])
        unit = units.pop() if len(units) == 1 else ""
        return ActionSpec(robots, _bounded(name, names, unit, bounds, low, high), lambda values: robots.command(name, values))
    limits = robots._limits
    if mode == "position":
        bounds, unit = limits[:, :2], _one(robots._joint_facts.units)
    elif mode in ("velocity", "effort"):
        most = limits[:, 3 if mode == "velocity" else 2]
        bounds = np.stack([-most, most], axis=1)
        unit = _one([{"velocity": f"{own}/s", "effort": "N m" if own == "rad" else "N"}[mode] for own in robots._joint_facts.units])
    else:
        raise unknown("mode of an action", mode, ["position", "velocity", "effort"])
    columns = _bounded(mode, robots.joints, unit, bounds, low, high)
    return ActionSpec(robots, columns, lambda values: robots.set_joint_targets(values, mode=mode))


def _one(units: Sequence[str]) -> str:
    """The unit of all; "": they differ."""
    return units[0] if len(set(units)) == 1 else ""


def _bounded(name: str, names: tuple[str, ...], unit: str, bounds: Floats, low: Optional[ArrayLike],
             high: Optional[ArrayLike]) -> Columns:
    """Columns with their own bounds, or those that are given."""
    lower = bounds[:, 0] if low is None else filled("low", low, (len(names),))
    upper = bounds[:, 1] if high is None else filled("high", high, (len(names),))
    if not (lower < upper).all():
        raise ArgumentError(f"bounds from {lower.tolist()} to {upper.tolist()}", "the lower ones come first", "bad-bounds")
    return Columns(name, names, unit, "", lower, upper)


def _joints(robots: Robots, name: str) -> _Part:
    facts = robots._joint_facts
    unit, bounds = _one([f"{own}/s" for own in facts.units]), np.full((len(facts.axes), 2), [-np.inf, np.inf])
    if name == "joint_position":
        unit = _one(facts.units)
        if facts.limits is not None:
            bounds = np.array(facts.limits).reshape(-1, 4)[:, :2]
    # Velocities have no bounds: a limit is the motor's, and others may turn the joint faster.
    return [Columns(name, tuple(facts.axes), unit, "", bounds[:, 0], bounds[:, 1])], lambda set_: [getattr(set_, name)]


def _of_base(name: str, names: tuple[str, ...]) -> _Part:
    free = np.full(len(names), np.inf)
    return [Columns(name, names, "", "world", -free, free)], lambda set_: [getattr(set_, name)]


def _is_row(value: ValueDescription) -> bool:
    """Whether each reading is a number, or a row of as many numbers each time."""
    return None not in value.shape and value.dtype != "object" and len(value.shape) < 2


def _fits(sensor: Sensor) -> bool:
    """Whether all its values are rows of numbers."""
    return all(_is_row(value) for value in sensor.description.values.values())


def _values(sensor: Sensor) -> _Part:
    """The values of a sensor, which is read once for all of them; of a laser its ranges alone."""
    description, columns, wanted = sensor.description, [], []
    for value in description.values.values():
        if not _is_row(value):
            raise ArgumentError(f"sensor '{sensor.name}': its '{value.name}' is no row of numbers", "read it by itself",
                                "no-columns")
        if description.kind == "laser" and value.name != "ranges":
            continue
        free = np.full(value.shape[0] or 0 if value.shape else 1, np.inf)
        low, high = -free, free
        if value.name in ("ranges", "range") and description.range is not None:
            low, high = np.full_like(free, description.range[0]), np.full_like(free, description.range[1])
        one = sensor.name if description.kind == "laser" else f"{sensor.name}.{value.name}"
        names = tuple(f"{one}[{place}]" for place in range(len(free))) if value.shape else (one,)
        columns.append(Columns(one, names, value.unit, value.frame, low, high))
        wanted.append(value.name)
    return columns, _reader(sensor.name, wanted)


def _reader(sensor: str, wanted: Sequence[str]) -> _Read:
    def read(robots: Robots) -> list[Floats]:
        values = robots[sensor].read_all()
        return [np.asarray(values[name], dtype=np.float64) for name in wanted]
    return read
