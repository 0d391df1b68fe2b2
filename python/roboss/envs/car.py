"""The car of the package's worlds: what an action does to its wheels, and where it heads.

An action is two numbers from -1 to 1: speed (1.6 m/s) and turn (2.2 rad/s, to the left). It sets the speeds of the
wheels' rims, speed - 0.30 m * turn on the left and speed + 0.30 m * turn on the right; the motors do what they can.
"""
from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..robots import Robots

TOP_SPEED_M_S, TOP_TURN_RAD_S = 1.6, 2.2
HALF_TRACK_M = 0.30  # effective: a skid-steered car turns by dragging its wheels sideways
WHEEL_RADIUS_M = 0.05
_WHEELS = ("front_left", "rear_left", "front_right", "rear_right")


def rims(actions: NDArray) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Speeds of the left and right wheels' rims, m/s, of actions (N, 2)."""
    speed, turn = actions[:, 0] * TOP_SPEED_M_S, actions[:, 1] * TOP_TURN_RAD_S
    return speed - HALF_TRACK_M * turn, speed + HALF_TRACK_M * turn


def action_of(left: NDArray, right: NDArray) -> NDArray[np.float64]:
    """Actions, (N, 2), that give the rims these speeds, m/s."""
    return np.stack([0.5 * (left + right) / TOP_SPEED_M_S,
                     0.5 * (right - left) / HALF_TRACK_M / TOP_TURN_RAD_S], axis=1).clip(-1, 1)


def drive(cars: Robots, actions: NDArray[np.float64]) -> None:
    """Orders the wheels of cars, of all their simulations, by actions (N, 2)."""
    limit = cars.joint_velocity_limits.min()
    left, right = (np.clip(speed / WHEEL_RADIUS_M, -limit, limit) for speed in rims(actions))
    targets = np.stack([left, left, right, right], axis=1)
    several = len(targets) != len(cars)  # of a batch: simulations are the first axis
    cars.set_joint_targets(targets.reshape(-1, len(cars), 4) if several else targets, _WHEELS)


def heading(pose: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Cosine and sine of the yaw of poses, (N, 7)."""
    x, y, z, w = pose[:, 3:].T
    ahead = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y + w * z)])
    cos, sin = ahead / np.maximum(np.linalg.norm(ahead, axis=0), 1e-12)
    return cos, sin


def poses_of(places: NDArray[np.float64]) -> NDArray[np.float64]:
    """Poses, (N, 7), of places, (N, 3): x, y in m and yaw in rad, on the ground."""
    poses = np.zeros((len(places), 7))
    poses[:, :2] = places[:, :2]
    poses[:, 5], poses[:, 6] = np.sin(places[:, 2] / 2), np.cos(places[:, 2] / 2)
    return poses
