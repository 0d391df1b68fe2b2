"""MujocoOrder: coordinates and velocities of a robot as MuJoCo writes them (qpos, qvel), and as RoBOSS does."""
from __future__ import annotations

from typing import TYPE_CHECKING, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import ArgumentError
from .names import numbers

if TYPE_CHECKING:
    from .kinematics import RobotModel
    from .robots import Robots
    from .world import TypeFacts

Floats = NDArray[np.float64]


class MujocoOrder:
    """The order and conventions of MuJoCo for the robots of a type. Arrays have any number of leading axes.

    qpos, (..., nq): of a free base x y z (m) and quaternion w x y z; then each joint, in the order of the file: one
    number (rad or m), of a ball joint a quaternion w x y z. qvel, (..., nv): of a free base the linear velocity of its
    origin in world axes (m/s) and its angular velocity in its own axes (rad/s); then each joint, of a ball joint the
    angular velocity in the axes of its child.

    The file orders joints body by body, depth first, as MuJoCo does. So the qpos of a world is that of its robots, one
    behind the other as in World.robots. Joints that close loops (MJCF: <connect>, <weld>) have no coordinates.

    `q` and `v` are those of RobotModel: pose with a quaternion x y z w, twist in world axes, rotation vectors.

    Args:
        robot: a RobotModel, or Robots of one type.

    >>> world = roboss.load('''<mujoco><worldbody><body name="top"><freejoint/><geom size="0.1"/>
    ...   <body pos="0 0 1"><joint type="ball"/><geom size="0.1"/></body></body></worldbody></mujoco>''')
    >>> top = roboss.RobotModel(world)
    >>> order = roboss.MujocoOrder(top)
    >>> order.nq, order.nv
    (11, 9)
    >>> order.qpos(top.start)
    array([0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0.])
    """

    def __init__(self, robot: Union[RobotModel, Robots]):
        facts = getattr(robot, "_facts", None)
        if facts is None:
            raise ArgumentError(f"robot: a value of type '{type(robot).__name__}'", "give a RobotModel, or Robots of one type", "bad-type")
        self._set(facts)

    @classmethod
    def _of(cls, facts: TypeFacts) -> MujocoOrder:
        order = cls.__new__(cls)
        order._set(facts)
        return order

    def _set(self, facts: TypeFacts) -> None:
        kinds = facts.coordinates
        self._free = facts.free_base
        self._columns = [column for column, kind in enumerate(kinds) if kind != "loop"]  # of Robots.joint_position
        self._joints: list[tuple[int, bool]] = []  # (first column behind those of the base, whether it is a ball)
        column = 0
        kept = [kinds[number] for number in self._columns]
        while column < len(kept):
            ball = kept[column] == "ball"
            self._joints.append((column, ball))
            column += 3 if ball else 1
        balls = sum(ball for _, ball in self._joints)
        self.nv: int = column + (6 if self._free else 0)  #: numbers of a qvel
        self.nq: int = column + balls + (7 if self._free else 0)  #: numbers of a qpos

    def q(self, qpos: ArrayLike) -> Floats:
        """(..., nq) to the q of RobotModel."""
        qpos = self._array("qpos", qpos, self.nq)
        parts = [qpos[..., :3], _xyzw(qpos[..., 3:7])] if self._free else []
        at = 7 if self._free else 0
        for _, ball in self._joints:
            parts.append(_logarithm(qpos[..., at:at + 4]) if ball else qpos[..., at:at + 1])
            at += 4 if ball else 1
        return _joined(parts, qpos)

    def qpos(self, q: ArrayLike) -> Floats:
        """The q of RobotModel to (..., nq)."""
        base = 7 if self._free else 0
        q = self._array("q", q, base + sum(3 if ball else 1 for _, ball in self._joints))
        parts = [q[..., :3], _wxyz(q[..., 3:7])] if self._free else []
        for column, ball in self._joints:
            at = base + column
            parts.append(_exponential(q[..., at:at + 3]) if ball else q[..., at:at + 1])
        return _joined(parts, q)

    def v(self, qpos: ArrayLike, qvel: ArrayLike) -> Floats:
        """(..., nq) and (..., nv) to the v of RobotModel. Accelerations and forces (qacc, qfrc) convert alike."""
        qpos, qvel = self._array("qpos", qpos, self.nq), self._array("qvel", qvel, self.nv)
        return self._turn(qpos, qvel, _rotate)

    def qvel(self, q: ArrayLike, v: ArrayLike) -> Floats:
        """q and v of RobotModel to (..., nv). Accelerations and forces convert alike."""
        return self._turn(self.qpos(q), self._array("v", v, self.nv), lambda w, x: _rotate(w * [1, -1, -1, -1], x))

    def _turn(self, qpos: Floats, rates: Floats, turn) -> Floats:
        """Angular parts of `rates` turned by the quaternions of qpos."""
        leading = np.broadcast_shapes(qpos.shape[:-1], rates.shape[:-1])
        result = np.array(np.broadcast_to(rates, (*leading, rates.shape[-1])))
        if self._free:
            result[..., 3:6] = turn(qpos[..., 3:7], rates[..., 3:6])
        at, first = (7, 6) if self._free else (0, 0)
        for column, ball in self._joints:
            if ball:
                result[..., first + column:first + column + 3] = turn(
                    qpos[..., at:at + 4], rates[..., first + column:first + column + 3])
            at += 4 if ball else 1
        return result

    @staticmethod
    def _array(name: str, values: ArrayLike, columns: int) -> Floats:
        array = numbers(name, values)
        if array.ndim == 0 or array.shape[-1] != columns:
            raise ArgumentError(f"{name} of shape {array.shape}", f"give (..., {columns})")
        return array

    # What Robots.qpos and Robots.qvel do.

    def qpos_of(self, robots: Robots) -> Floats:
        """Robots.qpos."""
        return self.qpos(self._q_of(robots))

    def qvel_of(self, robots: Robots) -> Floats:
        """Robots.qvel."""
        joints = robots.joint_velocity[..., self._columns]
        v = np.concatenate([robots.twist, joints], axis=-1) if self._free else joints
        return self.qvel(self._q_of(robots), v)

    def put_qpos(self, robots: Robots, qpos: Floats) -> None:
        """Sets Robots.qpos: all of it, or nothing."""
        self._refuse_loops(robots)
        q = self.q(qpos)
        before = robots.pose.copy()
        if self._free:
            robots.pose = q[..., :7]
        try:
            if self._joints:
                robots.joint_position = q[..., 7:] if self._free else q
        except Exception:
            if self._free:
                robots.pose = before
            raise

    def put_qvel(self, robots: Robots, qvel: Floats) -> None:
        """Sets Robots.qvel: all of it, or nothing."""
        self._refuse_loops(robots)
        v = self.v(robots.qpos, qvel)
        before = robots.twist.copy()
        if self._free:
            robots.twist = v[..., :6]
        try:
            if self._joints:
                robots.joint_velocity = v[..., 6:] if self._free else v
        except Exception:
            if self._free:
                robots.twist = before
            raise

    def _q_of(self, robots: Robots) -> Floats:
        joints = robots.joint_position[..., self._columns]
        return np.concatenate([robots.pose, joints], axis=-1) if self._free else joints

    def _refuse_loops(self, robots: Robots) -> None:
        if len(self._columns) != len(robots.joints):
            raise ArgumentError("a robot whose joints close loops", "set joint_position: loops follow from the others",
                                "closed-loop")


