"""The test of ISO 9283 on an arm of a world: a servo drives it through the cube, thirty cycles for each load and speed.

The servo stands for the controller that a real arm has: a PID on each joint, with the torques of the unloaded arm fed
forward (inverse dynamics of RobotModel), and encoders of finite resolution with noise. Without them a simulated arm
repeats to the last bit.
"""
from __future__ import annotations

import os
import xml.etree.ElementTree as xml
from dataclasses import dataclass, field
from pathlib import Path
from typing import Callable, Iterator, Optional, Union

import numpy as np

from ..errors import ArgumentError
from ..kinematics import RobotModel
from ..names import unknown
from ..robots import Floats
from ..simulation import Simulation
from ..trajectories import ctraj, jtraj
from ..world import World
from .iso9283 import compliance, cube_poses
from .recorder import opened_world, quietly_loaded
from .recording import Column, Recording

_ORDER = (4, 3, 2, 1, 0)  # P5 P4 P3 P2 P1: a cycle of 7.2
_SIDES = (1.0, 0.63, 0.4, 0.25)  # m, of cubes that the standard has
_LOAD = "roboss_load"  # link at the tool's origin
_DOWN = (0.0, 1.0, 0.0, 0.0)
_QUINTIC_PEAK = 15 / 8  # largest velocity of jtraj over its mean
_PARTS = ("x", "y", "z", "qx", "qy", "qz", "qw")


@dataclass(frozen=True)
class ArmTest:
    """What is tested, and how.

    Attributes:
        world: path of a world, or a URDF (with `ground` and `fixed_base` as needed).
        robot: its name; None: the only one with joints.
        link: whose frame is measured: the tool; None: the last link.
        payload: rated load, kg.
        loads: shares of it. By the standard 0.1 and 1.
        speeds: shares of the joints' largest velocities. By the standard 1, 0.5, 0.1.
        cycles: by the standard 30.
        rest: time at each pose, s.
        center, side: of the cube, m; None: the largest that the arm reaches.
        orientation: of the tool, quaternion x y z w. None: it looks down; if it cannot, as at the start of the world;
            if it cannot keep that either and has fewer than six joints, it is free: only positions are tested.
        servo_hz: bandwidth of the PID.
        encoder_bits: steps of an encoder per turn, as a power of two.
        encoder_noise: standard deviation, rad.
        seed: of the noise.
        every: time between two samples of the recording, s.
    """

    world: Union[str, os.PathLike]
    robot: Optional[str] = None
    link: Optional[str] = None
    payload: float = 2.0
    loads: tuple[float, ...] = (0.1, 1.0)
    speeds: tuple[float, ...] = (1.0, 0.5)
    cycles: int = 30
    rest: float = 0.6
    center: Optional[tuple[float, float, float]] = None
    side: Optional[float] = None
    orientation: Optional[tuple[float, float, float, float]] = None
    servo_hz: float = 8.0
    encoder_bits: int = 19
    encoder_noise: float = 1e-5
    seed: int = 1
    every: float = 0.004
    load_options: dict = field(default_factory=dict)


@dataclass(frozen=True)
class Cube:
    """Where the cube is: centre (3,) and side, m; the test poses (5, 7) and their configurations (5, joints); whether
    the orientation of the tool is free."""

    center: Floats
    side: float
    poses: Floats
    q: Floats
    turns: bool = False


