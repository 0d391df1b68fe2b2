"""Journal: a recorded run; simulations at any of its times, exactly as it was."""
from __future__ import annotations

import os
from typing import Any, Iterable, Iterator, Optional, Union

from . import _core
from .errors import JournalError, StateError
from .names import file_path, flag, real
from .simulation import Simulation, threads_or_all
from .world import World


class Journal:
    """The file that `roboss run --journal FILE` writes, or a saved run. It is read only, also while a run writes it.

    A journal has branches: a run that went back, or whose robots or accuracy were changed, continues in a new one. What
    led to a branch is in the branches before it (`lineage`), and everything here goes through them. `branch` is a number
    of `branches`; None: the youngest.

    Args:
        path: of the file.

    Raises:
        JournalError: there is no such file, it is no journal, or it is damaged.
    """

    def __init__(self, path: Union[str, os.PathLike]):
        self.path: str = file_path("path", path)  #: of the file
        self._core = _core.open_journal(self.path)
        self._worlds: dict[int, World] = {}

    @property
    def branches(self) -> tuple[_core.Branch, ...]:
        """Branches, by age: `id`, `parent`, `seed`, `reason`, `world_file`, `first_tick`, `last_tick`, `last_hash`."""
        return tuple(self._core.branches)

    def world(self, branch: Optional[int] = None) -> World:
        """The world of the branch, without its file. Those before it may have other robots: see `at`."""
        found = self._branch(branch)
        if found.id not in self._worlds:
            self._worlds[found.id] = World(self._core.model(found.id), found.world_file, (),
                                           loaded=self._core.world_hash(found.id))
        return self._worlds[found.id]

    def lineage(self, branch: Optional[int] = None) -> tuple[tuple[int, float, float], ...]:
        """Branches that led to this one, the oldest first: (number, first time, time at which the next continues), s."""
        found, dt = self._branch(branch), self.world(branch).dt
        return tuple((number, first * dt, until * dt) for number, first, until in self._core.lineage(found.id))

    def times(self, branch: Optional[int] = None) -> tuple[float, float]:
        """First and last time that the branch has, with what led to it, s."""
        parts = self.lineage(branch)
        return parts[0][1], parts[-1][2]

    def checkpoints(self, branch: Optional[int] = None) -> list[tuple[int, str]]:
        """(tick, state hash) of each checkpoint on the way to the end of the branch. Going to a time steps from the one
        before it."""
        parts = self._core.lineage(self._branch(branch).id)
        return [(tick, state_hash) for number, (part, _, until) in enumerate(parts)
                for tick, state_hash in self._core.checkpoints(part) if tick < until or number + 1 == len(parts)]

    def at(self, time: float, branch: Optional[int] = None, *, follow: bool = True,
           threads: Optional[int] = None) -> Simulation:
        """The world at this time (s), as it was, to the last bit, with the robots of then.

        Args:
            follow: the recorded orders from there on wait in the simulation, so stepping it goes through the recording,
                also where robots came or went: `world` then changes, and sets of robots that were asked for before raise
                StateError (code "changed-world"). False: they are left out, so it goes its own way.
            threads: of the Simulation.

        Raises:
            JournalError: the branch does not have this time (code "no-such-time"); the remedy names one that has.
        """
        found, dt = self._branch(branch), self.world(branch).dt
        tick = round(real("time", time) / dt)
        holder = self._core.holder(found.id, tick, dt)
        parts = self._core.lineage(found.id)
        if tick > parts[-1][2]:
            raise JournalError(f"branch {found.id} of '{self.path}' has nothing committed at {time:g} s",
                               f"give a time up to {parts[-1][2] * dt:g} s", "no-such-time")
        at = next(number for number, part in enumerate(parts) if part[0] == holder)
        core = self._part(parts[at], tick, flag("follow", follow), threads_or_all(threads))
        return _Replay._at(self, core, holder, parts[at + 1:] if follow else [])

    def play(self, times: Iterable[float], branch: Optional[int] = None) -> Iterator[Simulation]:
        """Goes through the recording: a simulation at each of the ascending times, for tables and plots.

        It is one Simulation that is stepped on, so take what you need before the next time; of live views a copy. Its
        `world` changes where robots came or went.
        """
        sim = None
        for time in times:
            time = real("times", time)
            if sim is None or round(time / sim.dt) < sim.tick or round(time / sim.dt) > round(self.times(branch)[1] / sim.dt):
                sim = self.at(time, branch)
            sim.step(round(time / sim.dt) - sim.tick)
            yield sim

    def _part(self, part: tuple[int, int, int], tick: int, follow: bool, threads: int) -> _core.Simulation:
        """The simulation at a tick of a part of a lineage."""
        return self._core.at(part[0], self.world(part[0])._model, tick, part[2], follow, threads)

    def _branch(self, number: Optional[int]) -> _core.Branch:
        branches = self.branches
        found = [branch for branch in branches if number is None or branch.id == number]
        if not found:
            raise JournalError(f"'{self.path}' has no branch {number}",
                               f"it has {', '.join(str(branch.id) for branch in branches)}", "no-branch")
        return found[-1]

    def __repr__(self) -> str:
        return f"<roboss.Journal '{self.path}': {len(self.branches)} branches>"


