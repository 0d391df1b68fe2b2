"""Journal: a recorded run; simulations at any of its times, exactly as it was."""
from __future__ import annotations

import os
from typing import Iterable, Iterator, Optional, Union

from . import _core
from .errors import JournalError
from .names import real
from .simulation import Simulation, threads_or_all
from .world import World


class Journal:
    """The file that `roboss run --journal FILE` writes, or a saved run. It is read only, also while a run writes it.

    A journal has branches: a run that went back and took another way begins a new one. `branch` is a number of
    `branches`; None: the youngest.

    Args:
        path: of the file.

    Raises:
        JournalError: there is no such file, it is no journal, or it is damaged.
    """

    def __init__(self, path: Union[str, os.PathLike]):
        self.path: str = os.fspath(path)  #: of the file
        self._core = _core.open_journal(self.path)
        self._worlds: dict[int, World] = {}

    @property
    def branches(self) -> tuple[_core.Branch, ...]:
        """Branches, by age: `id`, `parent`, `seed`, `reason`, `world_file`, `first_tick`, `last_tick`, `last_hash`."""
        return tuple(self._core.branches)

    def world(self, branch: Optional[int] = None) -> World:
        """The world of the branch, without its file."""
        found = self._branch(branch)
        if found.id not in self._worlds:
            self._worlds[found.id] = World(self._core.model(found.id), found.world_file, ())
        return self._worlds[found.id]

    def times(self, branch: Optional[int] = None) -> tuple[float, float]:
        """First and last time that the branch has, s."""
        found, dt = self._branch(branch), self.world(branch).dt
        return found.first_tick * dt, found.last_tick * dt

    def checkpoints(self, branch: Optional[int] = None) -> list[tuple[int, str]]:
        """(tick, state hash) of each checkpoint of the branch. Going to a time steps from the one before it."""
        return self._core.checkpoints(self._branch(branch).id)

    def at(self, time: float, branch: Optional[int] = None, *, follow: bool = True,
           threads: Optional[int] = None) -> Simulation:
        """The world at this time (s), as it was, to the last bit.

        Args:
            follow: the recorded orders from there on wait in the simulation, so stepping it goes through the recording;
                False: they are left out, so it goes its own way.
            threads: of the Simulation.

        Raises:
            JournalError: the branch does not have this time (code "no-such-time").
        """
        found, world = self._branch(branch), self.world(branch)
        tick = round(real("time", time) / world.dt)
        if not found.first_tick <= tick <= found.last_tick:
            first, last = self.times(branch)
            raise JournalError(f"branch {found.id} of '{self.path}' has no time {time:g} s",
                               f"give one from {first:g} to {last:g} s", "no-such-time")
        return Simulation._of(world, self._core.at(found.id, world._model, tick, follow, threads_or_all(threads)))

    def play(self, times: Iterable[float], branch: Optional[int] = None) -> Iterator[Simulation]:
        """Goes through the recording: a simulation at each of the ascending times, for tables and plots.

        It is one Simulation that is stepped on, so take what you need before the next time; of live views a copy.
        """
        sim = None
        for time in times:
            if sim is None or round(time / sim.dt) < sim.tick:
                sim = self.at(time, branch)
            elif round(time / sim.dt) > self._branch(branch).last_tick:
                raise JournalError(f"branch {self._branch(branch).id} of '{self.path}' has no time {time:g} s",
                                   code="no-such-time")
            sim.step(round(time / sim.dt) - sim.tick)
            yield sim

    def _branch(self, number: Optional[int]) -> _core.Branch:
        branches = self.branches
        found = [branch for branch in branches if number is None or branch.id == number]
        if not found:
            raise JournalError(f"'{self.path}' has no branch {number}",
                               f"it has {', '.join(str(branch.id) for branch in branches)}", "no-branch")
        return found[-1]

    def __repr__(self) -> str:
        return f"<roboss.Journal '{self.path}': {len(self.branches)} branches>"