class ArmDriver:
    """Performs the test. `recordings()` runs the conditions one after the other; `stiffness()` presses on the tool."""

    def __init__(self, test: ArmTest):
        self.test = test
        world = opened_world(test.world, **test.load_options)
        self.robot: str = test.robot or _only_arm(world)
        self.arm = RobotModel(world, self.robot)
        self.link: str = test.link or self.arm.links[-1]
        if self.link not in (*self.arm.links, *self.arm.frames):
            raise unknown("link", self.link, self.arm.links, f" of '{self.robot}'")
        if self.arm.free_base:
            raise ArgumentError(f"the base of '{self.robot}' is free", "fix it to the world (--fixed-base)", "free-base")
        self.rated: World = self._loaded(1.0)
        self.cube: Cube = self._cube()
        self._lines: dict[tuple[int, int], tuple[Floats, Floats]] = {}

    def recordings(self, progress: Callable[[str, float], None] = lambda name, share: None) -> Iterator[tuple[str, Recording]]:
        """(name of the condition, recording with ROBOT.LINK.pose, ROBOT.LINK.command and the joints) of each."""
        for load in self.test.loads:
            world = self._loaded(load)
            for speed in self.test.speeds:
                name = f"{load * self.test.payload:g} kg, {100 * speed:g} % of speed"
                yield name, self._run(world, load, speed, lambda share, n=name: progress(n, share))

    def stiffness(self, force: float, steps: int = 10) -> tuple[Floats, Floats, Floats]:
        """Static compliance at P1 with the rated load: (k,) forces up to `force` in N, (3, k) displacements in m along
        x, y, z, and the three compliances, m/N. The integrators of the servo are held: with them it would be zero."""
        forces = np.linspace(0, force, steps + 1)
        moved = np.zeros((3, steps + 1))
        q = self.cube.q[:1]
        for axis in range(3):
            servo = _Servo(self, Simulation(self.rated), q[0])
            servo.follow(q.repeat(servo.ticks(0.5), axis=0))
            zero = servo.tool()
            for number, push in enumerate(forces):
                wrench = np.zeros(6)
                wrench[axis] = push
                servo.follow(q.repeat(servo.ticks(0.15), axis=0), wrench=wrench, integrates=False)
                moved[axis, number] = (servo.tool() - zero)[axis]
        return forces, moved, np.array([compliance(forces, row) for row in moved])

    def line(self, first: int, second: int) -> tuple[Floats, Floats]:
        """Configurations on the straight line between two test poses: (k,) shares of the path, (k, joints)."""
        if (first, second) not in self._lines:
            knots = np.linspace(0, 1, 60)
            poses = ctraj(self.cube.poses[first], self.cube.poses[second], knots, ramp=0).pose
            q = self.arm.inverse_kinematics(poses, self.link, start=self.cube.q[first], weights=_weights(self.cube.turns),
                                            path=True).q
            q[0], q[-1] = self.cube.q[first], self.cube.q[second]
            self._lines[first, second] = knots, q
        return self._lines[first, second]

    def _run(self, world: World, load: float, speed: float, progress: Callable[[float], None]) -> Recording:
        servo = _Servo(self, Simulation(world), self.cube.q[0])
        servo.follow(self.cube.q[:1].repeat(servo.ticks(0.5), axis=0))
        servo.begin()
        at = 0
        servo.rest(at)
        for cycle in range(self.test.cycles):
            for pose in _ORDER:
                if pose != at:
                    servo.move(at, pose, speed)
                servo.rest(pose)
                at = pose
            progress((cycle + 1) / self.test.cycles)
        return servo.recording(load * self.test.payload, speed)

    def _loaded(self, load: float) -> World:
        """The world with a load at the tool."""
        mass = max(1e-6, load * self.test.payload)
        options = {"search_paths": [str(Path(self.test.world).parent)], **self.test.load_options}
        return quietly_loaded(with_load(Path(self.test.world).read_text(), self.robot, self.link, mass), **options)

    def _cube(self) -> Cube:
        test, reach = self.test, self._reach()
        sides = [test.side] if test.side else [side for side in _SIDES if side < reach]
        centers = [np.array(test.center)] if test.center else self._centers(reach)
        for orientation, turns in self._orientations():
            for side in sides:
                for center in centers:
                    poses = np.hstack([cube_poses(center, side), np.tile(orientation, (5, 1))])
                    q = self._configurations(poses, turns)
                    if q is not None:
                        if turns:
                            poses[:, 3:] = self.arm.link_pose(q, self.link)[:, 3:]
                        return Cube(center, side, poses, q, turns)
        raise ArgumentError(f"'{self.link}' of '{self.robot}' does not reach the five poses of "
                            + (f"a cube of {test.side} m" if test.side else "any cube of the standard"),
                            "give --center and --side of the cube, or another --orientation of the tool", "out-of-reach")

    def _orientations(self) -> list[tuple[Floats, bool]]:
        """Those of the tool that are tried, and whether it may turn away from them."""
        if self.test.orientation is not None:
            return [(np.array(self.test.orientation), False)]
        start = self.arm.link_pose(self.arm.start, self.link)[3:]
        jacobian = self.arm.jacobian(self._random(20), self.link)
        axes = np.count_nonzero(np.abs(jacobian).max(axis=(0, 1)) > 1e-9)
        return [(np.array(_DOWN), False), (start, False)] + ([(start, True)] if axes < 6 else [])

    def _centers(self, reach: float) -> list[Floats]:
        """Of cubes that are tried: before the base, at heights by the reach, then at the middle of all heights."""
        base, middle = self._base()[:3], float(np.median(self._positions_at_random()[:, 2]))
        shares = (0.5, 0.45, 0.55, 0.6, 0.4)
        return [base + reach * np.array([x, 0, z]) for x in shares for z in (0.35, 0.25, 0.45, 0.15)] \
            + [np.array([base[0] + reach * x, base[1], middle]) for x in shares]

    def _configurations(self, poses: Floats, turns: bool) -> Optional[Floats]:
        """Configurations of the five poses and of the straight paths between them; None: out of reach."""
        weights = _weights(turns)
        start = self.arm.inverse_kinematics(poses[0], self.link, weights=weights)
        if not start.success:
            return None
        q = [start.q]
        for pose in poses[1:]:
            line = ctraj(poses[0], pose, np.linspace(0, 1, 12)).pose
            found = self.arm.inverse_kinematics(line, self.link, start=start.q, weights=weights, path=True, attempts=1)
            if not found.success.all() or np.abs(np.diff(found.q, axis=0)).max() > 0.6:
                return None
            q.append(found.q[-1])
        return np.array(q)

    def _reach(self) -> float:
        return float(np.linalg.norm(self._positions_at_random() - self._base()[:3], axis=1).max())

    def _positions_at_random(self) -> Floats:
        return self.arm.link_pose(self._random(500), self.link)[:, :3]

    def _random(self, count: int) -> Floats:
        """Configurations within the limits, (count, joints); the same in every call."""
        low, high = np.clip(self.arm.joint_limits, -np.pi, np.pi).T
        return np.random.default_rng(0).uniform(low, high, (count, len(low)))

    def _base(self) -> Floats:
        return self.arm.link_pose(self.arm.start, self.arm.links[0])


