"""TaskVectorEnv: the agents of a Task as the sub-environments of a gymnasium.vector.VectorEnv."""
from __future__ import annotations

import copy
from typing import Any, Optional, Union

import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from ..errors import ArgumentError, StateError
from .branches import Branches
from .picture import FRAMES, SMALL, Picture
from .task import Mask, Outcome, Task


class TaskVectorEnv(VectorEnv):
    """Sub-environment i is agent i of the task: agents of one world share it, and nothing else.

    An agent whose episode is over leaves its world, and comes back when its next episode starts. `reset` resets whole
    worlds; the autoreset mode says what happens to a single agent whose episode is over:

    - "NextStep": it starts at the end of the next step, which ignores its action and gives it a reward of 0.
    - "SameStep": it starts in the same step; `infos["final_obs"]` and `infos["final_info"]` are those of the old episode.
    - "Disabled": it stays out, with rewards of 0, until `reset(options={"reset_mask": mask})` starts it.

    `infos` has an array for each kind of info of the task, (num_envs,), and `infos["present"]`: who was in the world
    during the step.

    Args:
        task: the agents.
        autoreset_mode: a gymnasium.vector.AutoresetMode, or its value.
        render_mode: of render(): None, or "rgb_array": frames from behind the agents, without a browser.
    """

    def __init__(self, task: Task, autoreset_mode: Union[AutoresetMode, str] = AutoresetMode.NEXT_STEP,
                 render_mode: Optional[str] = None):
        self.task = task
        self.autoreset_mode = AutoresetMode(autoreset_mode)
        self.render_mode, self._picture = render_mode, Picture(task, render_mode, FRAMES, SMALL)
        self.metadata = {"autoreset_mode": self.autoreset_mode, "render_modes": FRAMES,
                         "render_fps": round(1 / task.step_s)}
        self.num_envs = task.count
        self.single_observation_space, self.single_action_space = task.observation_space, task.action_space
        self.observation_space = batch_space(task.observation_space, task.count)
        self.action_space = batch_space(task.action_space, task.count)
        self._was_reset = False

    @staticmethod
    def _agents_of_each(worlds: int, num_envs: int, agents: str, place: str) -> int:
        """How many agents each of the worlds has; the names are for the error."""
        if worlds < 1 or num_envs < 1 or num_envs % worlds:
            raise ArgumentError(f"{num_envs} {agents} in {worlds} {place}s", f"give as many {agents} to each {place}")
        return num_envs // worlds

    @property
    def state_hashes(self) -> tuple[str, ...]:
        """Simulation.state_hash of each world: equal hashes, equal worlds, to the last bit."""
        return self.task.state_hashes

    def reset(self, *, seed: Optional[int] = None, options: Optional[dict[str, Any]] = None
              ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Starts all worlds again, with all agents; or, with options={"reset_mask": mask}, only these agents.

        The same seed gives the same observations and state hashes. A mask is a bool array (num_envs,).
        """
        super().reset(seed=seed)
        if seed is not None:
            self.task._seed(self.np_random)
        mask = (options or {}).get("reset_mask")
        if mask is None:
            self.task.reset(self.np_random, seed)
        else:
            self._check(mask)
            self.task.start(mask, self.np_random)
        self._was_reset = True
        return self.task.observations(), {}

    def step(self, actions: NDArray) -> tuple[NDArray[np.float32], NDArray[np.float64], Mask, Mask, dict[str, Any]]:
        """One step of all agents; see gymnasium.vector.VectorEnv.step, and the modes above.

        Raises:
            StateError: it was not reset, or as Simulation.step.
        """
        if not self._was_reset:
            raise _not_reset()
        present = self.task.present.copy()
        outcome = self.task.step(actions, self.np_random)
        infos = with_masks({**outcome.infos, "present": present}, np.ones(self.num_envs, dtype=bool))
        if self.autoreset_mode == AutoresetMode.SAME_STEP and outcome.finished.any():
            infos = self._start_again(outcome, infos)
        elif self.autoreset_mode == AutoresetMode.NEXT_STEP and not present.all():
            self.task.start(~present, self.np_random)
        observations = self.task.observations()
        if self.autoreset_mode != AutoresetMode.SAME_STEP and outcome.finished.any():
            self.task.leave(outcome.finished)
        return observations, outcome.rewards, outcome.terminated, outcome.truncated, infos

    def branch(self, count: int) -> TaskVectorEnv:
        """`count` copies that continue from this moment with the same bits, as one environment: to try what may come.

        Sub-environments i * num_envs to (i + 1) * num_envs - 1 are copy i: worlds of its own, with their states, orders
        that wait, sensors, random numbers and ages of episodes. All worlds are stepped as a roboss.Batch, on the threads
        of this environment, which stays as it is. A copy that gets its calls has its observations, rewards and state
        hashes. `task.parts` are the copies of its task.

        Raises:
            ArgumentError: `count` below 1.
            StateError: it was not reset (code "not-reset"); it is closed ("closed"); the task has a part that cannot be
                copied ("no-copy").

        >>> cars = gymnasium.make_vec("roboss/City-v0", num_envs=4)
        >>> _ = cars.reset(seed=1)
        >>> branches = cars.branch(3)
        >>> actions = cars.action_space.sample()
        >>> _, rewards, *_ = cars.step(actions)
        >>> _, of_branches, *_ = branches.step(np.tile(actions, (3, 1)))
        >>> (of_branches.reshape(3, 4) == rewards).all(), set(branches.state_hashes) == set(cars.state_hashes)
        (np.True_, True)
        """
        if self.closed:
            raise closed_error()
        if not self._was_reset:
            raise _not_reset()
        branches = TaskVectorEnv(Branches(self.task, self.np_random, count), self.autoreset_mode, self.render_mode)
        branches._begin(self.np_random)
        return branches

    def _begin(self, rng: np.random.Generator) -> None:
        """It is amid an episode, with a copy of this generator."""
        self.np_random, self._was_reset = copy.deepcopy(rng), True

    def render(self) -> Optional[tuple[NDArray[np.uint8], ...]]:
        """A frame, (160, 240, 3), from behind each agent in the mode "rgb_array", as gymnasium.wrappers.vector.RecordVideo
        wants them; else None. A frame takes about 20 ms.

        >>> cars = gymnasium.make_vec("roboss/Soccer-v0", num_envs=2, cars=1, render_mode="rgb_array")
        >>> _ = cars.reset(seed=1)
        >>> [frame.shape for frame in cars.render()]
        [(160, 240, 3), (160, 240, 3)]
        """
        if self.render_mode is None:
            return None
        return tuple(self._picture.render(agent) for agent in range(self.num_envs))

    def _start_again(self, outcome: Outcome, infos: dict[str, Any]) -> dict[str, Any]:
        """Starts the finished agents; the infos with what they saw and were told last."""
        last = self.task.observations()
        final = np.full(self.num_envs, None, dtype=object)
        for agent in np.flatnonzero(outcome.finished):
            final[agent] = last[agent]
        told = {"final_obs": final, "final_info": with_masks(outcome.infos, outcome.finished)}
        self.task.start(outcome.finished, self.np_random)
        return {**infos, **with_masks(told, outcome.finished)}

    def _check(self, mask: Any) -> None:
        if not isinstance(mask, np.ndarray) or mask.shape != (self.num_envs,) or mask.dtype != np.bool_ or not mask.any():
            raise ArgumentError(f"a reset_mask of {getattr(mask, 'shape', mask)}, {getattr(mask, 'dtype', type(mask))}",
                                f"give an array of bool, ({self.num_envs},), with True for at least one agent", "bad-mask")
        if not self._was_reset:
            raise _not_reset()


def with_masks(infos: dict[str, Any], who: Mask) -> dict[str, Any]:
    """The infos, and for each "name" a "_name" that tells for which agents it holds, as Gymnasium has it."""
    return {**infos, **{f"_{name}": who.copy() for name in infos}}


def _not_reset() -> StateError:
    return StateError("the environment was not reset", "call reset() first", "not-reset")


def closed_error() -> StateError:
    """The error of an environment that can do nothing more."""
    return StateError("the environment is closed", "make it again, or call this before close()", "closed")
