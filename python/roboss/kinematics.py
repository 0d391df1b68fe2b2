"""RobotModel: kinematics and dynamics of one robot, for many configurations at once and without a simulation."""
from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Iterable, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .errors import ArgumentError
from .names import flag, index_of, instance, names_of, numbers, real, unknown, whole
from .robots import Floats, Robots
from .world import World, load

_IDENTITY = (0.0, 0, 0, 0, 0, 0, 1)
_AXES = ["world", "tool"]  # in the order of FrameAxes


@dataclass(frozen=True)
class Follower:
    """A joint that follows another one (mimic, gearbox): position = multiplier * leader's position + offset."""

    joint: str
    leader: str
    multiplier: float
    offset: float


@dataclass(frozen=True)
class IKSolution:
    """What RobotModel.inverse_kinematics found; each array has the leading axes of the targets.

    Attributes:
        q: (..., q_columns): the configurations; without success, the best ones that were found.
        success: whether both errors are within the tolerance.
        position_error: m, along the axes that have a weight.
        orientation_error: rad, about the axes that have a weight.
        iterations: in all attempts.
        attempts: how many starts were tried.
    """

    q: Floats
    success: NDArray[np.bool_]
    position_error: Floats
    orientation_error: Floats
    iterations: NDArray[np.int64]
    attempts: NDArray[np.int64]


