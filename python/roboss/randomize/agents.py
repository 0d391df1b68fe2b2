"""Agents: the robots of a Simulation or Batch in one row, with the names that their draws go by."""
from __future__ import annotations

from typing import Any, Iterator, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._core import Save
from ..batch import Batch
from ..errors import ArgumentError
from ..padded import PaddedRobots
from ..robots import Robots
from ..simulation import Simulation

Mask = NDArray[np.bool_]  #: (agents,)
Rows = NDArray[np.int64]  #: numbers of some agents


class Agents:
    """The robots that a Randomizer draws for. Agents of simulation i come after those of simulation i - 1."""

    def __init__(self, robots: Union[Robots, PaddedRobots]):
        self.simulations: list[Simulation]
        if isinstance(robots, PaddedRobots):
            self.simulations, self.members = _simulations_of(robots.batch), list(robots.members)
            self._mask = robots.mask
        elif isinstance(robots, Robots) and isinstance(robots.simulation, (Simulation, Batch)):
            of_batch = isinstance(robots.simulation, Batch)
            self.simulations = _simulations_of(robots.simulation)
            self.members = [Robots(one, robots.ids) for one in self.simulations] if of_batch else [robots]
            self._mask = np.ones(robots._rows, dtype=bool)
        else:
            raise ArgumentError(f"robots: {robots!r}", "give robots of a Simulation or a Batch", "bad-type")
        self._whole = robots if isinstance(robots, Robots) else None
        counts = [len(member) for member in self.members]
        if not any(counts):
            raise ArgumentError("no robots to randomise", "select some", "no-robot")
        if any(len(set(member.names)) < len(member) for member in self.members):
            raise ArgumentError("a robot is in the set twice", "give each robot once", "bad-rows")
        self.count = sum(counts)
        self.keys = [(number, name) for number, member in enumerate(self.members) for name in member.names]
        self._first = np.cumsum([0, *counts])
        self.dt = self.simulations[0].dt

    @property
    def some(self) -> list[Robots]:
        """Robots of each simulation that has some."""
        return [member for member in self.members if len(member)]

    def ticks(self) -> Rows:
        """The number of each agent's simulation, (agents,)."""
        return np.repeat([one.tick for one in self.simulations], np.diff(self._first))

    def parts(self, chosen: Mask) -> Iterator[tuple[Robots, Rows]]:
        """Robots that take arrays together, and the numbers of their agents."""
        if self._whole is not None and chosen.all():
            self._whole._check_current()
            yield self._whole, np.arange(self.count)
            return
        for member, first, last in zip(self.members, self._first, self._first[1:]):
            rows = np.flatnonzero(chosen[first:last])
            if rows.size:
                member._check_current()
                yield member if rows.size == last - first else member[rows], first + rows

    def mask(self, agents: Optional[ArrayLike]) -> Mask:
        """Makes a mask of agents of one of robots, as their arrays have it, of one of simulations, or of one of agents; None: all."""
        if agents is None:
            return np.ones(self.count, dtype=bool)
        given = np.asarray(agents)
        if given.dtype == np.bool_:
            if given.shape == (self.count,):
                return given.copy()
            if given.shape == self._mask.shape[:given.ndim] and given.ndim:
                given = given.reshape(given.shape + (1,) * (self._mask.ndim - given.ndim))
                return np.broadcast_to(given, self._mask.shape)[self._mask]
        raise ArgumentError(f"agents: an array of {given.dtype}, {given.shape}",
                            f"give an array of bool, {self._mask.shape}; or None", "bad-mask")

    def rows(self, what: str, values: NDArray[Any]) -> NDArray[Any]:
        """Values by agent, (agents, ...), of those as the robots' arrays have them, or of those by agent."""
        if values.ndim > self._mask.ndim and values.shape[:self._mask.ndim] == self._mask.shape:
            return values[self._mask]
        if values.ndim < 2 or len(values) != self.count:
            raise ArgumentError(f"{what} of shape {values.shape}",
                                f"give {self._mask.shape} rows, of one or more columns", "bad-shape")
        return values

    def shaped(self, rows: NDArray[Any], like: NDArray[Any]) -> NDArray[Any]:
        """Rows by agent in the shape of what `rows` was given."""
        if like.shape == rows.shape:
            return rows
        out = np.array(like, dtype=rows.dtype)
        out[self._mask] = rows
        return out

    def arrays(self, rows: NDArray[np.float64]) -> NDArray[np.float64]:
        """Rows by agent as the robots' arrays have them; NaN where there is no robot."""
        out = np.full((*self._mask.shape, rows.shape[1]), np.nan)
        out[self._mask] = rows
        return out

    @staticmethod
    def saves(robots: list[Robots]) -> list[tuple[Simulation, Save]]:
        """The saved states of these robots' simulations, with each simulation once."""
        found = {id(one._core): one for part in robots for one in _simulations_of(part.simulation)}
        return [(one, one.save()) for one in found.values()]


def _simulations_of(source: Union[Simulation, Batch]) -> list[Simulation]:
    return [source] if isinstance(source, Simulation) else [source[number] for number in range(len(source))]
