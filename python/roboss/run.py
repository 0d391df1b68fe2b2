"""Run: what a Simulation and a RemoteSimulation have in common."""
from __future__ import annotations

from typing import Any, Iterable, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .camera import Camera
from .names import index_of, real
from .robots import Robots
from .world import World

#: Fields of Simulation.contacts. Numbers of robots are places in World.robots, numbers of links places in Robots.links.
CONTACT = np.dtype([
    ("robot_a", np.int32),         # robot A
    ("robot_b", np.int32),         # robot B; -1: scenery
    ("link_a", np.int32),          # of robot A
    ("link_b", np.int32),          # of robot B; -1: scenery
    ("position", np.float64, 3),   # m, world
    ("normal", np.float64, 3),     # unit, from B towards A, world axes
    ("gap", np.float64),           # m; negative: the shapes overlap
    ("force", np.float64, 3),      # N on A, world axes: normal force and friction, mean over the tick
    ("torque", np.float64, 3),     # N m on A, world axes: torsional and rolling friction, mean over the tick
])


class Run:
    """A run of a world, in this process or elsewhere, at one of its ticks: its robots, contacts and cameras."""

    world: World                          #: that is simulated
    _core: Any                            # that is stepped
    _simulations: list[_core.Simulation]  # one
    _shape: tuple[int, ...]               # leading axes of arrays

    @property
    def dt(self) -> float:
        """Length of a tick, s."""
        return self.world.dt

    @property
    def time(self) -> float:
        """Simulated time since the start of the world, s."""
        return self._core.time

    @property
    def seed(self) -> int:
        """Seed of sensor noise."""
        return self._core.seed

    @property
    def state_hash(self) -> str:
        """16 hexadecimal digits over world, tick and the states of all robots, as `roboss run` prints them.

        Equal hashes: the same world in the same state, to the last bit.

        >>> one, other = [roboss.Simulation(roboss.example("pile.sdf"), threads=n) for n in (1, 3)]
        >>> one.step(200), other.step(200)
        (None, None)
        >>> one.state_hash == other.state_hash
        True
        """
        return self._simulations[0].hash

    def robots(self, wanted: Union[str, Iterable[str]] = "*") -> Robots:
        """Robots as arrays: those whose names match a pattern (`*`, `?`, `[...]`), or those of a list of names.

        Robots of a pattern are in the order of World.robots. Raises UnknownNameError if there are none.

        >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
        >>> len(sim.robots("car_*"))
        16
        >>> sim.robots(["car_3", "car_1"]).names
        ('car_3', 'car_1')
        """
        return Robots(self, self.world._find(wanted))

    @property
    def contacts(self) -> NDArray[np.void]:
        """Contact points that carry a force in the tick that begins now, as long as no order takes effect at it.

        A structured array with the fields of roboss.CONTACT; one row for each point, sorted by robots.

        >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
        >>> sim.step(100)
        >>> contacts = sim.contacts
        >>> bool((contacts["robot_b"] == -1).all())             # wheels on the ground
        True
        >>> contacts["force"].shape == (len(contacts), 3)       # N
        True
        """
        return self._simulations[0].contacts().view(CONTACT)

    def camera(self, position: ArrayLike, target: ArrayLike, *, size: tuple[int, int] = (640, 480), fov: float = 1.0,
               far: float = 200.0) -> Camera:
        """A camera that looks from `position` to `target` (m, world), with z upwards; it needs no browser.

        Args:
            size: columns and rows of its pictures.
            fov: angle that it sees across, rad.
            far: nothing is seen beyond it, m.
        """
        return Camera(self, position, target, size, fov, far)

    def attach(self, holder: str, held: str, *, link: Optional[str] = None, held_link: Optional[str] = None,
               reach: float = 0.1, max_force: float = float("inf"), max_torque: float = float("inf")) -> None:
        """Lets the robot `holder` hold the robot `held` rigidly, as they stand at the next tick.

        Args:
            link, held_link: which link holds and which is held; None: the first of the robot.
            reach: m; nothing happens if the robots' bounds are further apart.
            max_force, max_torque: N, N m; beyond, it lets go.
        """
        numbers = []
        for robot, name in ((holder, link), (held, held_link)):
            number = self._number_of(robot)
            links = self.world._facts_of(number).links
            numbers += [number, 0 if name is None else index_of("link", name, links, f" of robot '{robot}'")]
        self._simulations[0].attach(*numbers, real("reach", reach, 0), real("max_force", max_force, 0),
                                    real("max_torque", max_torque, 0))

    def detach(self, holder: str, held: str) -> None:
        """Lets go what `attach` made."""
        self._simulations[0].detach(self._number_of(holder), self._number_of(held))

    def _number_of(self, robot: str) -> int:
        return index_of("robot", robot, list(self.world.robots))
