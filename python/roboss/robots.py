"""Robots: some robots of a simulation as arrays, robots the first axis."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, Iterable, Optional, Sequence, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .camera import RobotCameras
from .errors import ArgumentError, StateError, UnknownNameError
from .mujoco_order import MujocoOrder
from .names import filled, index_of, names_of, numbers, real, text, unknown, whole
from .parameters import JointParameters, LinkParameters, Surroundings
from .radio import Radio
from .sensors import Sensor
from .specs import ActionSpec, ObservationSpec, action_spec, observation_spec

if TYPE_CHECKING:
    from .batch import Batch
    from .run import Run
    from .world import TypeFacts

Floats = NDArray[np.float64]
Rows = Union[int, slice, Sequence[int], NDArray[Any]]  # some robots: their rows, or a mask
_MODES = ["passive", "velocity", "position", "effort"]  # in the order of MotorMode


class Robots:
    """Robots of a simulation. Simulation.robots makes it; N is their number, `len(robots)`.

    Robots of a Batch have one more axis in front: their poses are (simulations, N, 7).

    `pose`, `twist`, `joint_position` and `joint_velocity` are live views: read-only arrays that follow the simulation.
    After `step`, `reset`, `restore` and assignments, every array that the program still holds has the new state; so
    have its slices. `.copy()` keeps the state of a moment. They are copied from the states into the same memory, only
    while somebody holds them, and never within a step. After `spawn`, `remove` or `close` they keep their last values.
    All other arrays are new ones.

    What is assigned (`cars.pose = ...`) is in effect at once, and takes a full array, one row for all robots, or one
    number for everything; if one robot refuses it, nothing is changed (OrderError). `cars.pose[0] = ...` raises
    ValueError: assign `cars[0].pose`.

    Joints, links, sensors and commands are those that all robots have. Robots of one type have all of them: if parts
    or topics are called differently, the names of the first robot count, of commands what their names end in
    ("cmd_vel" for "robot_1/cmd_vel" and "robot_2/cmd_vel"). Of robots of different types it is what all have under one
    name: joints with the same unit, sensors of the same kind, commands with the same values.

    `robots["scan"]` is a Sensor, `robots[3]`, `robots[2:5]`, `robots[mask]` are some of the robots.

    >>> cars = roboss.Simulation(roboss.example("crossroads.sdf")).robots("car_*")
    >>> cars.joints
    ('front_left', 'front_right', 'rear_left', 'rear_right')
    >>> cars.joint_velocity = [1, 2, 1, 2]     # rad/s, each car the same
    >>> cars[3:5].joint_velocity
    array([[1., 2., 1., 2.],
           [1., 2., 1., 2.]])
    >>> speeds, before = cars.joint_velocity, cars.joint_velocity.copy()
    >>> cars.joint_velocity = 5
    >>> speeds[0], before[0]
    (array([5., 5., 5., 5.]), array([1., 2., 1., 2.]))
    """

    def __init__(self, simulation: Union[Run, Batch], ids: Sequence[int]):
        self.simulation: Any = simulation  #: that they are in: a Simulation, Batch or RemoteSimulation
        self.ids: tuple[int, ...] = tuple(ids)  #: their places in World.robots
        self._world, self._simulations = simulation.world, simulation._simulations  # both stay when robots come or go
        self._core = _core.robots(self._simulations, list(ids))
        self._in_common: Optional[TypeFacts] = None

    def __reduce__(self) -> tuple[Any, ...]:
        self._check_current()
        return Robots, (self.simulation, self.ids)

    def __len__(self) -> int:
        return len(self.ids)

    def __repr__(self) -> str:
        names = ", ".join(self.names[:3]) + (" ..." if len(self) > 3 else "")
        return f"<roboss.Robots: {len(self)} ({names})>"

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the robots, by row."""
        return tuple(self._world.robots[number] for number in self.ids)

    @property
    def _facts(self) -> TypeFacts:
        if self._in_common is None:
            if not self.ids:
                raise ArgumentError("a set of no robots has no joints, links, sensors and commands", "select some", "no-robot")
            self._in_common = self._world._facts_of_set(self.ids)
        return self._in_common

    @property
    def _joint_facts(self) -> TypeFacts:
        """The facts, of robots that have joints in common."""
        facts = self._facts
        if facts.axes or len(facts.types) < 2:
            return facts
        of_first, *of_others = (self._world._facts_of(number).axes for number in self.ids)
        everywhere = [name for name in of_first if all(name in axes for axes in of_others)]
        if everywhere:
            raise self._different("joint", everywhere[0])
        raise self._mixed("have no joint in common", "select robots with joints of one name")

    def _different(self, kind: str, name: str) -> ArgumentError:
        return self._mixed(f"have a {kind} '{name}' each, of different kinds", "select robots of one type")

    def _mixed(self, fault: str, remedy: str) -> ArgumentError:
        facts = self._facts
        return ArgumentError(f"these {len(self)} robots of {len(facts.types)} types ({facts.name}) {fault}", remedy,
                             "mixed-types")

    @property
    def joints(self) -> tuple[str, ...]:
        """Columns of the arrays of joints: each axis of each joint that moves; "NAME:0", "NAME:1" of several axes."""
        return tuple(self._joint_facts.axes)

    @property
    def links(self) -> tuple[str, ...]:
        """Names of the links."""
        return tuple(self._facts.links)

    @property
    def sensors(self) -> tuple[str, ...]:
        """Names of the sensors; `robots[name]` reads one."""
        return tuple(sensor[0] for sensor in self._facts.sensors)

    @property
    def commands(self) -> dict[str, tuple[tuple[str, str], ...]]:
        """Commands of on-board controllers: (name, unit) of each value, by the command's name."""
        return {command[0]: command[1] for command in self._facts.commands}

    @property
    def joint_limits(self) -> Floats:
        """Lowest and highest position of each joint, (joints, 2): rad or m; infinite where there is none."""
        return self._limits[:, :2]

    @property
    def joint_effort_limits(self) -> Floats:
        """Largest effort of each joint's motor, (joints,): N m or N."""
        return self._limits[:, 2]

    @property
    def joint_velocity_limits(self) -> Floats:
        """Largest velocity of each joint's motor, (joints,): rad/s or m/s."""
        return self._limits[:, 3]

    @property
    def _limits(self) -> Floats:
        limits = self._joint_facts.limits
        if limits is None:
            raise self._mixed("have joints with different limits", "ask robots of one type")
        return np.array(limits).reshape(-1, 4)

    @property
    def pose(self) -> Floats:
        """Poses of the robot (SDF model) frames in the world, (N, 7): x y z in m, unit quaternion x y z w. A live view.

        >>> cars = roboss.Simulation(roboss.example("crossroads.sdf")).robots("car_*")
        >>> cars[0].pose = [5, 1, 0.1, 0, 0, 0, 1]
        >>> cars[0].pose
        array([[5. , 1. , 0.1, 0. , 0. , 0. , 1. ]])
        """
        return self._core.pose(self._single)

    @pose.setter
    def pose(self, values: ArrayLike) -> None:
        self._core.set_poses(self._fill("pose", values, 7))

    @property
    def twist(self) -> Floats:
        """Velocities of the bases, (N, 6): linear in m/s, of the origin of the base link; angular in rad/s; world axes.

        A live view. Zero where the base is fixed; setting it there raises OrderError.
        """
        return self._core.twist(self._single)

    @twist.setter
    def twist(self, values: ArrayLike) -> None:
        self._core.set_twists(self._fill("twist", values, 6))

    @property
    def joint_position(self) -> Floats:
        """Positions of the joints, (N, joints): rad or m, zero as in the file; of a ball joint a rotation vector.

        A live view. Set positions beyond the limits are pushed back within some ticks. Joints that close loops follow from the
        others and cannot be set (OrderError, code "loop-joint").
        """
        self._joint_facts  # raises: they have joints in common
        return self._core.joint_position(self._single)

    @joint_position.setter
    def joint_position(self, values: ArrayLike) -> None:
        self._core.set_joint_positions(self._fill("joint_position", values, len(self._joint_facts.axes)))

    @property
    def joint_velocity(self) -> Floats:
        """Velocities of the joints, (N, joints): rad/s or m/s. A live view."""
        self._joint_facts  # raises: they have joints in common
        return self._core.joint_velocity(self._single)

    @joint_velocity.setter
    def joint_velocity(self, values: ArrayLike) -> None:
        self._core.set_joint_velocities(self._fill("joint_velocity", values, len(self._joint_facts.axes)))

    @property
    def joint_effort(self) -> Floats:
        """What the motors of the joints gave, mean over the last tick, (N, joints): N m or N. Zero at the start, and
        where a motor is off; joint friction, springs and limits are not in it. That of a motor with gains follows from
        its target and its present state.

        >>> arm = roboss.Simulation(roboss.example("arm.sdf")).robots("arm")
        >>> arm.joint_position = [0, 1.57, 0, 0, 0, 0]                  # stretched out
        >>> arm.set_joint_targets([0, 1.57, 0, 0, 0, 0], mode="position")
        >>> arm.simulation.step(200)
        >>> bool(arm.joint_effort[0, 1] < -50)                          # N m, holds itself at the shoulder
        True
        """
        return self._read(self._core.joint_efforts, len(self._joint_facts.axes))

    @property
    def energy(self) -> Floats:
        """Kinetic and potential energy of the robots, (N, 2): J. The potential energy is that of the links in the
        robot's gravity, zero at the world's origin. Rotor inertias and springs are not in it.

        >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
        >>> sim.robots("car_2").twist = [2, 0, 0, 0, 0, 0]
        >>> kinetic, potential = sim.robots("car_2").energy[0]
        >>> float(round(kinetic, 2))                                    # m v^2 / 2, of 6.2 kg
        12.4
        """
        return self._read(self._core.energies, 2)

    @property
    def qpos(self) -> Floats:
        """Coordinates of the robots in MuJoCo's order, (N, nq): of a free base x y z (m) and quaternion w x y z, then
        those of the joints, of a ball joint a quaternion w x y z. MujocoOrder has the order, and converts other arrays.

        >>> arms = roboss.Simulation(roboss.example("arm.sdf")).robots("arm")
        >>> arms.qpos = [0.1, 0.2, 0.3, 0, 0, 0]
        >>> arms.joint_position
        array([[0.1, 0.2, 0.3, 0. , 0. , 0. ]])
        """
        return self._mujoco.qpos_of(self)

    @qpos.setter
    def qpos(self, values: ArrayLike) -> None:
        self._mujoco.put_qpos(self, self._fill("qpos", values, self._mujoco.nq))

    @property
    def qvel(self) -> Floats:
        """Velocities of the robots in MuJoCo's order, (N, nv): of a free base linear in world axes (m/s) and angular in
        its own axes (rad/s), then those of the joints, of a ball joint in the axes of the child. Assign qpos first."""
        return self._mujoco.qvel_of(self)

    @qvel.setter
    def qvel(self, values: ArrayLike) -> None:
        self._mujoco.put_qvel(self, self._fill("qvel", values, self._mujoco.nv))

    @property
    def _mujoco(self) -> MujocoOrder:
        if len(self._facts.types) > 1:
            raise self._mixed("have no order of coordinates in common", "select robots of one type")
        return MujocoOrder._of(self._facts)

    def link_pose(self, link: str) -> Floats:
        """Poses of a link's frame in the world, (N, 7), as `pose`: x y z in m, unit quaternion x y z w."""
        return self._read(self._core.link_poses, 7, self._link(link))

    def link_twist(self, link: str) -> Floats:
        """Velocities of a link's frame, (N, 6), as `twist`: linear velocity of the frame's origin."""
        return self._read(self._core.link_twists, 6, self._link(link))

    @property
    def touching(self) -> NDArray[np.bool_]:
        """Whether each robot presses against another robot, or against scenery that does not carry it, (N,).

        Scenery carries a robot where the contact's normal is within 45 degrees of the vertical: the ground, a ramp.
        Contacts are those of Simulation.contacts: they carry a force in the tick that begins now.

        >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
        >>> cars = sim.robots("car_*")
        >>> cars.set_joint_targets(10.0)           # rad/s: they drive towards each other
        >>> sim.step(500); cars.touching.any()
        np.False_
        >>> sim.step(2000); cars.touching.all()
        np.True_
        """
        out = np.empty(self._rows, dtype=bool)
        self._core.touching(out)
        return out

    @property
    def parameters(self) -> JointParameters:
        """Numbers of the joints that may differ from robot to robot and change: damping, springs, gains, limits ...

        >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
        >>> cars = sim.robots("car_*")
        >>> cars.parameters["damping"] = np.linspace(0, 0.3, 16)[:, None]   # N m s/rad, another in each car
        >>> cars[15].parameters["damping"]
        array([[0.3, 0.3, 0.3, 0.3]])
        """
        return JointParameters(self)

    @property
    def link_parameters(self) -> LinkParameters:
        """Numbers of their links: masses, centres of mass, inertias, friction, bounce. See LinkParameters.

        >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
        >>> cars = sim.robots("car_*")
        >>> cars.link_parameters["friction"] = 0.3                          # slippery, all links that touch
        """
        return LinkParameters(self)

    @property
    def surroundings(self) -> Surroundings:
        """Gravity and steady wind that they feel, another in each robot if you like. See Surroundings.

        >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
        >>> sim.robots("*").surroundings["gravity"] = [0, 0, -1.62]         # m/s^2: all robots are on the moon
        """
        return Surroundings(self)

    def set_joint_targets(self, targets: ArrayLike, joints: Union[str, Iterable[str], None] = None, *,
                          mode: str = "velocity", max_effort: Optional[float] = None,
                          position_gain: Optional[ArrayLike] = None, velocity_gain: Optional[ArrayLike] = None) -> None:
        """Orders setpoints of motors, from the next tick on; they hold until the next ones.

        Args:
            targets: (N, joints): rad/s, rad or N m (m/s, m or N) by `mode`; one row for all robots; one number.
            joints: names of the columns of `targets`; None: all joints.
            mode: "velocity", "position", "effort", or "passive" (motor off).
            max_effort: bound in N m or N; None: the joint's own.
            position_gain: kp in N m/rad or N/m, (N, joints) as `targets`; a motor with it goes to its position by
                kp (target - position) - kd velocity, both at the end of the tick: stable at any gain. 0 is as stiff
                as the solver allows. None: it stays. It becomes the robots' own `parameters["position_gain"]`.
            velocity_gain: kd in N m s/rad or N s/m, likewise; in the mode "velocity" of kd (target - velocity).

        >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
        >>> cars = sim.robots("car_*")
        >>> cars.set_joint_targets([8, 10], ["front_left", "front_right"])
        >>> sim.step(200)
        >>> cars.joint_velocity[0].round(2)[:2]
        array([ 8., 10.])
        """
        columns = self._joint_columns(joints)
        if mode not in _MODES:
            raise unknown("motor mode", mode, _MODES)
        gains = [None if gain is None else self._fill(what, gain, len(columns))
                 for what, gain in (("position_gain", position_gain), ("velocity_gain", velocity_gain))]
        self._core.set_joints(columns, _MODES.index(mode), self._fill("targets", targets, len(columns)),
                              -1.0 if max_effort is None else real("max_effort", max_effort, 0), *gains)

    def apply_wrench(self, wrench: ArrayLike, link: Optional[str] = None, *, ticks: int = 1) -> None:
        """Pushes a link of each robot for `ticks` ticks from the next one on; wrenches add up.

        Args:
            wrench: (N, 6): force in N at the link's centre of mass, torque in N m; world axes.
            link: name; None: the first link of each robot.

        >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
        >>> sim.robots("car_2").apply_wrench([0, 0, 200, 0, 0, 0], ticks=50)
        >>> sim.step(50)
        >>> bool(sim.robots("car_2").twist[0, 2] > 1)
        True
        """
        self._core.apply_wrenches(None if link is None else self._link(link), self._fill("wrench", wrench, 6), whole("ticks", ticks))

    def command(self, name: str, values: Optional[ArrayLike] = None, **named: ArrayLike) -> None:
        """Gives a command to on-board controllers, from the next tick on; it holds until the next one.

        Args:
            name: one of `commands`, or the last parts of a name.
            values: (N, values of the command); one row for all robots. Of a command that is a list (a trajectory):
                its rows, for all robots.
            named: values by name, (N,) or one number each; those that are missing are 0.

        >>> sim = roboss.Simulation(roboss.example("drives.sdf"))
        >>> rover = sim.robots("rover")
        >>> rover.command("cmd_vel", linear_x=0.8, angular_z=0.5)
        >>> sim.step(500)
        >>> rover.joint_velocity.round(1)
        array([[5.6, 7.7]])
        """
        commands = self._facts.commands
        number = self._command(text("name", name))
        fields, is_list = [field for field, _ in commands[number][1]], commands[number][2]
        if is_list:
            table = numbers(f"command '{name}'", values).ravel()
            array = self._fill(f"command '{name}'", table, table.size)
        elif values is None:
            array = np.zeros((*self._rows, len(fields)))
            for field, value in named.items():
                column = index_of("value", field, fields, f" of command '{name}'")
                array[..., column] = filled(field, value, self._rows)
        else:
            array = self._fill(f"command '{name}'", values, len(fields))
        self._core.command(number, array.shape[-1], array)

    def camera(self, position: ArrayLike, target: ArrayLike, *, link: Optional[str] = None, size: tuple[int, int] = (64, 64),
               fov: float = 1.2, far: float = 50.0) -> RobotCameras:
        """A camera on each robot, which looks from `position` to `target` (m, in the robot frame) and moves with it.

        Args:
            link: name of the link in whose frame they are; None: the robot frame.
            size: columns and rows of its pictures.
            fov: angle that it sees across, rad.
            far: nothing is seen beyond it, m.
        """
        if link is not None:
            self._link(link)
        return RobotCameras(self, position, target, link, size, fov, far)

    def observation_spec(self, parts: Optional[Iterable[str]] = None) -> ObservationSpec:
        """The observation of these robots as one array, with names, units, frames and bounds of its columns.

        Args:
            parts: "joint_position", "joint_velocity", "pose", "twist", names of sensors; None: joints and all sensors
                whose readings are rows of numbers (no images, no lists that change their length).

        >>> cars = roboss.Simulation(roboss.example("city.sdf")).robots("car_*")
        >>> spec = cars.observation_spec(["laser", "joint_velocity"])
        >>> spec
        <roboss.ObservationSpec of 25 columns: laser (21 m), joint_velocity (4 rad/s)>
        >>> spec.read().shape, spec.names[20:22], spec.high[:2]
        ((50, 25), ('laser[20]', 'front_left'), array([6., 6.]))
        """
        return observation_spec(self, parts)

    def action_spec(self, mode: Optional[str] = None, *, command: Optional[str] = None, low: Optional[ArrayLike] = None,
                    high: Optional[ArrayLike] = None) -> ActionSpec:
        """The actions of these robots as one array: targets of all joints, or a command of on-board controllers.

        Args:
            mode: "velocity", "position" or "effort" of the joints' motors; bounds are their limits.
            command: a name in `commands`, instead.
            low, high: other bounds, (columns,) or one number.

        >>> arm = roboss.Simulation(roboss.example("arm.sdf")).robots("arm")
        >>> spec = arm.action_spec("position")
        >>> spec.names[:2], spec.low[:2], spec.units[0]
        (('yaw', 'shoulder'), array([-3.1, -1.9]), 'rad')
        >>> spec.give_scaled(0)                                # to the middle of all limits
        """
        return action_spec(self, mode, command, low, high)

    @overload
    def __getitem__(self, key: str) -> Sensor: ...
    @overload
    def __getitem__(self, key: Rows) -> Robots: ...
    def __getitem__(self, key: Union[str, Rows]) -> Union[Sensor, Robots]:
        if isinstance(key, str):
            return self._sensor(self._number("sensor", key, self.sensors, lambda own: [sensor[0] for sensor in own.sensors]))
        try:
            chosen = np.atleast_1d(np.asarray(self.ids, dtype=np.int64)[key])
        except IndexError as error:
            if isinstance(key, (int, np.integer)):
                raise  # it ends loops over the robots
            raise ArgumentError(f"robots {key!r}: {error}", "give a name, a row, a slice, rows or a mask", "bad-rows") from None
        if chosen.ndim != 1:
            raise ArgumentError(f"robots {key!r}", "give a name, a row, a slice, rows or a mask", "bad-rows")
        self._check_current()
        return Robots(self.simulation, [int(number) for number in chosen])

    def _check_current(self) -> None:
        if self._simulations is not self.simulation._simulations:
            raise StateError("robots were spawned or removed since these were asked for",
                             "ask Simulation.robots() again", "changed-world")

    def _sensor(self, number: int) -> Sensor:
        """The sensor of this number; of equal names `robots[name]` gives the first."""
        name, kind, rate, numbers = self._facts.sensors[number]
        return (Radio if kind == "radio" else Sensor)(self, number, name, kind, rate, numbers)

    def _link(self, name: str) -> int:
        return self._number("link", name, self._facts.links, lambda own: own.links)

    def _command(self, name: str) -> int:
        """By its name, by the name that the first robot has for it, or by the end of one of them."""
        commands = self._facts.commands
        for fits in (lambda known: known == name, lambda known: known.endswith("/" + name)):
            found = {number for number, command in enumerate(commands) if fits(command[0]) or fits(command[3])}
            if len(found) == 1:
                return found.pop()
        return self._number("command", name, [command[0] for command in commands],
                            lambda own: [command[0] for command in own.commands])

    def _number(self, kind: str, name: str, known: Sequence[str], of_one: Callable[[TypeFacts], Sequence[str]]) -> int:
        """The place of a part that all robots have. `of_one`: the names of such parts of one robot."""
        if name in known:
            return list(known).index(name)
        lacking = [robot for robot, number in zip(self.names, self.ids) if name not in of_one(self._world._facts_of(number))]
        if len(lacking) == len(self):
            raise unknown(kind, name, known, f" of '{self._facts.name}'")
        if not lacking:
            raise self._different(kind, name)
        shown = ", ".join(lacking[:8]) + (" ..." if len(lacking) > 8 else "")
        raise UnknownNameError(f"{len(lacking)} of these {len(self)} robots have no {kind} '{name}': {shown}",
                               "select the others, or a name that all have", "not-shared")

    @property
    def _single(self) -> bool:
        """Whether arrays have no axis of simulations."""
        return not self.simulation._shape

    @property
    def _rows(self) -> tuple[int, ...]:
        """Shape of an array without its columns."""
        return (*self.simulation._shape, len(self))

    def _joint_columns(self, joints: Union[str, Iterable[str], None]) -> list[int]:
        """Numbers of the columns of these joints; None: of all."""
        facts = self._joint_facts
        names = facts.axes if joints is None else names_of("joints", joints)
        return [self._number("joint", name, facts.axes, lambda own: own.axes) for name in names]

    def _fill(self, what: str, values: ArrayLike, columns: int) -> Floats:
        return filled(what, values, (*self._rows, columns))

    def _read(self, fill, columns: int, *more: int) -> Floats:
        out = np.empty((*self._rows, columns))
        fill(*more, out)
        return out
