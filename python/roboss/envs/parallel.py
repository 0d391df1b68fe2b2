"""TaskParallelEnv: the agents of a Task as a pettingzoo.ParallelEnv, by name."""
from __future__ import annotations

from typing import Any, Optional

import gymnasium
import numpy as np
from gymnasium.utils import seeding
from numpy.typing import NDArray
from pettingzoo import ParallelEnv

from ..errors import ArgumentError, StateError
from ..simulation import Simulation
from .branches import copied, simulation_of
from .city import CityTask
from .picture import FRAMES, Picture
from .soccer import SoccerTask
from .task import Task
from .vector import closed_error
from .warehouse import WarehouseTask


ByAgent = dict[str, Any]  # by the agents' names


class TaskParallelEnv(ParallelEnv):
    """All agents of the task's only world. An agent whose episode is over leaves the world until the next reset.

    Args:
        task: one world.
        name: of the environment.
        render_mode: of render(): None, or "rgb_array": frames without a browser.
    """

    def __init__(self, task: Task, name: str, render_mode: Optional[str] = None):
        if task.worlds != 1:
            raise ArgumentError(f"a task of {task.worlds} worlds", "give one world; TaskVectorEnv takes several")
        self.task = task
        self.metadata = {"name": name, "render_modes": FRAMES, "is_parallelizable": True,
                         "render_fps": round(1 / task.step_s)}
        self.render_mode, self._picture = render_mode, Picture(task, render_mode, FRAMES)
        self.possible_agents = list(task.names)
        self.agents: list[str] = []
        self._observation_spaces = {agent: _copy(task.observation_space) for agent in self.possible_agents}
        self._action_spaces = {agent: _copy(task.action_space) for agent in self.possible_agents}
        self._rows = {agent: row for row, agent in enumerate(self.possible_agents)}
        self._rng, _ = seeding.np_random()
        self.closed = False  #: close() was called

    def observation_space(self, agent: str) -> gymnasium.spaces.Box:
        """What the agent sees."""
        return self._observation_spaces[agent]

    def action_space(self, agent: str) -> gymnasium.spaces.Box:
        """What the agent can do."""
        return self._action_spaces[agent]

    @property
    def state_hash(self) -> str:
        """Simulation.state_hash of the world."""
        return self.task.state_hashes[0]

    def reset(self, seed: Optional[int] = None, options: Optional[dict[str, Any]] = None
              ) -> tuple[dict[str, NDArray[np.float32]], dict[str, dict[str, Any]]]:
        """Starts the world again, with all agents; the same seed gives the same observations. There are no options."""
        if seed is not None:
            self._rng, _ = seeding.np_random(seed)
        self.agents = list(self.possible_agents)
        self.task.reset(self._rng, seed)
        return self._by_name(self.task.observations()), {agent: {} for agent in self.agents}

    def step(self, actions: dict[str, NDArray[Any]]) -> tuple[ByAgent, ByAgent, ByAgent, ByAgent, ByAgent]:
        """One step of the world; agents of which no action is given get zeros. See pettingzoo.ParallelEnv.step.

        Raises:
            StateError: there is no agent (code "not-reset"), or as Simulation.step.
        """
        self._check_begun()
        rows = np.zeros((self.task.count, *self.task.action_space.shape))
        for agent in self.agents:
            if agent in actions:
                rows[self._rows[agent]] = actions[agent]
        outcome = self.task.step(rows, self._rng)
        seen = self._by_name(self.task.observations())
        rewards, terminated, truncated = (
            {agent: values[self._rows[agent]].item() for agent in self.agents}
            for values in (outcome.rewards, outcome.terminated, outcome.truncated))
        infos = {agent: {name: values[self._rows[agent]] for name, values in outcome.infos.items()} for agent in self.agents}
        if outcome.finished.any():
            self.task.leave(outcome.finished)
            self.agents = [agent for agent in self.agents if not outcome.finished[self._rows[agent]]]
        return seen, rewards, terminated, truncated, infos

    def state(self) -> NDArray[np.float64]:
        """Poses and twists of all robots of the agents, (agents, 13): as Robots.pose and Robots.twist."""
        return np.concatenate([self.task.robots.pose, self.task.robots.twist], axis=1)

    def render(self) -> Optional[NDArray[np.uint8]]:
        """A frame, (320, 480, 3), from behind the first agent that is left, in the mode "rgb_array"; else None.

        `env.task.simulations[0].view()` shows the world in the browser.
        """
        return self._picture.render(self._rows[self.agents[0]] if self.agents else 0)

    def branch(self, count: int) -> list[TaskParallelEnv]:
        """`count` copies that continue from this moment with the same bits; this environment stays as it is.

        Each has a world of its own, with its states, orders that wait, sensors, random numbers and ages of episodes.
        Their worlds are one roboss.Batch; each is stepped by one thread, several of them in several threads of Python.

        Raises:
            ArgumentError: `count` below 1.
            StateError: no agent is in the world (code "not-reset"); it is closed ("closed"); it has a part that
                cannot be copied ("no-copy").

        >>> env = roboss.envs.CityParallelEnv(cars=4)
        >>> _ = env.reset(seed=1)
        >>> one, other = env.branch(2)
        >>> action = np.array([1, 0], dtype=np.float32)
        >>> _ = one.step({"car_0": action}), other.step({"car_0": -action})
        >>> one.task.simulation.tick, env.task.simulation.tick
        (25, 0)
        """
        if self.closed:
            raise closed_error()
        self._check_begun()
        original = simulation_of(self.task)
        assert isinstance(original, Simulation)  # of one world
        return [copied(self, {id(original): simulation}) for simulation in original.branch(count)]

    def close(self) -> None:
        """Nothing has to be released."""
        self.closed = True

    def _check_begun(self) -> None:
        if not self.agents:
            raise StateError("no agent is in the world", "call reset() first", "not-reset")

    def _by_name(self, rows: NDArray) -> dict[str, NDArray]:
        return {agent: rows[self._rows[agent]].copy() for agent in self.agents}


