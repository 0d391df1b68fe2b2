"""Trajectories between two places: of joints (jtraj) and of a tool along a straight line (ctraj)."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from .errors import ArgumentError
from .kinematics import _rows
from .names import filled, numbers, real
from .robots import Floats


@dataclass(frozen=True)
class JointTrajectory:
    """Joint positions over time; times are the first axis.

    Attributes:
        time: (T,), s.
        q: (T, ...): positions, rad or m.
        v: (T, ...): velocities, rad/s or m/s.
        a: (T, ...): accelerations, rad/s^2 or m/s^2.
    """

    time: Floats
    q: Floats
    v: Floats
    a: Floats


@dataclass(frozen=True)
class CartesianTrajectory:
    """Poses over time.

    Attributes:
        time: (T,), s.
        pose: (T, 7): x y z in m, unit quaternion x y z w.
        twist: (T, 6): linear velocity of the frame's origin in m/s, angular velocity in rad/s; axes of the frame in
            which the poses are.
    """

    time: Floats
    pose: Floats
    twist: Floats


def jtraj(q0: ArrayLike, q1: ArrayLike, time: ArrayLike, *, v0: ArrayLike = 0.0, v1: ArrayLike = 0.0) -> JointTrajectory:
    """Quintic polynomials from q0 to q1, with the velocities v0 and v1 at the ends and no acceleration there.

    For joints of one coordinate each; quaternions and rotation vectors are not moved this way (ctraj).

    Args:
        q0, q1: positions of the same shape, rad or m.
        time: (T,), s, ascending: the motion lasts from the first to the last.
        v0, v1: velocities of that shape, or one number; rad/s or m/s.

    >>> path = roboss.jtraj([0, 0], [1, -2], np.linspace(0, 2, 5))
    >>> path.q.round(3)[:, 0]
    array([0.   , 0.104, 0.5  , 0.896, 1.   ])
    >>> path.v[2]                                    # half-way, 15/8 of the mean velocity
    array([ 0.9375, -1.875 ])
    """
    time = _times(time)
    begin = np.ascontiguousarray(numbers("q0", q0))
    ends = [filled(name, values, begin.shape) for name, values in (("q1", q1), ("v0", v0), ("v1", v1))]
    if not all(np.all(np.isfinite(array)) for array in (begin, *ends)):
        raise ArgumentError("q0, q1, v0 or v1: a number that is not finite", code="not-finite")
    q, v, a = (np.empty((len(time), *begin.shape)) for _ in range(3))
    _core.joint_trajectory(begin, *ends, time, q, v, a)
    return JointTrajectory(time, q, v, a)


def ctraj(pose0: ArrayLike, pose1: ArrayLike, time: ArrayLike, *, ramp: float = 1 / 3) -> CartesianTrajectory:
    """Poses on the straight line from pose0 to pose1, turning at the same time about one axis by the shorter way (slerp).

    The speed rises during `ramp` of the time, stays, and falls during the same (trapezoid).

    Args:
        pose0, pose1: (7,): x y z in m, quaternion x y z w.
        time: (T,), s, ascending: the motion lasts from the first to the last.
        ramp: share of the time, 0 (at once) to 0.5 (never constant).

    >>> path = roboss.ctraj([0, 0, 0, 0, 0, 0, 1], [1, 0, 0, 0, 0, 1, 0], np.linspace(0, 3, 7))
    >>> path.pose.round(4)[:, 0]
    array([0.    , 0.0625, 0.25  , 0.5   , 0.75  , 0.9375, 1.    ])
    >>> path.twist[3].round(4)                       # half a turn about z in 3 s
    array([0.5   , 0.    , 0.    , 0.    , 0.    , 1.5708])
    """
    time = _times(time)
    if not 0 <= real("ramp", ramp) <= 0.5:
        raise ArgumentError(f"a ramp of {ramp}", "give a share of the time, 0 to 0.5")
    begin, end = (_rows(name, pose, 7, pose=True).reshape(7) for name, pose in (("pose0", pose0), ("pose1", pose1)))
    pose, twist = np.empty((len(time), 7)), np.empty((len(time), 6))
    _core.cartesian_trajectory(begin, end, float(ramp), time, pose, twist)
    return CartesianTrajectory(time, pose, twist)


def _times(time: ArrayLike) -> Floats:
    array = np.ascontiguousarray(numbers("time", time))
    if array.ndim != 1 or len(array) < 2 or not np.all(np.isfinite(array)) or not np.all(np.diff(array) >= 0) or \
            not array[-1] > array[0]:
        raise ArgumentError("time: it takes two or more ascending times in s, the last later than the first",
                            code="bad-shape")
    return array
