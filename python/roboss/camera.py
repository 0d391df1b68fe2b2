"""Camera and RobotCameras: pictures of a simulation without a browser, by rays against the shapes that collide."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .errors import ArgumentError
from .names import filled

if TYPE_CHECKING:
    from .remote import RemoteSimulation
    from .robots import Robots
    from .simulation import Simulation

Floats = NDArray[np.float64]
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
        self._simulation, self._far, self._plane = simulation, far, _plane_of(size, fov, far)

    def depth(self) -> Floats:
        """Distance along each ray in m, (rows, columns); infinite where there is nothing within `far`."""
        return self._look()[2]

    def segmentation(self) -> NDArray[np.int32]:
        """Which robot is seen, (rows, columns): its place in World.robots; -1: scenery, or nothing."""
        return self._look()[3]

    def picture(self) -> NDArray[np.uint8]:
        """What it sees, (rows, columns, 3): red, green, blue."""
        return _picture_of(self._simulation, self._far, _threads_of(self._simulation), *self._look())

    def _look(self) -> tuple[Floats, Floats, Floats, NDArray[np.int32]]:
        """Where it is, directions, distances and robots by pixel."""
        position = filled("position", self.position, (3,))
        rays = _rays_of(self._plane, position, filled("target", self.target, (3,)))
        return position, rays, *_cast(self._simulation, position, rays, self._far, _threads_of(self._simulation))


class RobotCameras:
    """A camera on each robot of a set, of all its simulations. Robots.camera makes it; N is the number of robots.

    It sees the same as Camera, the robot itself too, and all robots in one call: for observations of learners.

    >>> cars = roboss.Simulation(roboss.example("crossroads.sdf")).robots("car_*")
    >>> front = cars.camera([0.25, 0, 0.15], [1, 0, 0.1], size=(64, 48))
    >>> front.depth().shape, front.picture().shape
    ((16, 48, 64), (16, 48, 64, 3))
    """

    def __init__(self, robots: Robots, position: ArrayLike, target: ArrayLike, link: Optional[str], size: tuple[int, int],
                 fov: float, far: float):
        self._robots, self._link, self._far = robots, link, far
        self._threads = _threads_of(robots.simulation)
        self._position = filled("position", position, (3,))
        self._rays = _rays_of(_plane_of(size, fov, far), self._position, filled("target", target, (3,)))

    def depth(self) -> Floats:
        """Distance along each ray in m, (N, rows, columns); infinite where there is nothing within `far`."""
        return self._each(lambda *of_one: self._cast(*of_one)[0])

    def segmentation(self) -> NDArray[np.int32]:
        """Which robot is seen, (N, rows, columns): its place in World.robots; -1: scenery, or nothing."""
        return self._each(lambda *of_one: self._cast(*of_one)[1])

    def picture(self) -> NDArray[np.uint8]:
        """What they see, (N, rows, columns, 3): red, green, blue."""
        return self._each(lambda simulation, eyes, rays: _picture_of(
            simulation, self._far, self._threads, eyes, rays, *self._cast(simulation, eyes, rays)))

    def _cast(self, simulation: Simulation, eyes: Floats, rays: Floats) -> tuple[Floats, NDArray[np.int32]]:
        return _cast(simulation, eyes, rays, self._far, self._threads)

    def _each(self, look: Callable) -> NDArray:
        """What look(simulation, eyes (N, 1, 1, 3), rays (N, rows, columns, 3)) gives of each simulation."""
        robots = self._robots
        poses = robots.pose if self._link is None else robots.link_pose(self._link)
        several = robots.simulation if robots.simulation._shape else [robots.simulation]
        seen = []
        for simulation, pose in zip(several, poses.reshape(len(several), -1, 7)):
            turns = _matrices(pose[:, 3:])
            eyes = pose[:, :3] + turns @ self._position
            rays = np.einsum("nij,rcj->nrci", turns, self._rays)
            seen.append(look(simulation, eyes[:, None, None], rays))
        return np.stack(seen) if robots.simulation._shape else seen[0]


def _plane_of(size: tuple[int, int], fov: float, far: float) -> Floats:
    """Where the ray of each pixel meets a plane 1 m in front: right and up, (rows, columns, 2)."""
    if not (len(size) == 2 and min(size) > 0 and 0 < fov < np.pi and far > 0):
        raise ArgumentError(f"a camera of size {size}, fov {fov} and far {far}",
                            "give columns and rows above 0, an angle between 0 and pi, and a distance above 0")
    columns, rows = size
    across = np.tan(fov / 2) * (np.arange(columns) - (columns - 1) / 2) * 2 / columns
    upwards = -np.tan(fov / 2) * (np.arange(rows) - (rows - 1) / 2) * 2 / columns
    return np.stack(np.broadcast_arrays(across[None, :], upwards[:, None]), axis=-1)


def _rays_of(plane: Floats, position: Floats, target: Floats) -> Floats:
    """Directions of the rays, (rows, columns, 3)."""
    forward = target - position
    right = np.cross(forward, [0, 0, 1.0])
    if not np.linalg.norm(right) > 1e-9 * np.linalg.norm(forward) or not forward.any():
        raise ArgumentError("a camera that looks straight up or down, or nowhere",
                            "move the position or the target a little", "bad-camera")
    forward, right = forward / np.linalg.norm(forward), right / np.linalg.norm(right)
    rays = forward + plane[..., :1] * right + plane[..., 1:] * np.cross(right, forward)
    return rays / np.linalg.norm(rays, axis=-1, keepdims=True)


def _matrices(quaternions: Floats) -> Floats:
    """Rotations, (N, 3, 3), of unit quaternions x y z w, (N, 4)."""
    x, y, z, w = quaternions.T
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    return np.moveaxis(np.array(rows), 2, 0)


def _cast(simulation: Any, origins: Floats, rays: Floats, far: float, threads: int) -> tuple[Floats, NDArray[np.int32]]:
    """Distances (m) and robots of rays of any shape (..., 3), whose origins are broadcast to them."""
    table = np.concatenate([np.broadcast_to(origins, rays.shape), rays], axis=-1).reshape(-1, 6)
    distances, robots = np.empty(len(table)), np.empty(len(table), dtype=np.int32)
    _core.look(simulation._simulations[0], table, far, threads, distances, robots)
    return distances.reshape(rays.shape[:-1]), robots.reshape(rays.shape[:-1])


def _threads_of(simulation: Any) -> int:
    """Threads of a Simulation or Batch; a run elsewhere has one here."""
    return getattr(simulation._core, "threads", 1)


def _picture_of(simulation: Any, far: float, threads: int, origins: Floats, rays: Floats, distance: Floats,
                robot: NDArray[np.int32]) -> NDArray[np.uint8]:
    """Colours of pixels, (..., rows, columns, 3)."""
    seen = np.isfinite(distance)
    points = origins + rays * np.where(seen, distance, far)[..., None]
    normal = np.cross(np.gradient(points, axis=-2), np.gradient(points, axis=-3))
    normal /= np.maximum(np.linalg.norm(normal, axis=-1, keepdims=True), 1e-12)
    normal *= -np.sign(np.sum(normal * rays, axis=-1, keepdims=True))
    lit = np.clip(normal @ _SUN, 0, 1)
    shadow = np.zeros_like(lit)
    starts = points[seen] + 2e-3 * normal[seen]
    shadow[seen] = np.isfinite(_cast(simulation, starts, np.broadcast_to(_SUN, starts.shape), far, threads)[0])
    types = np.array([*simulation.world._types, -1])
    colour = np.where((robot >= 0)[..., None], _ROBOTS[types[robot] % len(_ROBOTS)], _SCENERY)
    colour = colour * (0.5 + 0.5 * lit * (1 - shadow))[..., None]
    height = np.clip(rays[..., 2:] * 2, 0, 1)
    sky = _HAZE + (_SKY - _HAZE) * height
    haze = np.clip(np.where(seen, distance, 0) / far, 0, 1)[..., None] ** 2
    return np.where(seen[..., None], colour + (_HAZE - colour) * haze, sky).round().astype(np.uint8)