class _Replay(Simulation):
    """A simulation that goes through a recording, from one branch to the next."""

    _journal: Journal
    _branch: int  # in which it is
    _parts: list[tuple[int, int, int]]  # that are still to come

    @classmethod
    def _at(cls, journal: Journal, core: _core.Simulation, branch: int, parts: list[tuple[int, int, int]]) -> _Replay:
        replay = cls._of(journal.world(branch), core)
        replay._journal, replay._parts, replay._branch = journal, list(parts), branch
        return replay

    def _save_for_copy(self) -> _core.Save:
        if self._parts:
            raise StateError(f"a recording that continues in branch {self._parts[0][0]} has no copy of its own",
                             "keep the path and the time, or go there with follow=False", "recording")
        return super()._save_for_copy()

    def step(self, ticks: int = 1) -> None:
        end = self.tick + ticks
        while self._parts and self.tick < self._parts[0][1] <= end:
            super().step(self._parts[0][1] - self.tick)
            self._turn()
        super().step(end - self.tick)

    def reset(self, seed: Optional[int] = None) -> None:
        self._parts = []  # the recording is left
        super().reset(seed)

    def _may_change(self) -> None:
        super()._may_change()
        self._parts = []

    def _later(self, until: float) -> list[Simulation]:
        """Simulations of the parts to come that begin by that time, s, each at its beginning."""
        return [Simulation._of(self._journal.world(part[0]), self._journal._part(part, part[1], False, self.threads))
                for part in self._parts if part[1] * self.dt <= until + 1e-9]

    def _turn(self) -> None:
        """Continues in the next branch.

        Raises:
            StateError: orders or changes of this program have led elsewhere (code "own-way").
        """
        part, journal = self._parts[0], self._journal
        before, after = journal.world(self._branch), journal.world(part[0])
        core = journal._part(part, part[1], True, self.threads)
        ends = {branch.id: branch for branch in journal.branches}[self._branch]
        known = core.hash if before.hash == after.hash else ends.last_hash if ends.last_tick == part[1] else ""
        if known and self.state_hash != known:
            raise StateError(f"the simulation has left the recording, which continues in branch {part[0]} at {self.time:g} s",
                             "go there by Journal.at(), or leave the recording from the start: follow=False", "own-way")
        self._parts, self._branch = self._parts[1:], part[0]
        if before.hash == after.hash:
            self._core.restore(core.save())
            return
        self._core.retire()
        self.world = after
        self._take(core)
        if self._view is not None:
            self._view._show()