class _Servo:
    """The controller of a simulated arm, and what it records."""

    def __init__(self, driver: ArmDriver, sim: Simulation, q: Floats):
        self.driver, self.sim, self.arm = driver, sim, driver.arm
        self.robots = sim.robots(driver.robot)
        self.robots.joint_position = q
        self._positions, self._velocities = self.robots.joint_position, self.robots.joint_velocity
        rate = 2 * np.pi * driver.test.servo_hz
        models = (self.arm, RobotModel(driver.rated, driver.robot))
        inertias = [np.diagonal(model.mass_matrix(driver.cube.q), axis1=1, axis2=2) for model in models]
        inertia = np.exp(np.mean(np.log(inertias), axis=(0, 1)))  # stable at all poses, with and without the load
        self._gains = 3 * inertia * rate**2, 3 * inertia * rate, inertia * rate**3 / 2
        self._sum = np.zeros(len(q))
        self._noise = np.random.default_rng(driver.test.seed)
        self._every = max(1, round(driver.test.every / sim.dt))
        self._limits = self.robots.joint_effort_limits
        self._samples: list[Floats] = []
        self._commands: list[Floats] = []
        self._records = False

    def ticks(self, time: float) -> int:
        return max(1, round(time / self.sim.dt))

    def begin(self) -> None:
        """Records from now on."""
        self._records, self._first = True, self.sim.tick

    def tool(self) -> Floats:
        """Where the tool is, (3,), m."""
        return self.robots.link_pose(self.driver.link)[0, :3]

    def rest(self, pose: int) -> None:
        self.follow(self.driver.cube.q[pose][None].repeat(self.ticks(self.driver.test.rest), axis=0),
                    command=self.driver.cube.poses[pose][None])

    def move(self, first: int, second: int, speed: float) -> None:
        """A straight path of the tool, as fast as the joints may go, times `speed`."""
        poses, limits = self.driver.cube.poses, self.robots.joint_velocity_limits
        knots, q = self.driver.line(first, second)
        fastest = np.abs(np.diff(q, axis=0) / np.diff(knots)[:, None]).max(axis=0)  # per unit of the path
        least = _QUINTIC_PEAK * (fastest / np.where(np.isfinite(limits), limits, 3.0)).max()
        count = self.ticks(least / speed)
        at = jtraj([0.0], [1.0], np.linspace(0, 1, count + 1)).q[1:, 0]
        self.follow(_between(knots, q, at), command=_between_poses(poses[first], poses[second], at))

    def follow(self, q: Floats, command: Optional[Floats] = None, wrench: Optional[Floats] = None,
               integrates: bool = True) -> None:
        """Drives the joints along positions, one for each tick."""
        dt = self.sim.dt
        v = np.gradient(q, dt, axis=0) if len(q) > 2 else np.zeros_like(q)
        a = np.gradient(v, dt, axis=0) if len(q) > 2 else np.zeros_like(q)
        forward = self.arm.inverse_dynamics(q, v, a)
        step = 2 * np.pi / 2**self.driver.test.encoder_bits
        noise = self._noise.normal(0, self.driver.test.encoder_noise, q.shape)
        kp, kd, ki = self._gains
        for tick in range(len(q)):
            error = q[tick] - np.round((self._positions[0] + noise[tick]) / step) * step
            effort = forward[tick] + kp * error + kd * (v[tick] - self._velocities[0]) + ki * self._sum
            bounded = np.clip(effort, -self._limits, self._limits)
            if integrates:
                self._sum += np.where(bounded == effort, error * dt, 0)  # no wind-up
            self.robots.set_joint_targets(bounded, mode="effort")
            if wrench is not None:
                self.robots.apply_wrench(wrench, _LOAD)
            self.sim.step()
            if self._records and (self.sim.tick - self._first) % self._every == 0:
                self._sample(command[min(tick, len(command) - 1)])

    def _sample(self, command: Floats) -> None:
        self._commands.append(command)
        self._samples.append(np.concatenate([self.robots.link_pose(self.driver.link)[0], self._positions[0],
                                             self.robots.joint_effort[0]]))

    def recording(self, load: float, speed: float) -> Recording:
        robot, link = self.driver.robot, self.driver.link
        units = ("m", "m", "m", "", "", "", "")
        columns = [Column(f"{robot}.{link}.{what}.{part}", f"{robot}.{link}.{what}", unit, "world")
                   for what in ("command", "pose") for part, unit in zip(_PARTS, units)]
        columns += [Column(f"{robot}.{joint}.{what}", f"{robot}.{joint}.{what}", unit)
                    for what, unit in (("position", "rad"), ("effort", "N m")) for joint in self.robots.joints]
        columns += [Column("test.load", "test.load", "kg"), Column("test.speed", "test.speed")]
        values = np.hstack([np.array(self._commands), np.array(self._samples), np.tile([load, speed], (len(self._samples), 1))])
        time = np.arange(1, len(values) + 1) * self._every * self.sim.dt
        return Recording(time, columns, values, {"source": str(self.driver.test.world), "world_hash": self.sim.world.hash})


