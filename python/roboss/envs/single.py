"""TaskEnv: one agent of a Task as a gymnasium.Env, with other agents that a program drives."""
from __future__ import annotations

from typing import Any, Callable, Optional

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray

from ..errors import ArgumentError, StateError
from .branches import Branches, FirstAgent
from .picture import FRAMES, MODES, Picture
from .task import Task
from .vector import TaskVectorEnv, closed_error


class TaskEnv(gymnasium.Env):
    """The first agent of the task's only world.

    Args:
        task: one world.
        others: gives the actions of all agents, (count, ...), from their observations; it drives the other agents, which
            start again as soon as their episodes are over. None: the task has one agent.
        render_mode: of render(): "rgb_array": a frame from behind the agent, without a browser; "human": the viewer's
            page, opened by the first call.
    """

    metadata = {"render_modes": MODES, "render_fps": 20}

    def __init__(self, task: Task, others: Optional[Callable[[NDArray], NDArray]] = None,
                 render_mode: Optional[str] = None):
        if task.worlds != 1 or (others is None and task.count != 1):
            raise ArgumentError(f"a task of {task.worlds} worlds with {task.count} agents",
                                "give one world, and `others` if it has several agents")
        self.task, self._agent = task, FirstAgent(task, others)
        self.render_mode, self._picture = render_mode, Picture(task, render_mode)
        self.metadata = {"render_modes": MODES, "render_fps": round(1 / task.step_s)}
        self.observation_space, self.action_space = task.observation_space, task.action_space
        self.closed = False  #: close() was called

    @property
    def state_hash(self) -> str:
        """Simulation.state_hash of the world."""
        return self.task.state_hashes[0]

    def reset(self, *, seed: Optional[int] = None, options: Optional[dict[str, Any]] = None
              ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Starts the world again; the same seed gives the same observations and state hash. There are no options."""
        super().reset(seed=seed)
        self._agent.reset(self.np_random, seed)
        return self._agent.observations()[0], {}

    def step(self, action: NDArray) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """One step of the world; see gymnasium.Env.step.

        Raises:
            StateError: the episode is over or has not begun (code "not-reset"), or as Simulation.step.
        """
        self._check_begun()
        outcome = self._agent.step(np.asarray(action)[None], self.np_random)
        seen = self._agent.observations()[0]
        if outcome.finished[0]:
            self._agent.leave(outcome.finished)
        infos = {name: values[0].item() if values.ndim == 1 else values[0] for name, values in outcome.infos.items()}
        return seen, float(outcome.rewards[0]), bool(outcome.terminated[0]), bool(outcome.truncated[0]), infos

    def branch(self, count: int) -> TaskVectorEnv:
        """`count` copies that continue from this moment with the same bits, as one vector environment.

        Each is a world of its own: with its states, orders that wait, sensors, random numbers, the age of the episode,
        and a copy of what drives the others. They are stepped as a roboss.Batch, on the threads of this environment,
        which stays as it is. A copy that gets its actions has its observations, rewards and state hashes. A copy whose
        episode is over gets rewards of 0, until `reset(options={"reset_mask": mask})` starts its world again.

        Copies are of this environment, without wrappers around it: `env.unwrapped.branch(count)`.

        Raises:
            ArgumentError: `count` below 1.
            StateError: the episode is over or has not begun (code "not-reset"); the environment is closed ("closed");
                the task has a part that cannot be copied ("no-copy").

        >>> env = gymnasium.make("roboss/City-v0", traffic=3).unwrapped
        >>> _ = env.reset(seed=1)
        >>> branches = env.branch(5)
        >>> speeds = np.linspace(-1, 1, 5)
        >>> for _ in range(20):
        ...     _, _, _, _, infos = branches.step(np.stack([speeds, np.zeros(5)], axis=1))
        >>> int(infos["progress"].argmax()), env.task.simulation.tick       # full speed ahead gets nearest to the goal
        (4, 0)
        """
        if self.closed:
            raise closed_error()
        self._check_begun()
        branches = TaskVectorEnv(Branches(self._agent, self.np_random, count), AutoresetMode.DISABLED,
                                 self.render_mode if self.render_mode in FRAMES else None)
        branches._begin(self.np_random)
        return branches

    def render(self) -> Optional[NDArray[np.uint8]]:
        """A frame, (rows, columns, 3), in the mode "rgb_array"; None in the others.

        >>> env = gymnasium.make("roboss/City-v0", traffic=3, render_mode="rgb_array")
        >>> _ = env.reset(seed=1)
        >>> env.render().shape
        (320, 480, 3)
        """
        return self._picture.render()

    def close(self) -> None:
        """Closes the viewer's page, if there is one."""
        self.closed = True
        self._picture.close()

    def _check_begun(self) -> None:
        if not self._agent.present[0]:
            raise StateError("the episode is over, or has not begun", "call reset() first", "not-reset")
