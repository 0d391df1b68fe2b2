"""What render() of the environments shows: a frame of a camera, or the viewer's page."""
from __future__ import annotations

from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from ..camera import Camera
from ..names import unknown
from .task import Task

MODES = ["human", "rgb_array"]
FRAMES = ["rgb_array"]     # of environments of many agents
SMALL = (240, 160)
_BEHIND = np.array([-6.0, 0.0, 3.5])  # m: where the camera is as the first agent sees it


class Picture:
    """Renders the worlds of a task, from behind its agents.

    Args:
        mode: "rgb_array": there are frames; "human": show() opens the viewer's page; None: nothing.
        modes: that there are.
        size: columns and rows of a frame.
    """

    def __init__(self, task: Task, mode: Optional[str], modes: list[str] = MODES, size: tuple[int, int] = (480, 320)):
        if mode is not None and mode not in modes:
            raise unknown("render mode", mode, modes)
        self.mode, self._task, self._size = mode, task, size
        self._cameras: dict[int, Camera] = {}  # by world
        self._view: Any = None

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_cameras": {}, "_view": None}  # a copy opens its own

    def render(self, agent: int = 0) -> Optional[NDArray[np.uint8]]:
        """A frame from behind this agent, (rows, columns, 3), or None. The viewer's page is opened once; its address is
        printed."""
        if self.mode == "rgb_array":
            return self._frame(agent)
        if self.mode == "human" and self._view is None:
            self._view = self._task.simulations[0].view(role="watch")
            print(f"roboss: viewer at {self._view.url}")
            self._view.open()
        return None

    def close(self) -> None:
        """Closes the page."""
        if self._view is not None:
            self._view.close()
            self._view = None

    def _frame(self, agent: int) -> NDArray[np.uint8]:
        world, row = divmod(agent, len(self._task.names))
        x, y, z, qx, qy, qz, qw = self._task._robots_of[world].pose[row]
        yaw = np.arctan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))
        turn = np.array([[np.cos(yaw), -np.sin(yaw), 0], [np.sin(yaw), np.cos(yaw), 0], [0, 0, 1]])
        at = np.array([x, y, z])
        position, target = at + turn @ _BEHIND, at + turn @ [2.0, 0, 0.3]
        if world not in self._cameras:
            self._cameras[world] = self._task.simulations[world].camera(position, target, size=self._size)
        camera = self._cameras[world]
        camera.position, camera.target = position, target
        return camera.picture()
