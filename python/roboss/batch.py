"""Batch: many simulations of one world, on one pool of threads."""
from __future__ import annotations

import os
from typing import Any, Iterable, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _core
from .names import whole
from .robots import Robots
from .simulation import Simulation, threads_or_all
from .world import World, load


class Batch:
    """`count` simulations of one world, each stepped by one thread at a time: for learning and sampling.

    `batch[i]` is a Simulation like any other: it can be stepped, saved, reset by itself. Their number is B, `len(batch)`.

    Args:
        world: a World, or what `load` takes.
        count: how many simulations.
        threads: that step; None: one for each core that this process may use. No bit depends on it.
        seed: of sensor noise; simulation i has seed + i.

    >>> batch = roboss.Batch(roboss.example("crossroads.sdf"), 4, threads=2)
    >>> cars = batch.robots("car_*")
    >>> cars.set_joint_targets(np.arange(4.0)[:, None, None])     # rad/s, another speed in each simulation
    >>> batch.step(300).any()                                     # did one stop?
    np.False_
    >>> cars.pose.shape
    (4, 16, 7)
    >>> cars.joint_velocity[:, 0, 0].round(2)
    array([0., 1., 2., 3.])
    """

    def __init__(self, world: Union[World, str, os.PathLike], count: int, *, threads: Optional[int] = None,
                 seed: int = 0):
        count = whole("count", count, 1)
        self.world: World = world if isinstance(world, World) else load(world)  #: that they simulate
        self._core = _core.batch([self.world._model] * count, threads_or_all(threads), whole("seed", seed))
        self._simulations = self._core.simulations
        for simulation in self._simulations:
            simulation.see(self.world._looks, 1)
        self._shape = (count,)

    def __reduce__(self) -> tuple[Any, ...]:
        return _batch_of, (self.world, len(self), self.threads, [sim.save() for sim in self])

    def step(self, ticks: int = 1) -> NDArray[np.bool_]:
        """Advances all simulations by `ticks` time steps. Other threads of Python run meanwhile.

        Returns (B,): True where a simulation stopped, because a state would become infinite. It stays intact at the
        beginning of that tick; its own `step` says why, `reset` starts it again.
        """
        return np.array(self._core.step(whole("ticks", ticks)), dtype=bool)

    def robots(self, wanted: Union[str, Iterable[str]] = "*") -> Robots:
        """Robots of all simulations as arrays (B, N, ...); see Simulation.robots.

        If a robot refuses what is set, the simulations before its own have it already.
        """
        return Robots(self, self.world._find(wanted))

    def reset(self, chosen: Union[None, NDArray, Iterable[int]] = None) -> None:
        """Puts simulations back to the start of the world: those of a mask (B,) or of a list of numbers; None: all.

        >>> batch = roboss.Batch(roboss.example("crossroads.sdf"), 3)
        >>> _ = batch.step(10)
        >>> batch.reset([0, 2])
        >>> [sim.tick for sim in batch]
        [0, 10, 0]
        """
        numbers = np.arange(len(self)) if chosen is None else np.arange(len(self))[np.asarray(chosen)]
        for number in numbers:
            self._simulations[number].reset(None)

    @property
    def threads(self) -> int:
        """Threads that step."""
        return self._core.threads

    def __len__(self) -> int:
        return self._shape[0]

    def __getitem__(self, number: int) -> Simulation:
        simulation = Simulation._of(self.world, self._simulations[number])
        simulation._batch = (self, number)
        return simulation

    def __repr__(self) -> str:
        return f"<roboss.Batch of {len(self)} simulations of '{self.world.name}'>"


def _batch_of(world: World, count: int, threads: int, saves: list[_core.Save]) -> Batch:
    """The batch of its parts, for pickle."""
    batch = Batch(world, count, threads=threads)
    for simulation, save in zip(batch, saves):
        simulation.restore(save)
    return batch
