"""TaskEnv: one agent of a Task as a gymnasium.Env, with other agents that a program drives."""
from __future__ import annotations

from typing import Any, Callable, Optional

import gymnasium
import numpy as np
from numpy.typing import NDArray

from ..errors import ArgumentError, StateError
from .picture import MODES, Picture
from .task import Outcome, Task


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
        self.task, self._others = task, others
        self.render_mode, self._picture = render_mode, Picture(task, render_mode)
        self.metadata = {"render_modes": MODES, "render_fps": round(1 / task.step_s)}
        self.observation_space, self.action_space = task.observation_space, task.action_space
        self._seen: Optional[NDArray] = None

    @property
    def state_hash(self) -> str:
        """Simulation.state_hash of the world."""
        return self.task.state_hashes[0]

    def reset(self, *, seed: Optional[int] = None, options: Optional[dict[str, Any]] = None
              ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Starts the world again; the same seed gives the same observations and state hash. There are no options."""
        super().reset(seed=seed)
        self.task.reset(self.np_random, seed)
        self._seen = self.task.observations()
        return self._seen[0].copy(), {}

    def step(self, action: NDArray) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """One step of the world; see gymnasium.Env.step.

        Raises:
            StateError: the episode is over or has not begun (code "not-reset"), or as Simulation.step.
        """
        if self._seen is None or not self.task.present[0]:
            raise StateError("the episode is over, or has not begun", "call reset() first", "not-reset")
        actions = np.zeros((self.task.count, *self.action_space.shape))
        if self._others is not None:
            actions[:] = self._others(self._seen)
        actions[0] = action
        outcome = self.task.step(actions, self.np_random)
        self._replace(outcome)
        self._seen = self.task.observations()
        if outcome.finished[0]:
            self.task.leave(np.arange(self.task.count) == 0)
        infos = {name: values[0].item() if values.ndim == 1 else values[0] for name, values in outcome.infos.items()}
        return (self._seen[0].copy(), float(outcome.rewards[0]), bool(outcome.terminated[0]), bool(outcome.truncated[0]),
                infos)

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
        self._picture.close()

    def _replace(self, outcome: Outcome) -> None:
        """Starts other agents again whose episodes are over."""
        finished = outcome.finished.copy()
        finished[0] = False
        if finished.any():
            self.task.start(finished, self.np_random)