class CityParallelEnv(TaskParallelEnv):
    """Cars in a city, by name: "car_0", "car_1" ... A car that touches something leaves the city.

    Args:
        cars: how many.
        render_mode: None or "rgb_array".
        options: as those of CityTask, but for `worlds`.

    >>> env = roboss.envs.CityParallelEnv(cars=8)
    >>> observations, _ = env.reset(seed=1)
    >>> observations["car_3"].shape
    (29,)
    >>> _ = env.step({agent: env.action_space(agent).sample() for agent in env.agents})
    """

    def __init__(self, cars: int = 16, render_mode: Optional[str] = None, **options: Any):
        super().__init__(CityTask(cars, **options), "roboss_city_v0", render_mode)


class SoccerParallelEnv(TaskParallelEnv):
    """Two teams of cars and a ball: "red_0" ..., "blue_0" ... All agents finish at the same time.

    Args:
        cars: of each team.
        render_mode: None or "rgb_array".
        options: as those of SoccerTask, but for `worlds`.

    >>> env = roboss.envs.SoccerParallelEnv(cars=2)
    >>> _ = env.reset(seed=1)
    >>> env.agents
    ['red_0', 'red_1', 'blue_0', 'blue_1']
    """

    def __init__(self, cars: int = 3, render_mode: Optional[str] = None, **options: Any):
        super().__init__(SoccerTask(cars, **options), "roboss_soccer_v0", render_mode)


class WarehouseParallelEnv(TaskParallelEnv):
    """Carriers in a warehouse, by name: "carrier_0" ... A carrier that touches something leaves the hall.

    One that charges stays in `agents`: `infos[agent]["in_service"]` tells whether its next action counts.

    Args:
        carriers: how many.
        render_mode: None or "rgb_array".
        options: as those of WarehouseTask, but for `worlds`.

    >>> env = roboss.envs.WarehouseParallelEnv(carriers=4)
    >>> observations, _ = env.reset(seed=1)
    >>> observations["carrier_3"].shape
    (33,)
    """

    def __init__(self, carriers: int = 8, render_mode: Optional[str] = None, **options: Any):
        super().__init__(WarehouseTask(carriers, **options), "roboss_warehouse_v0", render_mode)


def _copy(space: gymnasium.spaces.Box) -> gymnasium.spaces.Box:
    return type(space)(space.low, space.high, dtype=space.dtype)