def with_load(text: str, robot: str, link: str, mass: float) -> str:
    """The world with a ball of this mass (kg) welded to a link at its origin; SDFormat or URDF.

    Raises:
        ArgumentError: the file does not have the model itself (code "no-model"): it includes it, or is of MuJoCo.
    """
    root = xml.fromstring(text)
    inertia = str(max(1e-9, 0.4 * mass * 0.05**2))  # of a ball of 5 cm
    if root.tag == "robot":
        model = root
        body = f'<link name="{_LOAD}"><inertial><mass value="{mass}"/><inertia ixx="{inertia}" iyy="{inertia}" ' \
               f'izz="{inertia}" ixy="0" ixz="0" iyz="0"/></inertial></link>'
        joint = f'<joint name="{_LOAD}_mount" type="fixed"><parent link="{link}"/><child link="{_LOAD}"/></joint>'
    else:
        found = [model for model in root.iter("model") if model.get("name") == robot]
        if not found or found[0].find(f"link[@name='{link}']") is None:
            raise ArgumentError(f"the file does not have the link '{link}' of the model '{robot}' itself",
                                "give a file in which the model is written, not included; SDFormat or URDF", "no-model")
        model = found[0]
        body = f'<link name="{_LOAD}"><pose relative_to="{link}">0 0 0 0 0 0</pose><inertial><mass>{mass}</mass>' \
               f'<inertia><ixx>{inertia}</ixx><iyy>{inertia}</iyy><izz>{inertia}</izz></inertia></inertial></link>'
        joint = f'<joint name="{_LOAD}_mount" type="fixed"><parent>{link}</parent><child>{_LOAD}</child></joint>'
    model.append(xml.fromstring(body))
    model.append(xml.fromstring(joint))
    return xml.tostring(root, encoding="unicode")


def _weights(turns: bool) -> tuple[int, ...]:
    """Of inverse kinematics: the orientation of the tool counts, or is free."""
    return (1, 1, 1, 0, 0, 0) if turns else (1, 1, 1, 1, 1, 1)


def _only_arm(world: World) -> str:
    jointed = [name for number, name in enumerate(world.robots) if world._facts_of(number).axes]
    if len(jointed) != 1:
        raise ArgumentError(f"the world has {len(jointed)} robots with joints", "name the arm (--robot)", "which-robot")
    return jointed[0]


def _between(knots: Floats, values: Floats, at: Floats) -> Floats:
    """Values between knots by cubic Hermite polynomials (Catmull-Rom), so that accelerations stay finite."""
    slopes = np.gradient(values, knots, axis=0, edge_order=2)
    k = np.clip(np.searchsorted(knots, at, side="right") - 1, 0, len(knots) - 2)
    h = (knots[k + 1] - knots[k])[:, None]
    s = (at - knots[k])[:, None] / h
    return ((2 * s**3 - 3 * s**2 + 1) * values[k] + (s**3 - 2 * s**2 + s) * h * slopes[k]
            + (3 * s**2 - 2 * s**3) * values[k + 1] + (s**3 - s**2) * h * slopes[k + 1])


def _between_poses(first: Floats, second: Floats, at: Floats) -> Floats:
    """Poses on the straight line of two, (T, 7); a free orientation turns from the one to the other."""
    second = np.concatenate([second[:3], second[3:] * (-1 if first[3:] @ second[3:] < 0 else 1)])
    poses = first + at[:, None] * (second - first)
    poses[:, 3:] /= np.linalg.norm(poses[:, 3:], axis=1, keepdims=True)
    return poses
