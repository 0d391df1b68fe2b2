"""Test drives of a vehicle with wheels left and right: circle, stop, weave, and the squares of UMBmark.

A vehicle whose on-board controller takes velocities (`cmd_vel`) is driven by them: the controller would overwrite setpoints
of its wheels. Any other one is driven by the motors of its wheels.
"""
from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import Callable, Optional, Sequence, Union

import numpy as np

from ..errors import ArgumentError
from ..names import index_of, unknown
from ..robots import Floats, Robots
from ..simulation import Simulation
from . import vehicle
from .recorder import opened_world
from .recording import Column, Recording
from .variables import yaw

_CONTROL = 0.02  # s, between two orders


@dataclass(frozen=True)
class VehicleTest:
    """What is tested, and how.

    Attributes:
        world: path; other robots are taken out of it, and the vehicle starts where it stands: it needs free ground.
        robot: name; None: the first with wheels left and right.
        left, right: names of the wheels' joints; None: those with "left" and "right" in their names.
        speed: of the drives, m/s.
        radius: of the circle, m.
        side: of the squares, m. By UMBmark 4.
        runs: squares in each direction. By UMBmark 5.
        track: nominal distance of the wheels for commands and odometry, m; None: the effective one, from a turn on the spot.
        frequency, yaw_rate: of the weave, Hz and rad/s.
    """

    world: Union[str, os.PathLike]
    robot: Optional[str] = None
    left: Optional[Sequence[str]] = None
    right: Optional[Sequence[str]] = None
    speed: float = 0.5
    radius: float = 2.0
    side: float = 4.0
    runs: int = 5
    track: Optional[float] = None
    frequency: float = 0.3
    yaw_rate: float = 0.6
    load_options: dict = field(default_factory=dict)


