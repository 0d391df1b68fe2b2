"""Branches: copies of a task that continue from one moment, in one Batch; FirstAgent: one agent of a task as a task."""
from __future__ import annotations

import copy
from typing import Any, Callable, Iterator, Optional, TypeVar, Union

import numpy as np
from numpy.typing import NDArray

from ..batch import Batch
from ..errors import RobossError, StateError
from ..simulation import Simulation
from .task import Mask, Results, Task

_T = TypeVar("_T")


class FirstAgent(Task):
    """The first agent of a task of one world as a task; a program drives the others, which come back when out.

    Args:
        task: one world.
        others: gives the actions of all agents, (count, ...), from their observations; None: the task has one agent.
    """

    def __init__(self, task: Task, others: Optional[Callable[[NDArray[Any]], NDArray[Any]]]):
        self.task, self._others = task, others  # Task.__init__ would make another world
        self.ticks, self.episode_steps = task.ticks, task.episode_steps
        self.observation_space, self.action_space = task.observation_space, task.action_space
        self._take(task.names[:1], task.simulation)
        self._first: Mask = np.arange(task.count) == 0
        self._seen: NDArray[np.float32]

    def reset(self, rng: np.random.Generator, seed: Optional[int] = None) -> None:
        self.task.reset(rng, seed)
        self.age[:], self.present[:] = 0, True

    def observe(self) -> NDArray[np.float32]:
        self._seen = self.task.observations()
        return self._seen[:1].copy()

    def place(self, agents: Mask, rng: np.random.Generator) -> None:
        """Starts the whole world again."""
        self.task.reset(rng)

    def remove(self, agents: Mask) -> None:
        self.task.leave(self._first)

    def act(self, actions: NDArray[np.float64]) -> None:
        every = np.zeros((self.task.count, *self.action_space.shape))
        if self._others is not None:
            every[:] = self._others(self._seen)
        every[0] = actions[0]
        self.task._give(every)

    def outcome(self, rng: np.random.Generator) -> Results:
        outcome = self.task._result(rng)
        replaced = outcome.finished & ~self._first
        if replaced.any():
            self.task.start(replaced, rng)
        return outcome.rewards[:1], outcome.terminated[:1], {name: values[:1] for name, values in outcome.infos.items()}


class Branches(Task):
    """Copies of a task at one moment, each with its own worlds, arrays and random numbers.

    Their worlds are one Batch. Rows and worlds of copy i follow those of copy i - 1.

    Args:
        task: the original, which stays as it is.
        rng: the generator of its environment.
        count: how many copies.

    Raises:
        ArgumentError: `count` below 1.
        StateError: its world is not simulated in this process (code "remote"), or it has a part that cannot be copied
            ("no-copy").

    Attributes:
        parts: the copies, with randomizers of their own, which continue the original's draws. `randomizer` is None.
    """

    def __init__(self, task: Task, rng: np.random.Generator, count: int):
        original = simulation_of(task)
        batch = original.branch(count)
        parts, rngs = (task.parts, task._rngs) if isinstance(task, Branches) else ([task], [rng])
        self.parts: list[Task] = []
        self._rngs: list[np.random.Generator] = []
        for first in range(0, len(batch), task.worlds):
            its = batch[first] if isinstance(original, Simulation) else batch[first:first + task.worlds]
            more, generators = copied((parts, rngs), {id(original): its})
            self.parts += more
            self._rngs += generators
        self.ticks, self.episode_steps = task.ticks, task.episode_steps
        self.observation_space, self.action_space = task.observation_space, task.action_space
        self._take(self.parts[0].names, batch)
        self.present[:] = np.concatenate([part.present for part in self.parts])
        self.age[:] = np.concatenate([part.age for part in self.parts])
        self._share()

    def _share(self) -> None:
        """The parts have their rows of the arrays `present` and `age`."""
        for part, rows, _ in self._each():
            part.present, part.age = self.present[rows], self.age[rows]

    def _each(self) -> Iterator[tuple[Task, slice, np.random.Generator]]:
        """The parts with their rows and random numbers."""
        each = self.count // len(self.parts)
        for number, (part, rng) in enumerate(zip(self.parts, self._rngs)):
            yield part, slice(number * each, (number + 1) * each), rng

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._share()

    def _seed(self, rng: np.random.Generator) -> None:
        self._rngs = [copy.deepcopy(rng) for _ in self.parts]

    def reset(self, rng: np.random.Generator, seed: Optional[int] = None) -> None:
        """Each part draws its own numbers: as the original would at the same moment, and as all after a seed."""
        for part, _, own in self._each():
            part.reset(own, seed)

    def observe(self) -> NDArray[np.float32]:
        return np.concatenate([part.observations() for part in self.parts])

    def place(self, agents: Mask, rng: np.random.Generator) -> None:
        for part, rows, own in self._each():
            if agents[rows].any():
                part._begin(agents[rows], own)

    def remove(self, agents: Mask) -> None:
        for part, rows, _ in self._each():
            if agents[rows].any():
                part.remove(agents[rows])

    def act(self, actions: NDArray[np.float64]) -> None:
        for part, rows, _ in self._each():
            part._give(actions[rows])

    def outcome(self, rng: np.random.Generator) -> Results:
        results = [part.outcome(own) for part, _, own in self._each()]
        rewards, terminated = (np.concatenate(arrays) for arrays in list(zip(*results))[:2])
        infos = {name: np.concatenate([result[2][name] for result in results]) for name in results[0][2]}
        return rewards, terminated, infos


def simulation_of(task: Task) -> Union[Simulation, Batch]:
    """That the task steps. Raises StateError if it is not in this process (code "remote")."""
    if not isinstance(task.simulation, (Simulation, Batch)):
        raise StateError(f"a task of a {type(task.simulation).__name__} has no branches",
                         "give it a Simulation or Batch of this process", "remote")
    return task.simulation


def copied(original: _T, instead: dict[int, Any]) -> _T:
    """A copy that shares nothing that changes, with other objects instead of those of these ids.

    Raises StateError if something in it cannot be copied (code "no-copy").
    """
    try:
        return copy.deepcopy(original, instead)
    except RobossError:
        raise
    except Exception as error:  # whatever a class of the user raises
        raise StateError(f"the task has a part that cannot be copied: {error}", "give its class a __deepcopy__, which "
                         "returns the object itself if it does not change", "no-copy") from error
