"""Camera: pictures of a simulation without a browser, by rays against the shapes that collide."""
from __future__ import annotations

from typing import TYPE_CHECKING, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .errors import ArgumentError
from .names import filled

if TYPE_CHECKING:
    from .remote import RemoteSimulation
    from .simulation import Simulation

_SUN = np.array([0.4, -0.3, 0.87]) / np.linalg.norm([0.4, -0.3, 0.87])  # towards it
_SKY, _HAZE, _SCENERY = np.array([150, 185, 225.0]), np.array([232, 238, 244.0]), np.array([176, 172, 162.0])
_ROBOTS = np.array([[222, 96, 38], [46, 110, 170], [90, 150, 70], [200, 160, 40], [140, 80, 150], [60, 150, 150.0]])


class Camera:
    """A camera at rest that looks from `position` to `target`, with z upwards. Simulation.camera makes it.

    It draws collision shapes, robots of a type in one colour, with the shadows of a sun. The page of
    Simulation.view draws the visuals of the file; cameras are for films and frames where there is no browser.

    Attributes:
        position, target: m, world; may be assigned between two pictures.

    >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
    >>> camera = sim.camera([12, -12, 8], [0, 0, 0], size=(160, 120))
    >>> camera.picture().shape                 # rows, columns, red green blue
    (120, 160, 3)
    >>> float(camera.depth()[60, 80].round(1))  # m, in the middle
    18.6
    """

    def __init__(self, simulation: Union[Simulation, RemoteSimulation], position: ArrayLike, target: ArrayLike,
                 size: tuple[int, int], fov: float, far: float):
        self.position, self.target = filled("position", position, (3,)), filled("target", target, (3,))
        if not (len(size) == 2 and min(size) > 0 and 0 < fov < np.pi and far > 0):
            raise ArgumentError(f"a camera of size {size}, fov {fov} and far {far}",
                                "give columns and rows above 0, an angle between 0 and pi, and a distance above 0")
        self._simulation, self._far = simulation, far
        columns, rows = size
        across = np.tan(fov / 2) * (np.arange(columns) - (columns - 1) / 2) * 2 / columns
        upwards = -np.tan(fov / 2) * (np.arange(rows) - (rows - 1) / 2) * 2 / columns
        self._plane = np.stack(np.broadcast_arrays(across[None, :], upwards[:, None]), axis=-1)

    def depth(self) -> NDArray[np.float64]:
        """Distance along each ray in m, (rows, columns); infinite where there is nothing within `far`."""
        return self._look()[1]

    def segmentation(self) -> NDArray[np.int32]:
        """Which robot is seen, (rows, columns): its place in World.robots; -1: scenery, or nothing."""
        return self._look()[2]

    def picture(self) -> NDArray[np.uint8]:
        """What it sees, (rows, columns, 3): red, green, blue."""
        rays, distance, robot = self._look()
        seen = np.isfinite(distance)
        points = np.asarray(self.position) + rays * np.where(seen, distance, self._far)[..., None]
        normal = np.cross(np.gradient(points, axis=1), np.gradient(points, axis=0))
        normal /= np.maximum(np.linalg.norm(normal, axis=-1, keepdims=True), 1e-12)
        normal *= -np.sign(np.sum(normal * rays, axis=-1, keepdims=True))
        lit = np.clip(normal @ _SUN, 0, 1)
        shadow = np.zeros_like(lit)
        shadow[seen] = np.isfinite(self._cast(points[seen] + 2e-3 * normal[seen], _SUN)[0])
        types = np.array([*self._simulation.world._types, -1])
        colour = np.where((robot >= 0)[..., None], _ROBOTS[types[robot] % len(_ROBOTS)], _SCENERY)
        colour = colour * (0.5 + 0.5 * lit * (1 - shadow))[..., None]
        height = np.clip(rays[..., 2:] * 2, 0, 1)
        sky = _HAZE + (_SKY - _HAZE) * height
        haze = np.clip(np.where(seen, distance, 0) / self._far, 0, 1)[..., None] ** 2
        return np.where(seen[..., None], colour + (_HAZE - colour) * haze, sky).round().astype(np.uint8)

    def _look(self) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int32]]:
        """Directions, distances and robots by pixel."""
        position = filled("position", self.position, (3,))
        forward = filled("target", self.target, (3,)) - position
        right = np.cross(forward, [0, 0, 1.0])
        if not np.linalg.norm(right) > 1e-9 * np.linalg.norm(forward) or not forward.any():
            raise ArgumentError("a camera that looks straight up or down, or nowhere",
                                "move the position or the target a little", "bad-camera")
        forward, right = forward / np.linalg.norm(forward), right / np.linalg.norm(right)
        rays = forward + self._plane[..., :1] * right + self._plane[..., 1:] * np.cross(right, forward)
        rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
        shape = rays.shape[:2]
        distances, robots = self._cast(np.broadcast_to(position, rays.shape).reshape(-1, 3), rays.reshape(-1, 3))
        return rays, distances.reshape(shape), robots.reshape(shape)

    def _cast(self, origins: NDArray, directions: NDArray) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
        rays = np.concatenate([origins, np.broadcast_to(directions, origins.shape)], axis=1)
        distances, robots = np.empty(len(rays)), np.empty(len(rays), dtype=np.int32)
        _core.look(self._simulation._simulations[0], rays, self._far, getattr(self._simulation._core, "threads", 1),
                   distances, robots)
        return distances, robots
