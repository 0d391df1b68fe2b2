"""Task: what the agents of a world see, do and get. It knows neither Gymnasium's nor PettingZoo's calls."""
from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, Iterable, Optional, Union

import gymnasium
import numpy as np
from numpy.typing import NDArray

from ..batch import Batch
from ..errors import ArgumentError
from ..names import listed
from ..randomize import Randomizer, Term
from ..simulation import Simulation
from ..world import World

Mask = NDArray[np.bool_]  #: one truth value for each agent
Results = tuple[NDArray[np.float64], Mask, dict[str, NDArray[Any]]]  #: rewards, who is terminated, more arrays by name


@dataclass(frozen=True)
class Outcome:
    """What one step brought to each of `count` agents; agents that are not in the world have zeros.

    Attributes:
        rewards: (count,) float64.
        terminated: (count,): the agent's episode is over, because of what happened.
        truncated: (count,): it is over, because its time is up.
        infos: more arrays, (count, ...), by name.
    """

    rewards: NDArray[np.float64]
    terminated: Mask
    truncated: Mask
    infos: dict[str, NDArray[Any]]

    @property
    def finished(self) -> Mask:
        """Whose episode is over."""
        return self.terminated | self.truncated


class Task(ABC):
    """Agents of one world, or of a batch of equal worlds, as arrays with one row for each agent.

    The rows of world w are w * len(names) to (w + 1) * len(names) - 1. An agent is in the world from `start` to `leave`;
    the others are out of reach of all its sensors.

    A task of your own defines observe(), act(), outcome(), place() and remove(). The arrays of `robots` have an axis for the
    worlds if there are several; rows_of() and by_world() go back and forth.

    Args:
        world: a World.
        names: of the robots that are agents.
        observation_space, action_space: of one agent.
        worlds: how many equal worlds; more than one are stepped as a roboss.Batch.
        threads: that step; None: one for each core that this process may use. No bit depends on it.
        ticks: time steps of the world in a step of the environment.
        episode_steps: an episode is truncated after this number of steps.
        randomize: terms of roboss.randomize for the agents' robots: numbers of joints and links, kicks, pushes, noise
            of the observation, latency of actions. `randomizer` has what was drawn.
    """

    randomizer: Optional[Randomizer] = None  #: of the agents' robots, with the seed of the environment's reset

    def __init__(self, world: World, names: tuple[str, ...], observation_space: gymnasium.spaces.Box,
                 action_space: gymnasium.spaces.Box, *, worlds: int = 1, threads: Optional[int] = None, ticks: int = 25,
                 episode_steps: int = 1200, randomize: Iterable[Term] = ()):
        if worlds < 1 or ticks < 1 or episode_steps < 1:
            raise ArgumentError(f"{worlds} worlds, {ticks} ticks a step, {episode_steps} steps an episode", "give 1 or more")
        self.ticks, self.episode_steps = ticks, episode_steps
        self.observation_space, self.action_space = observation_space, action_space  #: of one agent
        self._take(names, Simulation(world, threads=threads) if worlds == 1 else Batch(world, worlds, threads=threads))
        if terms := listed("randomize", randomize):
            shape = observation_space.shape
            self.randomizer = Randomizer(self.robots, terms, observation_columns=shape[0] if len(shape) == 1 else None)

    def _take(self, names: tuple[str, ...], simulation: Union[Simulation, Batch]) -> None:
        """The agents are the robots of these names in this simulation."""
        self.names = tuple(names)  #: agents of each world
        self.simulation: Union[Simulation, Batch] = simulation
        self.robots = simulation.robots(self.names)  #: the agents' robots, of all worlds
        self.simulations: list[Simulation] = [simulation] if isinstance(simulation, Simulation) else list(simulation)
        self.worlds = len(self.simulations)
        self._robots_of = [simulation.robots(self.names) for simulation in self.simulations]
        self.present: Mask = np.zeros(self.count, dtype=bool)  #: who is in the world
        self.age = np.zeros(self.count, dtype=np.int64)  #: steps since each agent's start

    @property
    def count(self) -> int:
        """How many agents, of all worlds."""
        return self.worlds * len(self.names)

    @property
    def step_s(self) -> float:
        """Simulated time of a step, s."""
        return self.ticks * self.simulation.world.dt

    @property
    def state_hashes(self) -> tuple[str, ...]:
        """Simulation.state_hash of each world."""
        return tuple(simulation.state_hash for simulation in self.simulations)

    def reset(self, rng: np.random.Generator, seed: Optional[int] = None) -> None:
        """All worlds at their start, with other sensor noise, and all agents at new places.

        Args:
            seed: of the randomizer, which starts again with it; None: the randomizer continues.
        """
        of_noise = int(rng.integers(2**31))
        for number, simulation in enumerate(self.simulations):
            simulation.reset(of_noise + number)
        if self.randomizer is not None and (seed is not None or not self.randomizer.begun):
            self.randomizer.reseed(of_noise if seed is None else seed)
        self.present[:] = False
        self.start(np.ones(self.count, dtype=bool), rng)

    def start(self, agents: Mask, rng: np.random.Generator) -> None:
        """Begins a new episode of these agents; all others go on."""
        self.age[agents] = 0
        self._begin(agents, rng)
        self.present |= agents

    def _begin(self, agents: Mask, rng: np.random.Generator) -> None:
        """Places these agents, and draws what is drawn at the start of an episode."""
        self.place(agents, rng)
        if self.randomizer is not None:
            self.randomizer.reset(agents)

    def leave(self, agents: Mask) -> None:
        """Takes these agents out of the world."""
        self.remove(agents)
        self.present &= ~agents

    def step(self, actions: NDArray[Any], rng: np.random.Generator) -> Outcome:
        """Gives the agents' actions, (count, ...), advances all worlds by `ticks` and tells what came of it.

        Raises:
            StateError: as Simulation.step.
        """
        self._give(np.asarray(actions, dtype=np.float64))
        if isinstance(self.simulation, Batch):
            for number in np.flatnonzero(self.simulation.step(self.ticks)):
                self.simulations[number].step()  # raises: it stopped
        else:
            self.simulation.step(self.ticks)
        return self._result(rng)

    def _result(self, rng: np.random.Generator) -> Outcome:
        """Rewards, ends and infos of the agents after the worlds were stepped."""
        self.age += self.present
        rewards, terminated, infos = self.outcome(rng)
        truncated = self.present & ~terminated & (self.age >= self.episode_steps)
        return Outcome(rewards, terminated, truncated, infos)

    def _give(self, actions: NDArray[np.float64]) -> None:
        """Orders the actions, or those whose latency is over, and gives the kicks and pushes that are due."""
        if self.randomizer is not None:
            self.randomizer.update(self.present)
            actions = self.randomizer.delayed(actions)
        self.act(actions)

    def rows_of(self, values: NDArray[Any]) -> NDArray[Any]:
        """An array of `robots`, (N, ...) of one world or (worlds, N, ...) of several, with one row for each agent: (count, ...)."""
        return values.reshape(self.count, *values.shape[2 if isinstance(self.simulation, Batch) else 1:])

    def by_world(self, rows: NDArray[Any]) -> NDArray[Any]:
        """An array with one row for each agent, (count, ...), as `robots` takes it: (N, ...), or (worlds, N, ...) of several worlds."""
        several = isinstance(self.simulation, Batch)
        return rows.reshape(self.worlds, len(self.names), *rows.shape[1:]) if several else rows

    def _seed(self, rng: np.random.Generator) -> None:
        """Called when the environment gets a new seed, with its generator: for generators beside that one."""

    def observations(self) -> NDArray[np.float32]:
        """The observations that agents get, (count, ...): `observe`, with the noise of `randomize`, within the space."""
        seen = self.observe()
        if self.randomizer is None:
            return seen
        return self.randomizer.noisy(seen).clip(self.observation_space.low, self.observation_space.high)

    @abstractmethod
    def observe(self) -> NDArray[np.float32]:
        """The observation of each agent now, (count, ...). It may be called more than once at a tick, and changes
        nothing."""

    @abstractmethod
    def place(self, agents: Mask, rng: np.random.Generator) -> None:
        """Puts these agents at new places, at rest.

        Args:
            agents: (count,) bool.
            rng: the only source of random numbers, so that a seed repeats an episode.
        """

    @abstractmethod
    def remove(self, agents: Mask) -> None:
        """Puts these agents, (count,) bool, out of reach of all sensors, at rest."""

    @abstractmethod
    def act(self, actions: NDArray[np.float64]) -> None:
        """Orders what the agents that are present want, (count, ...) in the units of `action_space`; the others stand.

        It is called before the worlds are stepped, and not for single agents.
        """

    @abstractmethod
    def outcome(self, rng: np.random.Generator) -> Results:
        """Called after the worlds are stepped: rewards (count,), who is terminated (count,) bool, and more arrays (count, ...)
        by name, which Gymnasium gets as infos. Rows of agents that are not present are zero."""

    def put(self, agents: Mask, poses: NDArray[np.float64]) -> None:
        """Sets the poses of these agents' robots, (agents, 7): x y z in m, quaternion x y z w; joints at zero, all at rest."""
        done = 0
        for robots, chosen in zip(self._robots_of, agents.reshape(self.worlds, -1)):
            rows = np.flatnonzero(chosen)
            if rows.size:
                some = robots[rows]
                some.pose = poses[done:done + rows.size]
                some.twist = 0
                some.joint_position = 0
                some.joint_velocity = 0
                done += rows.size
