"""Terrain for legged robots and vehicles, as static boxes of a WorldBuilder: stairs, gaps, rough ground, and a curriculum.

Each function adds one model to a builder and returns its Terrain. A strip begins at `start` (x y z of the middle of its
near edge, m) and runs along x; it is `width` wide, and its blocks reach down by `depth`, so nothing slips below them.

    >>> builder = roboss.WorldBuilder("course")
    >>> _ = builder.ground()
    >>> climb = roboss.terrain.stairs(builder, "climb", start=[1, 0, 0], steps=5, rise=0.1, run=0.3)
    >>> rubble = roboss.terrain.rough(builder, "rubble", start=climb.end, height=0.04, seed=3)
    >>> climb.height_at([1.4, 9.0], [0.0, 0.0])            # m; NaN: beyond the terrain
    array([0.2, nan])
    >>> world = builder.build()
"""
from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Callable, Iterable, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .builder import WorldBuilder
from .errors import ArgumentError
from .names import filled, real, whole
from .world import World

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Terrain:
    """What was added to a world.

    Attributes:
        blocks: (blocks, 5): least and largest x, least and largest y, and the height of each, m.
        end: x y z of the middle of the far edge, m: where the next terrain may start.
    """

    blocks: Floats
    end: tuple[float, float, float]

    def height_at(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Heights at points of the world, m; NaN where there is no block: a gap, or beyond the terrain. Of an edge it is
        that of the higher block."""
        x, y = np.broadcast_arrays(np.asarray(x, dtype=np.float64)[..., None], np.asarray(y, dtype=np.float64)[..., None])
        low_x, high_x, low_y, high_y, height = self.blocks.T
        over = (low_x <= x) & (x <= high_x) & (low_y <= y) & (y <= high_y)
        found = np.where(over, height, -np.inf).max(axis=-1)
        return np.where(np.isfinite(found), found, np.nan)


def stairs(builder: WorldBuilder, name: str, *, start: ArrayLike = (0, 0, 0), steps: int = 8, rise: float = 0.12,
           run: float = 0.3, width: float = 2.0, depth: float = 0.5, landing: float = 1.0, friction: float = 0.9) -> Terrain:
    """Steps up (down with a negative `rise`), then a landing of this length.

    Args:
        steps: how many.
        rise, run: height and length of a step, m.
    """
    x, y, z = filled("start", start, (3,))
    blocks = [(x + number * run, x + (number + 1) * run, z + (number + 1) * rise) for number in range(whole("steps", steps, 1))]
    top = z + steps * rise
    blocks.append((x + steps * run, x + steps * run + landing, top))
    return _added(builder, name, [(*block[:2], y - width / 2, y + width / 2, block[2]) for block in blocks],
                  min(z, top) - depth, friction, (x + steps * run + landing, y, top))


def gaps(builder: WorldBuilder, name: str, *, start: ArrayLike = (0, 0, 0), count: int = 4, gap: float = 0.2,
         stone: float = 0.5, width: float = 2.0, height: float = 0.3, friction: float = 0.9) -> Terrain:
    """Stones of this length and height with gaps between them. `count`: how many gaps."""
    x, y, z = filled("start", start, (3,))
    pitch = real("stone", stone) + real("gap", gap)
    blocks = [(x + number * pitch, x + number * pitch + stone, y - width / 2, y + width / 2, z + height)
              for number in range(whole("count", count, 1) + 1)]
    return _added(builder, name, blocks, z - 0.1, friction, (x + count * pitch + stone, y, z))


def rough(builder: WorldBuilder, name: str, *, start: ArrayLike = (0, 0, 0), length: float = 4.0, width: float = 2.0,
          cell: float = 0.25, height: float = 0.05, depth: float = 0.5, seed: int = 0, friction: float = 0.9) -> Terrain:
    """A field of square blocks of random heights, from 0 to `height` above the start. The same seed gives the same field.

    Args:
        cell: edge of a block, m; it divides length and width, or the field is a little larger.
    """
    x, y, z = filled("start", start, (3,))
    columns, rows = int(np.ceil(length / real("cell", cell, 1e-3) - 1e-9)), int(np.ceil(width / cell - 1e-9))
    heights = np.random.default_rng(whole("seed", seed)).uniform(0, real("height", height, 0), (columns, rows))
    blocks = [(x + i * cell, x + (i + 1) * cell, y + (j - rows / 2) * cell, y + (j + 1 - rows / 2) * cell, z + heights[i, j])
              for i in range(columns) for j in range(rows)]
    return _added(builder, name, blocks, z - depth, friction, (x + columns * cell, y, z))


def curriculum(make: Callable[[WorldBuilder, float], object], difficulties: Iterable[float],
               robots: Sequence[tuple[str, Union[str, os.PathLike], ArrayLike]] = (), *, dt: float = 0.002) -> list[World]:
    """A world for each difficulty, for a Batch of different worlds.

    Args:
        make: adds the terrain of a difficulty to a builder; the ground is there.
        difficulties: what `make` is given, usually from 0 to 1.
        robots: (name, file, pose) of what WorldBuilder.add puts into each world.
        dt: length of a tick, s.

    >>> worlds = roboss.terrain.curriculum(
    ...     lambda builder, hard: roboss.terrain.stairs(builder, "stairs", start=[1, 0, 0], rise=0.02 + 0.1 * hard),
    ...     [0, 0.5, 1], [("car", roboss.example("models/car/model.sdf"), [0, 0, 0.1])])
    >>> cars = roboss.Batch(worlds).robots("car", padded=True)
    >>> cars.pose.shape
    (3, 1, 7)
    """
    worlds = []
    for number, difficulty in enumerate(difficulties):
        builder = WorldBuilder(f"level_{number}", dt=dt)
        builder.ground()
        make(builder, real("difficulties", difficulty))
        for name, file, pose in robots:
            builder.add(name, file, pose=pose)
        worlds.append(builder.build())
    return worlds


def _added(builder: WorldBuilder, name: str, blocks: list[tuple[float, float, float, float, float]], bottom: float,
           friction: float, end: tuple[float, float, float]) -> Terrain:
    """The blocks as links of one static model, from `bottom` up to their heights."""
    array = np.array(blocks, dtype=np.float64)
    sizes = np.stack([array[:, 1] - array[:, 0], array[:, 3] - array[:, 2], array[:, 4] - bottom], axis=1)
    if not (np.isfinite(sizes).all() and (sizes > 0).all()):
        raise ArgumentError(f"terrain '{name}' has blocks of {np.round(sizes.min(axis=0), 6).tolist()} m", "give lengths above 0",
                            "bad-terrain")
    model = builder.model(name, static=True)
    for number, (size, block) in enumerate(zip(sizes, array)):
        model.box(f"block_{number}", size, pose=[block[:2].mean(), block[2:4].mean(), bottom + size[2] / 2], friction=friction)
    return Terrain(array, (float(end[0]), float(end[1]), float(end[2])))