def _joined(parts: list[Floats], like: Floats) -> Floats:
    return np.concatenate(parts, axis=-1) if parts else np.empty((*like.shape[:-1], 0))


def _xyzw(quaternion: Floats) -> Floats:
    length = np.linalg.norm(quaternion, axis=-1, keepdims=True)
    if np.any(length == 0):
        raise ArgumentError("a quaternion of length 0", "give w x y z of length 1")
    return quaternion[..., [1, 2, 3, 0]] / length


def _wxyz(quaternion: Floats) -> Floats:
    return quaternion[..., [3, 0, 1, 2]]


def _exponential(rotation: Floats) -> Floats:
    """Quaternion w x y z of a rotation vector."""
    angle = np.linalg.norm(rotation, axis=-1, keepdims=True)
    return np.concatenate([np.cos(angle / 2), rotation * np.sinc(angle / (2 * np.pi)) / 2], axis=-1)


def _logarithm(quaternion: Floats) -> Floats:
    """Rotation vector, of at most pi, of a quaternion w x y z."""
    xyzw = _xyzw(quaternion)
    xyzw = np.where(xyzw[..., 3:] < 0, -xyzw, xyzw)
    sine = np.linalg.norm(xyzw[..., :3], axis=-1, keepdims=True)
    angle = 2 * np.arctan2(sine, xyzw[..., 3:])
    return xyzw[..., :3] * np.where(sine > 1e-12, angle / np.maximum(sine, 1e-12), 2.0)


def _rotate(quaternion: Floats, vector: Floats) -> Floats:
    """The vector turned by a quaternion w x y z (of any length)."""
    quaternion = quaternion / np.linalg.norm(quaternion, axis=-1, keepdims=True)
    w, u = quaternion[..., :1], quaternion[..., 1:]
    t = 2 * np.cross(u, vector)
    return vector + w * t + np.cross(u, t)
