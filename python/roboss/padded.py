"""PaddedRobots: robots of a Batch of different worlds as arrays, with empty rows where a simulation has fewer."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Iterable, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import ArgumentError
from .names import filled
from .robots import Robots

if TYPE_CHECKING:
    from .batch import Batch

Floats = NDArray[np.float64]


class PaddedRobots:
    """Robots of a Batch of different worlds. Batch.robots makes it; B is the number of simulations.

    Arrays are (B, most, ...) with `most` the largest number of robots in a simulation. Rows without a robot are NaN
    (False, 0), and ignored in what is set; `mask` says which are robots. All arrays are new ones. `members[i]` are the
    robots of simulation i as Robots, whose arrays have no empty rows: the same without padding.

    Joints are those that the robots of all worlds have, in one order.

    >>> worlds = [roboss.load(roboss.example(name)) for name in ("crossroads.sdf", "city.sdf")]
    >>> cars = roboss.Batch(worlds).robots("car_*", padded=True)
    >>> cars.pose.shape, cars.counts
    ((2, 50, 7), array([16, 50]))
    >>> cars.set_joint_targets(5.0)
    >>> _ = cars.batch.step(100)
    >>> cars["laser"].shape, bool(np.isnan(cars.pose[0, 16:]).all()), bool(cars.mask[0, 15])
    ((2, 50, 21), True, True)
    """

    def __init__(self, batch: Batch, wanted: Union[str, Iterable[str]]):
        self.batch = batch  #: that they are in
        wanted = wanted if isinstance(wanted, str) else list(wanted)
        ids = [world._find(wanted, may_be_none=True) for world in batch.worlds]
        if not any(ids):
            batch.worlds[0]._find(wanted)  # raises, with its names
        self.members: tuple[Robots, ...] = tuple(Robots(simulation, own) for simulation, own in zip(batch, ids))
        self.counts: NDArray[np.int64] = np.array([len(member) for member in self.members])  #: robots of each simulation, (B,)

    @property
    def mask(self) -> NDArray[np.bool_]:
        """Which rows of the arrays are robots, (B, most)."""
        return np.arange(self.counts.max())[None, :] < self.counts[:, None]

    @property
    def joints(self) -> tuple[str, ...]:
        """Columns of the arrays of joints. Raises ArgumentError (code "mixed-types") if worlds differ in them."""
        found = {member.joints for member in self._some}
        if len(found) > 1:
            raise ArgumentError("the robots of these worlds have different joints", "select robots with the same ones, or use "
                                "members", "mixed-types")
        return found.pop()

    @property
    def pose(self) -> Floats:
        """Poses, (B, most, 7), as Robots.pose."""
        return self._gather("pose")

    @pose.setter
    def pose(self, values: ArrayLike) -> None:
        self._assign("pose", values, 7)

    @property
    def twist(self) -> Floats:
        """Velocities of the bases, (B, most, 6), as Robots.twist."""
        return self._gather("twist")

    @twist.setter
    def twist(self, values: ArrayLike) -> None:
        self._assign("twist", values, 6)

    @property
    def joint_position(self) -> Floats:
        """Positions of the joints, (B, most, joints), as Robots.joint_position."""
        return self._of_joints("joint_position")

    @joint_position.setter
    def joint_position(self, values: ArrayLike) -> None:
        self._assign("joint_position", values, len(self.joints))

    @property
    def joint_velocity(self) -> Floats:
        """Velocities of the joints, (B, most, joints), as Robots.joint_velocity."""
        return self._of_joints("joint_velocity")

    @joint_velocity.setter
    def joint_velocity(self, values: ArrayLike) -> None:
        self._assign("joint_velocity", values, len(self.joints))

    @property
    def touching(self) -> NDArray[np.bool_]:
        """Whether each robot presses against something that does not carry it, (B, most), as Robots.touching."""
        return self._gather("touching")

    def set_joint_targets(self, targets: ArrayLike, joints: Union[str, Iterable[str], None] = None, *, mode: str = "velocity",
                          max_effort: Optional[float] = None) -> None:
        """Orders setpoints, (B, most, joints), as Robots.set_joint_targets."""
        columns = len(self.joints) if joints is None else 1 if isinstance(joints, str) else len(joints := list(joints))
        for member, rows in self._rows_of("targets", targets, columns):
            member.set_joint_targets(rows, joints, mode=mode, max_effort=max_effort)

    def apply_wrench(self, wrench: ArrayLike, link: Optional[str] = None, *, ticks: int = 1) -> None:
        """Pushes a link of each robot, (B, most, 6), as Robots.apply_wrench."""
        for member, rows in self._rows_of("wrench", wrench, 6):
            member.apply_wrench(rows, link, ticks=ticks)

    def command(self, name: str, values: ArrayLike) -> None:
        """Gives a command, (B, most, values), as Robots.command."""
        number = self._some[0]._command(name)
        for member, rows in self._rows_of(f"command '{name}'", values, len(self._some[0]._facts.commands[number][1])):
            member.command(name, rows)

    def __getitem__(self, sensor: str) -> NDArray[Any]:
        """The main value of a sensor that all have, (B, most, values): Sensor.read().

        Raises ArgumentError (code "mixed-types") if the worlds' sensors have different numbers of values; read `members`.
        """
        if not isinstance(sensor, str):
            raise ArgumentError(f"robots {sensor!r} of a Batch of different worlds", "give the name of a sensor, or use members")
        return self._padded(f"sensor '{sensor}'", {number: member[sensor].read() for number, member in enumerate(self.members)
                                                   if len(member)})

    def __len__(self) -> int:
        return len(self.members)

    def __repr__(self) -> str:
        return f"<roboss.PaddedRobots: {', '.join(map(str, self.counts[:8]))}{' ...' if len(self) > 8 else ''} robots>"

    @property
    def _some(self) -> list[Robots]:
        return [member for member in self.members if len(member)]

    def _of_joints(self, name: str) -> Floats:
        self.joints  # raises: they have the same
        return self._gather(name)

    def _gather(self, name: str) -> NDArray[Any]:
        return self._padded(name, {number: getattr(member, name) for number, member in enumerate(self.members) if len(member)})

    def _padded(self, what: str, parts: dict[int, Any]) -> NDArray[Any]:
        """One array of those of the simulations, by their number."""
        shapes = {np.asarray(part).shape[1:] for part in parts.values() if not isinstance(part, list)}
        if len(shapes) != 1 or any(isinstance(part, list) for part in parts.values()):
            raise ArgumentError(f"{what}: the robots have different numbers of values", "read members", "mixed-types")
        first = next(iter(parts.values()))
        empty = np.nan if first.dtype.kind == "f" else 0
        out = np.full((len(self.members), int(self.counts.max()), *shapes.pop()), empty, dtype=first.dtype)
        for number, part in parts.items():
            out[number, :len(part)] = part
        return out

    def _assign(self, name: str, values: ArrayLike, columns: int) -> None:
        for member, rows in self._rows_of(name, values, columns):
            setattr(member, name, rows)

    def _rows_of(self, what: str, values: ArrayLike, columns: int) -> list[tuple[Robots, Floats]]:
        """Each member with robots, and its rows of the values."""
        array = filled(what, values, (len(self.members), int(self.counts.max()), columns))
        return [(member, rows[:len(member)]) for member, rows in zip(self.members, array) if len(member)]

