"""Camera and RobotCameras: pictures of a simulation without a browser, and what rays meet."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .errors import ArgumentError
from .names import filled, listed, real, whole

if TYPE_CHECKING:
    from .robots import Robots
    from .run import Run

Floats = NDArray[np.float64]
Lens = tuple[int, int, float, float]


class Camera:
    """A camera at rest that looks from `position` to `target`, with z upwards. Simulation.camera makes it.

    Pictures show the visuals of the world in its light, as camera sensors see them; depth() and segmentation()
    are those of the shapes that collide, as lidars see them. No bit of a picture depends on threads or processor.

    Attributes:
        position, target: m, world; may be assigned between two pictures.

    >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
    >>> camera = sim.camera([12, -12, 8], [0, 0, 0], size=(160, 120))
    >>> camera.picture().shape                 # rows, columns, red green blue
    (120, 160, 3)
    >>> float(camera.depth()[60, 80].round(1))  # m, in the middle
    18.6
    """

    def __init__(self, simulation: Run, position: ArrayLike, target: ArrayLike,
                 size: tuple[int, int], fov: float, far: float):
        self.position, self.target = filled("position", position, (3,)), filled("target", target, (3,))
        self._simulation, self._lens = simulation, _lens_of(size, fov, far)
        self._plane = _plane_of(self._lens)

    def depth(self) -> Floats:
        """Distance along each ray in m, (rows, columns); infinite where there is nothing within `far`."""
        return self._cast()[0]

    def segmentation(self) -> NDArray[np.int32]:
        """Which robot is seen, (rows, columns): its place in World.robots; -1: scenery, or nothing."""
        return self._cast()[1]

    def picture(self) -> NDArray[np.uint8]:
        """What it sees, (rows, columns, 3): red, green, blue."""
        position, axes = self._place()
        return _pictures(self._simulation, position[None], axes[None], self._lens)[0]

    def _place(self) -> tuple[Floats, Floats]:
        """Where it is, and its axes."""
        position = filled("position", self.position, (3,))
        return position, _axes_of(position, filled("target", self.target, (3,)))

    def _cast(self) -> tuple[Floats, NDArray[np.int32]]:
        """Distances and robots by pixel."""
        position, axes = self._place()
        return _cast(self._simulation, position, _rays_of(self._plane, axes), self._lens[3], _threads_of(self._simulation))


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
        self._robots, self._link, self._lens = robots, link, _lens_of(size, fov, far)
        self._position = filled("position", position, (3,))
        self._axes = _axes_of(self._position, filled("target", target, (3,)))
        self._rays = _rays_of(_plane_of(self._lens), self._axes)

    def depth(self) -> Floats:
        """Distance along each ray in m, (N, rows, columns); infinite where there is nothing within `far`."""
        return self._each(lambda *of_one: self._cast(*of_one)[0])

    def segmentation(self) -> NDArray[np.int32]:
        """Which robot is seen, (N, rows, columns): its place in World.robots; -1: scenery, or nothing."""
        return self._each(lambda *of_one: self._cast(*of_one)[1])

    def picture(self) -> NDArray[np.uint8]:
        """What they see, (N, rows, columns, 3): red, green, blue."""
        return self._each(lambda simulation, eyes, turns: _pictures(simulation, eyes, turns @ self._axes, self._lens))

    def _cast(self, simulation: Run, eyes: Floats, turns: Floats) -> tuple[Floats, NDArray[np.int32]]:
        rays = np.einsum("nij,rcj->nrci", turns, self._rays)
        return _cast(simulation, eyes[:, None, None], rays, self._lens[3], _threads_of(self._robots.simulation))

    def _each(self, look: Callable) -> NDArray:
        """What look(simulation, eyes (N, 3), rotations of the robots (N, 3, 3)) gives of each simulation."""
        robots = self._robots
        poses = robots.pose if self._link is None else robots.link_pose(self._link)
        several = robots.simulation if robots.simulation._shape else [robots.simulation]
        seen = []
        for simulation, pose in zip(several, poses.reshape(len(several), -1, 7)):
            turns = _matrices(pose[:, 3:])
            seen.append(look(simulation, pose[:, :3] + turns @ self._position, turns))
        return np.stack(seen) if robots.simulation._shape else seen[0]


def _lens_of(size: tuple[int, int], fov: float, far: float) -> Lens:
    """Columns, rows, angle across, reach: checked."""
    columns, rows = listed("size", size) if np.size(size) == 2 else (0, 0)
    lens = whole("size", columns), whole("size", rows), real("fov", fov), real("far", far)
    if not (lens[0] > 0 and lens[1] > 0 and 0 < lens[2] < np.pi and lens[3] > 0):
        raise ArgumentError(f"a camera of size {size}, fov {fov} and far {far}",
                            "give columns and rows above 0, an angle between 0 and pi, and a distance above 0")
    return lens


def _plane_of(lens: Lens) -> Floats:
    """Where the ray of each pixel meets a plane 1 m in front: right and up, (rows, columns, 2)."""
    columns, rows, fov, far = lens
    across = np.tan(fov / 2) * (np.arange(columns) - (columns - 1) / 2) * 2 / columns
    upwards = -np.tan(fov / 2) * (np.arange(rows) - (rows - 1) / 2) * 2 / columns
    return np.stack(np.broadcast_arrays(across[None, :], upwards[:, None]), axis=-1)


def _axes_of(position: Floats, target: Floats) -> Floats:
    """Columns: unit vectors ahead, to the left and up, (3, 3)."""
    forward = target - position
    right = np.cross(forward, [0, 0, 1.0])
    if not np.linalg.norm(right) > 1e-9 * np.linalg.norm(forward) or not forward.any():
        raise ArgumentError("a camera that looks straight up or down, or nowhere",
                            "move the position or the target a little", "bad-camera")
    forward, right = forward / np.linalg.norm(forward), right / np.linalg.norm(right)
    return np.stack([forward, -right, np.cross(right, forward)], axis=1)


def _rays_of(plane: Floats, axes: Floats) -> Floats:
    """Directions of the rays, (rows, columns, 3)."""
    forward, left, up = axes.T
    rays = forward - plane[..., :1] * left + plane[..., 1:] * up
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


def _pictures(simulation: Any, eyes: Floats, axes: Floats, lens: Lens) -> NDArray[np.uint8]:
    """Colours of the visuals, (N, rows, columns, 3), seen from `eyes` (N, 3) along the columns of `axes` (N, 3, 3)."""
    columns, rows, fov, far = lens
    places = np.concatenate([eyes, np.swapaxes(axes, 1, 2).reshape(-1, 9)], axis=1)
    colours = np.empty((len(eyes), rows, columns, 3), dtype=np.uint8)
    _core.picture(simulation._simulations[0], np.ascontiguousarray(places), columns, rows, fov, far, colours)
    return colours