class RobotModel:
    """The kinematics and dynamics of one robot of a world, apart from any simulation. It runs the simulator's own
    routines; so it agrees with the simulation, and with Pinocchio to 1e-10 (docs/python.md).

    A configuration `q` has q_columns numbers: of a free base, first the pose of the robot (SDF model) frame in the
    world (x y z in m, quaternion x y z w), then one number for each of `joints` (rad or m; the three of a ball joint
    are a rotation vector). Velocities `v`, accelerations `a` and forces have v_columns numbers: of a free base first
    six, then one for each of `joints`. The six are the linear velocity of the origin of the base link (m/s) and its
    angular velocity (rad/s), in world axes; of forces, the force (N) and the torque about that origin (N m). The three
    of a ball joint are its angular velocity and torque in the joint frame of the file's parent. So `Robots.pose`,
    `twist`, `joint_position` and `joint_velocity` are such numbers; `configuration` and `velocity` put them together.

    Arrays take any number of leading axes: q of shape (N, q_columns) gives N results, one row gives one. Leading axes
    of several arguments are broadcast. Other threads of Python run meanwhile, and may use the same RobotModel.

    What it is: the tree of joints. Joints that follow others (`followers`) are columns of their own, except that
    inverse_kinematics keeps them together. A robot whose joints close loops is refused (ArgumentError, code
    "closed-loop"), unless `cut_loops`. Contacts, friction, motors, air and water are not part of it.

    Args:
        world: a World, or what `load` takes. `load(..., fixed_base=[name])` welds the base of a URDF to the world.
        robot: name of the robot; None: the only one of the world.
        cut_loops: leave out the joints that close loops (`cut_joints`); the rest moves freely.
        base_pose: where the robot frame of a fixed base stands in the world, (7,): x y z in m, quaternion x y z w; None: as
            in the file.

    >>> arm = roboss.RobotModel(roboss.example("arm.sdf"), "arm")
    >>> arm.joints
    ('yaw', 'shoulder', 'elbow', 'roll', 'bend', 'flange')
    >>> q = np.zeros((1000, 6)); q[:, 1] = np.linspace(0, 1, 1000)
    >>> arm.link_pose(q, "tool").shape, arm.jacobian(q, "tool").shape, arm.mass_matrix(q).shape
    ((1000, 7), (1000, 6, 6), (1000, 6, 6))
    """

    def __init__(self, world: Union[World, str, os.PathLike], robot: Optional[str] = None, *, cut_loops: bool = False,
                 base_pose: Optional[ArrayLike] = None):
        self.world: World = world if isinstance(world, World) else load(world)  #: that the robot is in
        names = self.world.robots
        if robot is None and len(names) != 1:
            raise ArgumentError(f"the world has {len(names)} robots", f"name one of: {', '.join(names[:8])}")
        self.name: str = names[0] if robot is None else robot  #: of the robot
        number = index_of("robot", self.name, list(names))
        self._facts = self.world._facts_of(number)
        base = None if base_pose is None else _rows("base_pose", base_pose, 7).reshape(7)
        if base is not None and self._facts.free_base:
            raise ArgumentError(f"a base_pose of '{self.name}', whose base is free", "give its pose in q", "free-base")
        self._core = _core.robot_model(self.world._model, number, flag("cut_loops", cut_loops), base)
        self._columns = self._core.columns
        frames = self.world._frames[number] if self.world._frames else []
        self._frames = {name: (link, np.array(pose)) for name, link, pose in frames if name not in self._facts.links}
        self._base_q, self._base_v = (7, 6) if self._facts.free_base else (0, 0)

    def __repr__(self) -> str:
        base = "free base and " if self.free_base else ""
        return f"<roboss.RobotModel '{self.name}': {base}{len(self.joints)} joints, {len(self.links)} links>"

    @property
    def free_base(self) -> bool:
        """Whether nothing fixes the robot to the world; then q begins with a pose, and v with a twist."""
        return bool(self._facts.free_base)

    @property
    def q_columns(self) -> int:
        """Numbers of a configuration."""
        return self._base_q + len(self._columns)

    @property
    def v_columns(self) -> int:
        """Numbers of velocities, accelerations and forces."""
        return self._base_v + len(self._columns)

    @property
    def joints(self) -> tuple[str, ...]:
        """Columns behind those of the base: each axis of each joint, in the order of the file, as Robots.joints."""
        return tuple(column[0] for column in self._columns)

    @property
    def links(self) -> tuple[str, ...]:
        """Names of the links."""
        return tuple(self._facts.links)

    @property
    def frames(self) -> tuple[str, ...]:
        """Names of places on links, which may stand for a link in all calls: `<frame>` of SDFormat, and links of a URDF
        that fixed joints merge into another one, as flanges and tool centre points."""
        return tuple(self._frames)

    @property
    def joint_limits(self) -> Floats:
        """Lowest and highest position of each joint, (joints, 2): rad or m; infinite where there is none."""
        return np.array([column[1:3] for column in self._columns]).reshape(-1, 2)

    @property
    def followers(self) -> tuple[Follower, ...]:
        """Joints that follow others, each with the first of a chain of leaders."""
        return tuple(Follower(name, self.joints[leader], multiplier, offset)
                     for column, (name, _, _, leader, multiplier, offset) in enumerate(self._columns) if leader != column)

    @property
    def cut_joints(self) -> tuple[str, ...]:
        """Joints that `cut_loops` left out."""
        return tuple(self._core.cut_joints)

    @property
    def start(self) -> Floats:
        """The configuration at the start of the world, (q_columns,)."""
        return np.array(self._core.start)

    def configuration(self, robots: Robots) -> Floats:
        """q of robots of this type in a simulation, (N, q_columns).

        >>> sim = roboss.Simulation(roboss.example("arm.sdf"))
        >>> arm = roboss.RobotModel(sim.world, "arm")
        >>> arm.configuration(sim.robots("arm")).shape
        (1, 6)
        """
        instance("robots", robots, Robots, "give what Simulation.robots returned")
        joints = robots.joint_position[..., self._columns_in(robots)]
        return np.concatenate([robots.pose, joints], axis=-1) if self.free_base else joints

    def velocity(self, robots: Robots) -> Floats:
        """v of robots of this type in a simulation, (N, v_columns)."""
        instance("robots", robots, Robots, "give what Simulation.robots returned")
        joints = robots.joint_velocity[..., self._columns_in(robots)]
        return np.concatenate([robots.twist, joints], axis=-1) if self.free_base else joints

    def link_pose(self, q: ArrayLike, link: str, *, tool: Optional[ArrayLike] = None) -> Floats:
        """Forward kinematics: poses of a link's frame in the world, (..., 7): x y z in m, unit quaternion x y z w.

        Args:
            q: (..., q_columns).
            link: name of a link, or one of `frames`.
            tool: pose (7,) of a tool in the link's frame, x y z in m, quaternion x y z w; then the result is the tool's.

        >>> arm = roboss.RobotModel(roboss.example("arm.sdf"), "arm")
        >>> arm.link_pose([0, 0, 0, 0, 0, 0], "tool").round(3)
        array([0.  , 0.  , 1.45, 0.  , 0.  , 0.  , 1.  ])
        """
        q, = self._arrays(q=q)
        out = np.empty((*q.shape[:-1], 7))
        self._core.tool_poses(q, *self._place(link, tool), out)
        return out

    def link_poses(self, q: ArrayLike) -> Floats:
        """Poses of the frames of all `links` in the world, (..., links, 7), as link_pose."""
        q, = self._arrays(q=q)
        out = np.empty((*q.shape[:-1], len(self.links), 7))
        self._core.link_poses(q, out)
        return out

    def link_twist(self, q: ArrayLike, v: ArrayLike, link: str, *, tool: Optional[ArrayLike] = None) -> Floats:
        """Velocities of a link's frame, (..., 6): linear in m/s, of its origin (with `tool`, of the tool's origin);
        angular in rad/s; world axes. v: (..., v_columns)."""
        q, v = self._arrays(q=q, v=numbers("v", v))
        out = np.empty((*q.shape[:-1], 6))
        self._core.tool_twists(q, v, *self._place(link, tool), out)
        return out

    def jacobian(self, q: ArrayLike, link: str, *, tool: Optional[ArrayLike] = None, axes: str = "world") -> Floats:
        """Geometric Jacobians J of a link's frame, (..., 6, v_columns): twist = J v.

        Rows 0 to 2 are the linear velocity of the frame's origin (of the tool's, with `tool`), rows 3 to 5 the angular
        velocity. The transpose gives the joint forces of a force (N) at that origin and a torque (N m).

        Args:
            q, link, tool: as of link_pose.
            axes: "world" (jacob0 of the Robotics Toolbox, LOCAL_WORLD_ALIGNED of Pinocchio), or "tool": axes of the
                link or tool (jacobe, LOCAL).

        >>> arm = roboss.RobotModel(roboss.example("arm.sdf"), "arm")
        >>> arm.jacobian([0, 0, 0, 0, 0, 0], "tool")[:3, 1].round(3)     # a turn of the shoulder moves it along x
        array([1.1, 0. , 0. ])
        """
        q, = self._arrays(q=q)
        out = np.empty((*q.shape[:-1], 6, self.v_columns))
        self._core.tool_jacobians(q, *self._place(link, tool), _in_tool(axes), out)
        return out

    def inverse_kinematics(self, target: ArrayLike, link: str, *, start: Optional[ArrayLike] = None,
                           tool: Optional[ArrayLike] = None, weights: ArrayLike = (1, 1, 1, 1, 1, 1),
                           axes: str = "world", joints: Union[str, Iterable[str], None] = None,
                           tolerance: float = 1e-8, iterations: int = 100, attempts: int = 100, seed: int = 0,
                           path: bool = False) -> IKSolution:
        """Configurations in which a link's frame, or a tool, is at the targets: damped least squares
        (Levenberg-Marquardt) within the joint limits, from several starts.

        The first attempt begins at `start`, the others at random positions within the limits, which depend on `seed`
        alone: a target has the same solution in every batch. A free base stays where `start` has it. Joints that
        follow others do so.

        Args:
            target: (..., 7): poses in the world, x y z in m, quaternion x y z w.
            link, tool: what is to be there, as of link_pose.
            start: (..., q_columns); None: the start of the world.
            weights: (6,) of the errors along x y z (m) and about them (rad); 0: does not matter. [1, 1, 1, 0, 0, 0]
                asks for a position only.
            axes: of the weights: "world", or "tool" for those of the target's frame. [1, 1, 1, 1, 1, 0] with "tool":
                free to turn about the z axis of the tool.
            joints: names of those that may move; None: all.
            tolerance: m and rad.
            iterations: of an attempt, at most.
            attempts: at most; 1: only from `start`.
            path: the targets are a path: each search after the first begins at the solution before.

        Returns an IKSolution; whether it was found is in its `success`.

        >>> arm = roboss.RobotModel(roboss.example("arm.sdf"), "arm")
        >>> found = arm.inverse_kinematics([0.4, 0.2, 0.6, 0, 1, 0, 0], "tool")      # the tool looks down
        >>> bool(found.success), arm.link_pose(found.q, "tool").round(6)[:3]
        (True, array([0.4, 0.2, 0.6]))
        """
        if not real("tolerance", tolerance) > 0:
            raise ArgumentError(f"tolerance: {tolerance}", "give a number above 0", "bad-value")
        options = dict(tolerance=float(tolerance), iterations=whole("iterations", iterations, 1, 2**31 - 1),
                       attempts=whole("attempts", attempts, 1, 2**31 - 1), seed=whole("seed", seed), path=flag("path", path))
        weights = _rows("weights", weights, 6).reshape(6)
        if np.any(weights < 0) or not np.any(weights):
            raise ArgumentError(f"weights {weights}", "give 0 or more for each axis, and more than 0 for some")
        target = _rows("target", target, 7, pose=True)
        start = self._q("start", self.start if start is None else start)
        target, start = _broadcast(target=target, start=start)
        q, report = np.empty_like(start), np.empty((*target.shape[:-1], 5))
        self._core.inverse_kinematics(*self._place(link, tool), list(weights), _in_tool(axes), options,
                                      self._moving(joints), target, start, q, report)
        return IKSolution(q, report[..., 0] != 0, report[..., 1], report[..., 2], report[..., 3].astype(np.int64),
                          report[..., 4].astype(np.int64))

    def inverse_dynamics(self, q: ArrayLike, v: Optional[ArrayLike] = None, a: Optional[ArrayLike] = None, *,
                         gravity: Optional[ArrayLike] = None) -> Floats:
        """Forces M(q) a + C(q, v) v + g(q) that give the accelerations, (..., v_columns): N m or N (recursive
        Newton-Euler; rne of the Robotics Toolbox, rnea of Pinocchio).

        Rotor inertias are in it. Friction, springs and dampers of joints are not: see passive_forces.

        Args:
            q: (..., q_columns).
            v: (..., v_columns); None: at rest.
            a: (..., v_columns), rad/s^2 or m/s^2; None: zeros.
            gravity: (3,) in m/s^2, world axes; None: that of the world.

        >>> arm = roboss.RobotModel(roboss.example("arm.sdf"), "arm")
        >>> held = arm.inverse_dynamics([0, 1.57, 0, 0, 0, 0])       # stretched out
        >>> bool(held[1] < -50)                                      # N m, at the shoulder
        True
        """
        q, v, a = self._arrays(q=q, v=v, a=a)
        out = np.empty((*q.shape[:-1], self.v_columns))
        self._core.inverse_dynamics(q, v, a, self._gravity(gravity), out)
        return out

    def gravity_forces(self, q: ArrayLike, *, gravity: Optional[ArrayLike] = None) -> Floats:
        """g(q): forces that hold the robot at rest, (..., v_columns): N m or N."""
        return self.inverse_dynamics(q, gravity=gravity)

    def coriolis_forces(self, q: ArrayLike, v: ArrayLike) -> Floats:
        """C(q, v) v: Coriolis, centrifugal and gyroscopic forces, (..., v_columns): N m or N."""
        return self.inverse_dynamics(q, v, gravity=(0, 0, 0))

    def coriolis_matrix(self, q: ArrayLike, v: ArrayLike) -> Floats:
        """C(q, v), (..., v_columns, v_columns): of all matrices with C v = coriolis_forces, the one for which
        dM/dt - 2 C is skew-symmetric (Christoffel symbols; Echeandia and Wensing, 2021)."""
        q, v = self._arrays(q=q, v=numbers("v", v))
        out = np.empty((*q.shape[:-1], self.v_columns, self.v_columns))
        self._core.coriolis_matrices(q, v, out)
        return out

    def mass_matrix(self, q: ArrayLike) -> Floats:
        """M(q), (..., v_columns, v_columns): symmetric, kg m^2, kg m or kg; rotor inertias are in it."""
        q, = self._arrays(q=q)
        out = np.empty((*q.shape[:-1], self.v_columns, self.v_columns))
        self._core.mass_matrices(q, out)
        return out

    def forward_dynamics(self, q: ArrayLike, v: Optional[ArrayLike] = None, forces: Optional[ArrayLike] = None, *,
                         gravity: Optional[ArrayLike] = None) -> Floats:
        """Accelerations M^-1 (forces - C v - g), (..., v_columns): rad/s^2 or m/s^2 (accel of the Robotics Toolbox,
        aba of Pinocchio). Arguments as of inverse_dynamics; forces: (..., v_columns) in N m or N; None: zeros.

        >>> arm = roboss.RobotModel(roboss.example("arm.sdf"), "arm")
        >>> q, v, a = np.full(6, 0.3), np.full(6, 0.5), np.arange(6.0)
        >>> np.allclose(arm.forward_dynamics(q, v, arm.inverse_dynamics(q, v, a)), a)
        True
        """
        q, v, forces = self._arrays(q=q, v=v, forces=forces)
        out = np.empty((*q.shape[:-1], self.v_columns))
        self._core.forward_dynamics(q, v, forces, self._gravity(gravity), out)
        return out

    def passive_forces(self, q: ArrayLike, v: Optional[ArrayLike] = None) -> Floats:
        """Forces of the joints' springs and dampers, (..., v_columns): -stiffness * (position - reference) - damping *
        velocity, N m or N. A motor must give inverse_dynamics minus these. Joint friction is not in it."""
        q, v = self._arrays(q=q, v=v)
        out = np.empty((*q.shape[:-1], self.v_columns))
        self._core.passive_forces(q, v, out)
        return out

    def _place(self, name: str, tool: Optional[ArrayLike]) -> tuple[int, Floats]:
        """The link's number, and where on it the tool is."""
        on_link = _rows("tool", _IDENTITY if tool is None else tool, 7, pose=True).reshape(7)
        if name not in self._frames:
            return index_of("link", name, [*self._facts.links, *self._frames], f" of '{self.name}'"), on_link
        link, frame = self._frames[name]
        out = np.empty(7)
        _core.compose(frame, on_link, out)
        return link, out

    def _columns_in(self, robots: Robots) -> list[int]:
        joints = list(robots.joints)
        return [index_of("joint", name, joints, f" of '{robots._facts.name}'") for name in self.joints]

    def _moving(self, joints: Union[str, Iterable[str], None]) -> list[bool]:
        if joints is None:
            return []
        chosen = {index_of("joint", name, list(self.joints), f" of '{self.name}'")
                  for name in names_of("joints", joints)}
        return [column in chosen for column in range(len(self._columns))]

    def _gravity(self, gravity: Optional[ArrayLike]) -> Floats:
        return _rows("gravity", self.world.gravity if gravity is None else gravity, 3).reshape(3)

    def _q(self, what: str, values: ArrayLike) -> Floats:
        return _rows(what, values, self.q_columns, pose=self.free_base)

    def _arrays(self, *, q: ArrayLike, **others: Optional[ArrayLike]) -> list[Optional[Floats]]:
        """q and the others, with the same leading axes; what is None stays None."""
        rows = {name: _rows(name, values, self.v_columns) for name, values in others.items() if values is not None}
        same = dict(zip(["q", *rows], _broadcast(q=self._q("q", q), **rows)))
        return [same.get(name) for name in ["q", *others]]


