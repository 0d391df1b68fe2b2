"""What render() of the environments shows: a frame of a camera, or the viewer's page."""
from __future__ import annotations

from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from ..camera import Camera
from ..names import unknown
from .task import Task

MODES = ["human", "rgb_array"]
_BEHIND = np.array([-6.0, 0.0, 3.5])  # m: where the camera is as the first agent sees it


class Picture:
    """Renders the first world of a task, behind its first agent.

    Args:
        mode: "rgb_array": render() gives a frame; "human": it opens the viewer's page; None: nothing.
    """

    def __init__(self, task: Task, mode: Optional[str], size: tuple[int, int] = (480, 320)):
        if mode is not None and mode not in MODES:
            raise unknown("render mode", mode, MODES)
        self.mode, self._task, self._size = mode, task, size
        self._camera: Optional[Camera] = None
        self._view: Any = None

    def render(self) -> Optional[NDArray[np.uint8]]:
        """A frame, (rows, columns, 3), or None. The viewer's page is opened once; its address is printed."""
        if self.mode == "rgb_array":
            return self._frame()
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

    def _frame(self) -> NDArray[np.uint8]:
        x, y, z, qx, qy, qz, qw = self._task._robots_of[0][0].pose[0]
        yaw = np.arctan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))
        turn = np.array([[np.cos(yaw), -np.sin(yaw), 0], [np.sin(yaw), np.cos(yaw), 0], [0, 0, 1]])
        at = np.array([x, y, z])
        if self._camera is None:
            self._camera = self._task.simulations[0].camera(at + turn @ _BEHIND, at, size=self._size)
        self._camera.position, self._camera.target = at + turn @ _BEHIND, at + turn @ [2.0, 0, 0.3]
        return self._camera.picture()
