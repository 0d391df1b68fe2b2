"""What a car of the city sees and does, as numbers: the columns of its observations and actions, and their scales.

Observation, 29 numbers from -1 to 1, float32:

| columns | meaning | scale |
|---|---|---|
| 0 to 20 | ranges of the laser, from the right (-90 degrees) to the left | 6 m; 1: nothing within reach |
| 21 | speed along the car | 2.5 m/s |
| 22 | yaw rate, to the left | 5 rad/s |
| 23, 24 | direction of the goal against straight ahead: cosine, sine | |
| 25 | distance of the goal | 20 m |
| 26, 27 | action of the last step | as below |
| 28 | 1: the car is in the city | |

Action, two numbers from -1 to 1: speed and turn, see help(roboss.envs.car).
"""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

BEAMS = 21
COLUMNS = BEAMS + 8
RANGE_M, SPEED_M_S, YAW_RATE_RAD_S, GOAL_M = 6.0, 2.5, 5.0, 20.0


@dataclass(frozen=True)
class View:
    """What N cars see; arrays (N,), but for ranges and actions."""

    ranges: NDArray[np.float64]         # (N, 21), m, at most RANGE_M
    speed: NDArray[np.float64]          # m/s, along the car
    yaw_rate: NDArray[np.float64]       # rad/s
    goal_angle: NDArray[np.float64]     # rad, to the left
    goal_distance: NDArray[np.float64]  # m, at most GOAL_M
    last_action: NDArray[np.float64]    # (N, 2), from -1 to 1
    present: NDArray[np.float64]        # 1: in the city


def pack(view: View) -> NDArray[np.float32]:
    """Observations, (N, 29)."""
    out = np.empty((len(view.speed), COLUMNS), dtype=np.float32)
    out[:, :BEAMS] = view.ranges / RANGE_M
    out[:, 21] = view.speed / SPEED_M_S
    out[:, 22] = view.yaw_rate / YAW_RATE_RAD_S
    out[:, 23], out[:, 24] = np.cos(view.goal_angle), np.sin(view.goal_angle)
    out[:, 25] = view.goal_distance / GOAL_M
    out[:, 26:28] = view.last_action
    out[:, 28] = view.present
    np.clip(out[:, :BEAMS], 0, 1, out=out[:, :BEAMS])
    return np.clip(out, -1, 1, out=out)


def unpack(observations: NDArray) -> View:
    """What the observations, (N, 29), mean."""
    seen = np.asarray(observations, dtype=np.float64)
    return View(seen[:, :BEAMS] * RANGE_M, seen[:, 21] * SPEED_M_S, seen[:, 22] * YAW_RATE_RAD_S,
                np.arctan2(seen[:, 24], seen[:, 23]), seen[:, 25] * GOAL_M, seen[:, 26:28], seen[:, 28])