def _rows(what: str, values: ArrayLike, columns: int, *, pose: bool = False) -> Floats:
    """The values as rows of finite numbers; with `pose`, each begins with a pose whose quaternion is not zero."""
    array = numbers(what, values)
    if array.ndim == 0 or array.shape[-1] != columns:
        raise ArgumentError(f"{what}: an array of shape {array.shape}; its last axis takes {columns} numbers",
                            code="bad-shape")
    if not np.all(np.isfinite(array)):
        raise ArgumentError(f"{what}: a number that is not finite", code="not-finite")
    if pose and np.any(np.sum(array[..., 3:7] ** 2, axis=-1) < 1e-12):
        raise ArgumentError(f"{what}: a quaternion that is zero", "a pose is x y z and a quaternion x y z w", "no-rotation")
    return np.ascontiguousarray(array)


def _broadcast(**arrays: Floats) -> list[Floats]:
    """The arrays with the same leading axes."""
    try:
        leading = np.broadcast_shapes(*(array.shape[:-1] for array in arrays.values()))
    except ValueError:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in arrays.items())
        raise ArgumentError(f"arrays that do not fit each other: {shapes}", "all but their last axes are broadcast",
                            "bad-shape") from None
    return [np.ascontiguousarray(np.broadcast_to(array, (*leading, array.shape[-1]))) for array in arrays.values()]


def _in_tool(axes: str) -> bool:
    if axes not in _AXES:
        raise unknown("kind of axes", axes, _AXES)
    return axes == "tool"
