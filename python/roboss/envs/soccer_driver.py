"""A driver for soccer, from the observations of SoccerTask."""
from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .car import HALF_TRACK_M, TOP_SPEED_M_S, TOP_TURN_RAD_S
from .soccer_field import HALF_LENGTH_M, HALF_WIDTH_M

_BEHIND_M, _ALIGNED_RAD = 0.6, 0.5


def chase_the_ball(observations: NDArray) -> NDArray[np.float64]:
    """Actions, (N, 2), of N cars from their observations, (N, columns). It has no memory and knows no team-mates.

    A car drives to a place behind the ball, seen from the other team's goal, and then pushes it there.

    >>> env = roboss.envs.SoccerVectorEnv(num_envs=2, cars=1)
    >>> observations, _ = env.reset(seed=1)
    >>> before = observations[:, 6:8].copy()
    >>> for _ in range(60):
    ...     observations, *_ = env.step(roboss.envs.chase_the_ball(observations))
    >>> bool((np.hypot(*observations[:, 6:8].T) < np.hypot(*before.T)).any())    # nearer to the ball
    True
    """
    seen = np.asarray(observations, dtype=np.float64)
    ball, goal = 6 * seen[:, 6:8] + 0.2 * 4 * seen[:, 8:10], 12 * seen[:, 10:12]
    shot = goal - ball
    shot /= np.maximum(np.hypot(*shot.T), 1e-9)[:, None]
    to_ball = np.maximum(np.hypot(*ball.T), 1e-9)
    aligned = np.sum(shot * ball, axis=1) > np.cos(_ALIGNED_RAD) * to_ball
    aim = np.where(aligned[:, None], ball - 0.2 * shot, ball - _BEHIND_M * shot)
    # The ball is in the way: pass it on the side where the car is.
    blocked = ~aligned & (np.sum(shot * ball, axis=1) < 0) & (to_ball < 2 * _BEHIND_M)
    across = np.stack([-shot[:, 1], shot[:, 0]], axis=1)
    side = np.where(np.sum(across * ball, axis=1) > 0, -1.0, 1.0)
    aim = np.where(blocked[:, None], ball + _BEHIND_M * (side[:, None] * across - 0.3 * shot), aim)
    angle, distance = np.arctan2(aim[:, 1], aim[:, 0]), np.hypot(*aim.T)
    angle = np.where(distance < 0.15, np.arctan2(shot[:, 1], shot[:, 0]), angle)
    speed = np.clip(np.cos(angle), 0, 1) * np.where(aligned, 1.6, np.minimum(1.6, 0.4 + distance))
    turn = np.clip(2.5 * angle, -1, 1) * (TOP_SPEED_M_S - 0.6 * speed) / HALF_TRACK_M
    # In front of a wall where it does not move on, it backs.
    place, ahead = 6 * seen[:, :2], seen[:, 2:4]
    wall = np.any(np.abs(place + 0.4 * ahead) > [HALF_LENGTH_M - 0.1, HALF_WIDTH_M - 0.1], axis=1)
    speed = np.where(wall & (np.abs(2.5 * seen[:, 4]) < 0.1), -1.0, speed)
    return np.stack([speed / TOP_SPEED_M_S, turn / TOP_TURN_RAD_S], axis=1).clip(-1, 1)
