"""Batch: many simulations, of one world or of several, on one pool of threads."""
from __future__ import annotations

import os
from typing import Any, Iterable, Iterator, Literal, Optional, Sequence, Union, overload

import numpy as np
from numpy.typing import NDArray

from . import _core
from .errors import ArgumentError, StateError
from .names import flag, listed, whole
from .padded import PaddedRobots
from .robots import Robots
from .simulation import Simulation, threads_or_all
from .world import World, load

_Source = Union[World, str, os.PathLike]


class Batch:
    """Simulations of one world, or one of each of several, each stepped by one thread at a time: for learning and sampling.

    `batch[i]` is a Simulation like any other: it can be stepped, saved, reset by itself. Their number is B, `len(batch)`.
    `batch[i:j]` is a Batch of some of them, not of copies; its `step` advances them one after the other.

    Args:
        world: a World, or what `load` takes; or a list of them, one for each simulation: other files, terrains, numbers
            of robots, with one `dt`.
        count: how many simulations; of a list None, or its length.
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

    _whole: Optional[tuple[Batch, range]] = None  # of which this is a part, and which

    def __init__(self, world: Union[_Source, Sequence[_Source]], count: Optional[int] = None, *,
                 threads: Optional[int] = None, seed: int = 0):
        self.worlds: tuple[World, ...] = _worlds_of(world, count)  #: of each simulation
        self._core = _core.batch([one._model for one in self.worlds], threads_or_all(threads), whole("seed", seed))
        self._take(self._core.simulations)
        for simulation, one in zip(self._simulations, self.worlds):
            simulation.see(one._looks, 1)

    def _take(self, simulations: list[_core.Simulation]) -> None:
        self._simulations, self._shape = simulations, (len(self.worlds),)
        self._is_alike = len({one.hash for one in self.worlds}) == 1

    def _part(self, numbers: range) -> Batch:
        """A Batch of the simulations of these numbers: the same, not copies."""
        if not numbers:
            raise ArgumentError(f"a part of this Batch without a simulation; it has {len(self)}",
                                "give a slice of at least one", "no-simulation")
        part = Batch.__new__(Batch)
        part.worlds, part._core, part._whole = tuple(self.worlds[n] for n in numbers), self._core, (self, numbers)
        part._take([self._simulations[n] for n in numbers])
        return part

    @property
    def world(self) -> World:
        """That they simulate; of several worlds, that of the first simulation."""
        return self.worlds[0]

    def __reduce__(self) -> tuple[Any, ...]:
        if self._whole is not None:
            return Batch._part, self._whole
        return _batch_of, (self.worlds, self.threads, [sim.save() for sim in self])

    def branch(self, count: int, *, threads: Optional[int] = None) -> Batch:
        """`count` copies of all simulations, which continue from this moment with the same bits; see Simulation.branch.

        Simulation k of copy i is `branches[i * B + k]`, copy i is `branches[i * B:(i + 1) * B]`.
        """
        return branch_of(self.worlds, [sim.save() for sim in self], whole("count", count, 1),
                         self.threads if threads is None else threads)

    def step(self, ticks: int = 1) -> NDArray[np.bool_]:
        """Advances all simulations by `ticks` time steps. Other threads of Python run meanwhile.

        Returns (B,): True where a simulation stopped, because a state would become infinite. It stays intact at the
        beginning of that tick; its own `step` says why, `reset` starts it again.
        """
        ticks = whole("ticks", ticks)
        if self._whole is None:
            return np.array(self._core.step(ticks), dtype=bool)
        return np.array([_stops(simulation, ticks) for simulation in self._simulations], dtype=bool)

    @overload
    def robots(self, wanted: Union[str, Iterable[str]] = "*", *, padded: Literal[False] = False) -> Robots: ...
    @overload
    def robots(self, wanted: Union[str, Iterable[str]] = "*", *, padded: Literal[True]) -> PaddedRobots: ...
    def robots(self, wanted: Union[str, Iterable[str]] = "*", *, padded: bool = False) -> Union[Robots, PaddedRobots]:
        """Robots of all simulations as arrays (B, N, ...); see Simulation.robots.

        If a robot refuses what is set, the simulations before its own have it already.

        Args:
            padded: of different worlds: arrays (B, most, ...) with empty rows where a simulation has fewer robots. Without
                it a Batch of different worlds raises ArgumentError (code "different-worlds").
        """
        if flag("padded", padded):
            return PaddedRobots(self, wanted)
        if not self._is_alike:
            raise ArgumentError("the simulations of this Batch are of different worlds", "ask for robots(..., padded=True), or "
                                "those of batch[i]", "different-worlds")
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

    def __iter__(self) -> Iterator[Simulation]:
        return (self[number] for number in range(len(self)))

    @overload
    def __getitem__(self, number: int) -> Simulation: ...
    @overload
    def __getitem__(self, number: slice) -> Batch: ...
    def __getitem__(self, number: Union[int, slice]) -> Union[Simulation, Batch]:
        if isinstance(number, slice):
            return self._part(range(len(self))[number])
        simulation = Simulation._of(self.worlds[number], self._simulations[number])
        simulation._batch = (self, number)
        return simulation

    def __repr__(self) -> str:
        return f"<roboss.Batch of {len(self)} simulations of {', '.join(sorted({repr(one.name) for one in self.worlds}))}>"


def _worlds_of(world: Union[_Source, Sequence[_Source]], count: Optional[int]) -> tuple[World, ...]:
    """The world of each simulation."""
    if isinstance(world, (World, str, os.PathLike)):
        one = world if isinstance(world, World) else load(world)
        return (one,) * whole("count", count, 1)
    given = listed("world", world)
    if not given or count not in (None, len(given)):
        raise ArgumentError(f"{len(given)} worlds for {count} simulations", "give as many worlds as simulations, or one world",
                            "wrong-count")
    worlds = tuple(one if isinstance(one, World) else load(one) for one in given)
    if len({one.dt for one in worlds}) > 1:
        raise ArgumentError(f"worlds with steps of {', '.join(sorted({f'{one.dt:g} s' for one in worlds}))}",
                            "load them with the same dt", "other-step")
    return worlds


def _stops(simulation: _core.Simulation, ticks: int) -> bool:
    """Steps it; whether it stopped."""
    try:
        simulation.step(ticks)
    except StateError as error:
        if error.code != "not-finite":
            raise
        return True
    return False


def branch_of(worlds: Sequence[World], saves: Sequence[_core.Save], count: int, threads: int) -> Batch:
    """A Batch of `count` copies of simulations of these worlds, each at its saved state."""
    return _batch_of(tuple(worlds) * count, threads, list(saves) * count)


def _batch_of(worlds: tuple[World, ...], threads: int, saves: list[_core.Save]) -> Batch:
    """The batch of its parts, for pickle."""
    batch = Batch(worlds, threads=threads)
    for simulation, save in zip(batch, saves):
        simulation.restore(save)
    return batch
