"""The map of a city of `roboss-world city`: crossings, lanes where cars can start, and the world with any number of cars."""
from __future__ import annotations

import re
from pathlib import Path
from typing import Iterable, Optional

import numpy as np
from numpy.typing import NDArray

from ..errors import ArgumentError
from ..world import World, example, load

PITCH_M, STREET_M = 12.0, 4.0
LANE_M = 0.7          # from the middle of the street
ALONG_M = (-3.0, -1.0, 1.0, 3.0)  # of the places between two crossings
MOST_CARS = 250       # in the city of the package
_BLOCK = re.compile(r"\bblock_(\d+)_(\d+)\b")
_CAR = re.compile(r'\s*<model name="car_\d+">\s*<pose>[^<]*</pose>(.*?)</model>', re.DOTALL)


class CityMap:
    """Crossings of streets, and places in their lanes.

    Args:
        names: of the city's scenery; its blocks "block_I_J" tell how large it is.

    Attributes:
        crossings: (C, 2): x, y in m.
        neighbours: crossings next to each one, a list for each.
        places: (P, 3): x, y in m and yaw in rad, in the right-hand lane.
        ends: (P, 2): the crossing behind and the crossing ahead of each place.
        half_size: (2,): from the middle to the outer edges of the outer streets, m.
    """

    def __init__(self, names: Iterable[str]):
        blocks = [tuple(map(int, found.groups())) for found in map(_BLOCK.search, names) if found]
        if not blocks:
            raise ArgumentError("the world is not a city: it has no models 'block_0_0' ...",
                                "make one: roboss-world city --cars 100 -o my_city.sdf", "no-city")
        columns, rows = np.max(blocks, axis=0) + 1
        self.half_size = 0.5 * (np.array([columns, rows]) * PITCH_M + STREET_M)
        first = 0.5 * STREET_M - self.half_size
        grid = [(i, j) for j in range(rows + 1) for i in range(columns + 1)]
        number = {place: index for index, place in enumerate(grid)}
        self.crossings = first + PITCH_M * np.array(grid, dtype=float)
        self.neighbours = [[number[side] for side in ((i + 1, j), (i, j + 1), (i - 1, j), (i, j - 1)) if side in number]
                           for i, j in grid]
        self._lay_lanes()

    def _lay_lanes(self) -> None:
        ends = np.array([(a, b) for a, sides in enumerate(self.neighbours) for b in sides])
        a, b = self.crossings[ends[:, 0]], self.crossings[ends[:, 1]]
        ahead = (b - a) / PITCH_M
        right = np.stack([ahead[:, 1], -ahead[:, 0]], axis=1)
        yaw = np.arctan2(ahead[:, 1], ahead[:, 0])
        lanes = [np.column_stack([0.5 * (a + b) + along * ahead + LANE_M * right, yaw]) for along in ALONG_M]
        self.places, self.ends = np.concatenate(lanes), np.tile(ends, (len(ALONG_M), 1))

    def keep(self, free: NDArray[np.bool_]) -> None:
        """Forgets the places that are not free."""
        self.places, self.ends = self.places[free], self.ends[free]

    def outside(self, count: int) -> NDArray[np.float64]:
        """Poses, (count, 7), behind the city's wall, where cars wait; a metre apart."""
        numbers = np.arange(count)
        poses = np.zeros((count, 7))
        poses[:, 0] = -self.half_size[0] - 8 - numbers // 40
        poses[:, 1] = numbers % 40 - 19.5
        poses[:, 6] = 1
        return poses


def city_world(cars: int, dt: Optional[float] = None) -> World:
    """The city of the package with this number of cars, which wait outside the wall.

    Raises:
        ArgumentError: less than one car, or too many for its streets.
    """
    if not 1 <= cars <= MOST_CARS:
        raise ArgumentError(f"{cars} cars in the city of the package, which has room for 1 to {MOST_CARS}",
                            "take several worlds, or make a larger city (roboss-world city --cars N -o FILE) and give it "
                            "as `world`", "too-many-cars")
    text = Path(example("city.sdf")).read_text(encoding="utf-8")
    body = _CAR.search(text).group(1)
    poses = CityMap(text.splitlines()).outside(cars)
    models = [f'\n<model name="car_{i}"><pose>{x} {y} 0 0 0 0</pose>{body}</model>' for i, (x, y) in enumerate(poses[:, :2])]
    scenery = _CAR.sub("", text)
    end = scenery.rindex("</world>")
    return load(scenery[:end] + "".join(models) + scenery[end:], dt=dt)
