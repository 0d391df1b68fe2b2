"""Sensors: the readings of one sensor of many robots, in one call."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional, Union, cast

import numpy as np
from numpy.typing import NDArray

from . import _core
from .sensor_description import SensorDescription, describe

if TYPE_CHECKING:
    from .robots import Robots

#: Values that are points, vectors or quaternions one behind the other, by kind and name.
_ROWS = {("contact", "positions"): 3, ("contact", "normals"): 3, ("contact", "forces"): 3,
         ("link poses", "positions"): 3, ("link poses", "orientations"): 4,
         ("logical camera", "positions"): 3, ("logical camera", "orientations"): 4,
         ("box camera", "boxes"): 4, ("box camera", "positions"): 3, ("box camera", "orientations"): 4,
         ("box camera", "sizes"): 3}

Reading = Union[NDArray[Any], list[Any]]


class Sensor:
    """A sensor that all robots of a set have. `robots["scan"]` makes it.

    Attributes:
        name: as in the world file.
        kind: "laser", "gps", "imu", ...
        update_rate: of the first robot in the world file, Hz. It has no effect here: each `read` measures.
    """

    def __init__(self, robots: Robots, number: int, name: str, kind: str, update_rate: float, numbers: list[int]):
        self.robots, self.name, self.kind, self.update_rate = robots, name, kind, update_rate
        self._number, self._numbers = number, numbers  # among the sensors of the set, and on each robot
        self._described: Optional[SensorDescription] = None

    def read(self) -> NDArray[Any]:
        """The main value of the kind, (N, values): of a laser its ranges, (N, beams) in m; of a camera its images.

        Images are (N, rows, columns, 3) uint8 of a camera, (N, rows, columns) float32 in m of a depth camera, uint8 of
        a segmentation camera, float32 in K of a thermal camera. Ranges are `inf` where nothing is within reach, `-inf` where something is too near. Kinds with several values
        give the one that read_all() has first. Raises SensorError if it cannot measure.

        >>> sim = roboss.Simulation(roboss.example("city.sdf"))
        >>> cars = sim.robots("car_*")
        >>> cars["laser"].read().shape
        (50, 21)
        """
        values = self.read_all()
        name = "ranges" if "ranges" in values else next(iter(values))
        return cast(NDArray[Any], values[name])

    def read_all(self) -> dict[str, Reading]:
        """All values by name, with noise, at this tick. Units: docs/sensors.md.

        Numbers and vectors have robots as the first axis; quaternions are named "..._quat_xyzw". Where robots have
        different numbers of values (contact points, lasers with different numbers of beams), it is a list with an array
        for each robot (of a Batch: of the first simulation, then of the second ...). Images of different sizes raise
        SensorError (code "mixed-shapes").

        >>> cars = roboss.Simulation(roboss.example("city.sdf")).robots("car_*")
        >>> reading = cars["compass"].read_all()
        >>> list(reading)
        ['orientation_quat_xyzw', 'angular_velocity', 'magnetic_field', 'heading']
        >>> reading["orientation_quat_xyzw"].shape, reading["heading"].shape
        ((50, 4), (50,))
        """
        columns = _core.read(self.robots._simulations, list(self.robots.ids), self._numbers)
        return dict(self._shaped(*column) for column in columns if self._measures(*column))

    @property
    def units(self) -> dict[str, str]:
        """Units of the values of read_all(), by name; "" for counts, ratios, rotations."""
        columns = _core.read(self.robots._simulations, list(self.robots.ids[:1]), self._numbers[:1])
        return {self._shaped(name, *rest)[0]: rest[0] for name, *rest in columns if self._measures(name, *rest)}

    @property
    def description(self) -> SensorDescription:
        """What its arrays are of: place, parameters, and unit, frame and shape of each value, from the world's facts.

        Raises ArgumentError (code "mixed-types") if the sensors of the set differ: ask robots of one type.

        >>> cars = roboss.Simulation(roboss.example("city.sdf")).robots("car_*")
        >>> laser = cars["laser"].description
        >>> laser.values["ranges"]
        ValueDescription(name='ranges', unit='m', frame='sensor', shape=(21,), dtype='float64')
        >>> laser.link, laser.range, laser.column_angles[[0, -1]].round(2), laser.directions.shape
        ('chassis', (0.02, 6.0), array([-1.57,  1.57]), (21, 3))
        """
        if self._described is None:
            numbers = dict(zip((self.robots._world._types[robot] for robot in self.robots.ids),
                               zip(self.robots.ids, self._numbers)))
            facts = [_core.facts_of_sensor(self.robots._world._model, int(robot), number) for robot, number in numbers.values()]
            if any(other != facts[0] for other in facts[1:]):
                raise self.robots._mixed(f"have sensors '{self.name}' that differ", "ask robots of one type")
            columns = _core.read(self.robots._simulations[:1], list(self.robots.ids[:1]), self._numbers[:1])
            shaped = [(*self._shaped(*column, lead=(1,)), column[1]) for column in columns if self._measures(*column)]
            self._described = describe(self.name, facts[0], {name: value for name, value, _ in shaped},
                                       {name: unit for name, _, unit in shaped})
        return self._described

    def _measures(self, name: str, unit: str, kind: str, values, counts: list[int], image: list[int]) -> bool:
        """Whether a sensor of this type gives the value, in this world."""
        if kind == "image" or name == "intensities":
            return sum(counts) > 0
        boxed = self.kind == "box camera" and name in ("boxes", "positions", "orientations", "sizes")
        return not boxed or (name == "boxes") == (not self._is_3d)

    def _beams(self) -> tuple[str, NDArray, NDArray, NDArray]:
        """Of a laser: its link, its pose in the link (7,), the angles of columns and rows, rad."""
        link, pose, columns, rows = _core.laser_beams(self.robots._simulations[0], int(self.robots.ids[0]), self._numbers[0])
        return self.robots.links[link], np.array(pose), np.array(columns), np.array(rows)

    @property
    def _is_3d(self) -> bool:
        """Whether a box camera gives boxes in space."""
        return _core.box_type(self.robots._simulations[0], int(self.robots.ids[0]), self._numbers[0]) == "3d"

    def _shaped(self, name: str, unit: str, kind: str, values, counts: list[int], image: list[int],
                lead: Optional[tuple[int, ...]] = None) -> tuple[str, Reading]:
        width = _ROWS.get((self.kind, name), 1)
        if kind == "quat":
            name += "_quat_xyzw"
        elif width == 4 and name == "orientations":  # w x y z, one behind the other
            name += "_quat_xyzw"
            values = np.roll(np.reshape(values, (-1, 4)), -1, axis=1).ravel()
        lead = lead or (*self.robots.simulation._shape, len(counts) // len(self.robots._simulations))
        if kind == "image":
            return name, values.reshape(*lead, *(image if image[2] > 1 else image[:2]))
        if kind == "text":
            ends = np.cumsum([0] + counts)
            return name, [values[first:last] for first, last in zip(ends[:-1], ends[1:])]
        if kind in ("bool", "int"):
            values = values.astype(kind)
        if len(set(counts)) > 1:
            parts = np.split(values, np.cumsum(counts)[:-1])
            return name, [part.reshape(-1, width) if width > 1 else part for part in parts]
        if kind in ("float", "int", "bool"):
            return name, values.reshape(lead)
        return name, values.reshape(*lead, *((counts[0],) if width == 1 else (counts[0] // width, width)))