class VehicleDriver:
    """Performs the drives; each starts from where the world has the vehicle."""

    def __init__(self, test: VehicleTest, progress: Callable[[str], None] = lambda name: None):
        self.test, self._progress = test, progress
        world = opened_world(test.world, **test.load_options)
        if test.robot and test.robot not in world.robots:
            raise unknown("robot", test.robot, world.robots, f" in '{os.fspath(test.world)}'")
        self.sim = Simulation(world)
        self.robot = test.robot or _first_vehicle(self.sim)
        others = [name for name in world.robots if name != self.robot]
        if others:
            self.sim.remove(others)
        self.vehicle = self.sim.robots([self.robot])
        self.left = list(test.left or [name for name in self.vehicle.joints if "left" in name])
        self.right = list(test.right or [name for name in self.vehicle.joints if "right" in name])
        if not self.left or not self.right:
            raise ArgumentError(f"'{self.robot}' has no joints with 'left' and 'right' in their names",
                                "name its wheels (--left, --right)", "no-wheels")
        joints = list(self.vehicle.joints)
        self._columns = [[index_of("joint", name, joints, f" of '{self.robot}'") for name in side] for side in (self.left, self.right)]
        self._period = max(1, round(_CONTROL / self.sim.dt))  # ticks between two orders
        self.command: Optional[str] = _velocity_command(self.vehicle)
        self._start = self.sim.save()
        self.wheel_radius: float = self._rolled()
        self.contact_track: float = self._width()
        self.track: float = test.track or self._turned()

    def circle(self) -> tuple[Recording, vehicle.CircleScore]:
        """Wheels at constant speeds; the score is of what follows the first quarter turn."""
        test = self.test
        rate = test.speed / test.radius
        record = self._drive("circle", 1.25 * 2 * np.pi / rate, lambda t: (test.speed, rate))
        steady = record.time > 0.2 * record.time[-1]
        return record, vehicle.circle_score(record.time[steady], record["xy"][steady])

    def stop(self) -> tuple[Recording, vehicle.StopScore]:
        """Straight ahead for 2 s, then the wheels are ordered to stand."""
        record = self._drive("stop", 4.0, lambda t: (self.test.speed if t < 2 else 0.0, 0.0))
        return record, vehicle.stop_score(record.time, record["xy"], 2.0)

    def weave(self) -> tuple[Recording, vehicle.WeaveScore]:
        """Five periods of a sinusoidal yaw rate; the score is of the last four."""
        test = self.test
        turn = 2 * np.pi * test.frequency
        record = self._drive("weave", 5 / test.frequency, lambda t: (test.speed, test.yaw_rate * np.sin(turn * t)))
        late = record.time > 1 / test.frequency
        time = record.time[late]
        return record, vehicle.weave_score(time, record["yaw"][late], record["speed"][late], record["command.yaw_rate"][late],
                                           test.frequency)

    def umbmark(self) -> tuple[list[Recording], vehicle.UmbmarkScore]:
        """Squares by odometry, clockwise and counter-clockwise. Runs differ by where they begin: the heading changes."""
        errors, records = {-1: [], 1: []}, []
        for way in (-1, 1):
            for run in range(self.test.runs):
                record, error = self._square(way, 2 * np.pi * run / self.test.runs)
                records.append(record)
                errors[way].append(error)
        return records, vehicle.umbmark_score(np.array(errors[-1]), np.array(errors[1]), self.test.side, self.track)

    def _square(self, way: int, heading: float) -> tuple[Recording, Floats]:
        """One square; the recording, and the return position error in the frame of the start: actual less computed."""
        test, radius, track = self.test, self.wheel_radius, self.track
        self._reset(heading)
        self._progress(f"square {'clockwise' if way < 0 else 'counter-clockwise'}")
        start, pose = self.vehicle.pose[0].copy(), np.zeros(3)
        before, rows = self._wheels(), []
        for leg in range(8):  # sides and corners by turns
            is_side = leg % 2 == 0
            goal = test.side if is_side else np.pi / 2
            done = 0.0
            while goal - done > 1e-3:
                left = max(0.05, min(1.0, 4 * (goal - done)))  # slower towards the end
                speed, rate = (test.speed * left, 0.0) if is_side else (0.0, way * left)
                self._order(speed, rate)
                self.sim.step(self._period)
                now = self._wheels()
                moved = (now - before) * radius
                before = now
                turn, ahead = (moved[1] - moved[0]) / track, moved.mean()
                pose += [ahead * np.cos(pose[2] + turn / 2), ahead * np.sin(pose[2] + turn / 2), turn]
                done += ahead if is_side else way * turn
                rows.append(self._row(speed, rate))
                rows[-1][1:3] = self._in_frame(start, rows[-1][1:3])
        return self._recording(rows), self._in_frame(start, self.vehicle.pose[0, :2]) - pose[:2]

    def _drive(self, name: str, duration: float, command: Callable[[float], tuple[float, float]]) -> Recording:
        self._progress(name)
        self._reset(0.0)
        rows, begin = [], self.sim.time
        while self.sim.time - begin < duration:
            speed, rate = command(self.sim.time - begin)
            self._order(speed, rate)
            rows.append(self._row(speed, rate))
            self.sim.step(self._period)
        return self._recording(rows)

    def _reset(self, turned: float) -> None:
        """Back to the start, turned about z, and at rest on the ground."""
        self.sim.restore(self._start)
        pose = self.vehicle.pose[0].copy()
        sine, cosine = np.sin(turned / 2), np.cos(turned / 2)
        x, y, z, w = pose[3:]
        pose[3:] = [cosine * x - sine * y, cosine * y + sine * x, cosine * z + sine * w, cosine * w - sine * z]
        self.vehicle.pose = pose
        self._order(0.0, 0.0)
        self.sim.step(round(0.3 / self.sim.dt))

    def _order(self, speed: float, rate: float) -> None:
        if self.command is not None:
            self.vehicle.command(self.command, linear_x=speed, angular_z=rate)
            return
        for side, names in ((-1, self.left), (1, self.right)):
            self.vehicle.set_joint_targets((speed + side * rate * self.track / 2) / self.wheel_radius, names)

    def _wheels(self) -> Floats:
        """Mean angles of the wheels left and right, (2,), rad."""
        return np.array([self.vehicle.joint_position[0, side].mean() for side in self._columns])

    def _row(self, speed: float, rate: float) -> Floats:
        pose = self.vehicle.pose[0]
        return np.array([self.sim.time, pose[0], pose[1], yaw(pose[3:]), np.linalg.norm(self.vehicle.twist[0, :2]), speed, rate])

    def _recording(self, rows: list[Floats]) -> Recording:
        table = np.array(rows)
        columns = [Column("xy.x", "xy", "m", "world"), Column("xy.y", "xy", "m", "world"), Column("yaw", "yaw", "rad", "world"),
                   Column("speed", "speed", "m/s"), Column("command.speed", "command.speed", "m/s"),
                   Column("command.yaw_rate", "command.yaw_rate", "rad/s")]
        return Recording(table[:, 0] - table[0, 0], columns, table[:, 1:], {"source": str(self.test.world)})

    def _in_frame(self, start: Floats, xy: Floats) -> Floats:
        """Positions (..., 2) in the frame of a pose on the ground."""
        angle = -yaw(start[3:])
        dx, dy = np.moveaxis(xy - start[:2], -1, 0)
        return np.stack([dx * np.cos(angle) - dy * np.sin(angle), dx * np.sin(angle) + dy * np.cos(angle)], axis=-1)

    def _rolled(self) -> float:
        """Effective radius of the wheels, m: distance over angle in a second of straight driving."""
        self.wheel_radius, self.track = 1.0, 0.0
        self._reset(0.0)
        self._order(self.test.speed if self.command else 2.0, 0.0)
        self.sim.step(round(0.5 / self.sim.dt))
        place, wheels = self.vehicle.pose[0, :2].copy(), self._wheels()
        self.sim.step(round(1 / self.sim.dt))
        angle = float((self._wheels() - wheels).mean())
        distance = float(np.linalg.norm(self.vehicle.pose[0, :2] - place))
        if not angle > 0.1 or not distance > 1e-3:
            raise ArgumentError(f"'{self.robot}' does not drive", "name the wheels that its motors turn (--left, --right)",
                                "does-not-drive")
        return distance / angle

    def _turned(self) -> float:
        """Effective track, m: the difference of the wheels' ways over the heading, in a turn on the spot."""
        self.track = self.contact_track
        self._reset(0.0)
        self._order(0.0, 0.5)
        self.sim.step(round(0.5 / self.sim.dt))
        heading, wheels = yaw(self.vehicle.pose[0, 3:]), self._wheels()
        self.sim.step(round(1 / self.sim.dt))
        turned = (yaw(self.vehicle.pose[0, 3:]) - heading + np.pi) % (2 * np.pi) - np.pi
        if not turned > 0.01:
            raise ArgumentError(f"'{self.robot}' does not turn", "name its wheels (--left, --right)", "does-not-drive")
        return float(np.diff(self._wheels() - wheels)[0] * self.wheel_radius / turned)

    def _width(self) -> float:
        """Distance of the contacts left and right, m: the geometric track."""
        self._reset(0.0)
        aside = self._in_frame(self.vehicle.pose[0], self.sim.contacts["position"][:, :2])[:, 1]
        if not (aside > 0).any() or not (aside < 0).any():
            raise ArgumentError(f"'{self.robot}' does not stand on wheels left and right", "put it on the ground", "no-ground")
        return float(aside[aside > 0].mean() - aside[aside < 0].mean())


def _velocity_command(vehicle: Robots) -> Optional[str]:
    """The command that takes a speed and a yaw rate."""
    for name, values in vehicle.commands.items():
        if {"linear_x", "angular_z"} <= {field for field, _ in values}:
            return name
    return None


def _first_vehicle(sim: Simulation) -> str:
    for number, name in enumerate(sim.world.robots):
        joints = sim.world._facts_of(number).axes
        if any("left" in joint for joint in joints) and any("right" in joint for joint in joints):
            return name
    raise ArgumentError("no robot has joints with 'left' and 'right' in their names", "name it and its wheels (--robot, "
                        "--left, --right)", "no-vehicle")
