"""A driver for the city, as arrays: that of examples/city_driver (its driving.cpp), which "follows the gap".

Among directions ahead it takes the one that is free for long, near to straight on, and towards the goal (in the spirit
of the dynamic window of Fox, Burgard and Thrun, 1997). It is what learned drivers are compared with.
"""
from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .car import HALF_TRACK_M, action_of, rims
from .city_view import BEAMS, RANGE_M, View, unpack

TOP_SPEED, BACK_SPEED = 1.55, -0.6     # m/s
TOP_TURN = 2.2                         # rad/s
HALF_WIDTH, BODY_HALF_WIDTH = 0.30, 0.19  # m, of the lane that it wants, and of the one that it needs
STOP, LOOK_AHEAD = 0.25, 4.0           # m, free way at which it stands; more free way than this is not better
GAIN = 2.6                             # 1/s, turn rate for an angle
SPEED_STEP = 0.22                      # m/s, most that a wheel gains in a control period of 0.05 s

_BEAM_STEP = np.pi / (BEAMS - 1)
_BEAM_ANGLES = -0.5 * np.pi + _BEAM_STEP * np.arange(BEAMS)
_DIRECTIONS = np.arange(-17, 18) * (np.pi / 36)
_AHEAD = np.zeros(1)


def follow_the_gap(observations: NDArray) -> NDArray[np.float64]:
    """Actions, (N, 2), of N cars from their observations, (N, 29). It has no memory.

    >>> cars = roboss.envs.CityVectorEnv(num_envs=8)
    >>> observations, _ = cars.reset(seed=1)
    >>> for _ in range(20):
    ...     observations, *_ = cars.step(roboss.envs.follow_the_gap(observations))
    >>> bool((observations[:, 21] > 0.2).any())          # they drive
    True
    """
    view = unpack(observations)
    ordered = np.stack(rims(view.last_action))
    change = _wished(view, *ordered) - ordered
    most_up = np.where(ordered < 0, 2 * SPEED_STEP, SPEED_STEP)  # gently when a wheel gains speed, else twice as fast
    most_down = np.where(ordered > 0, 2 * SPEED_STEP, SPEED_STEP)
    return action_of(*(ordered + np.clip(change, -most_down, most_up)))


def _free_way(view: View, angles: NDArray, half_width: float) -> NDArray[np.float64]:
    """How far each car could go in each direction before something comes nearer than half_width, m, (N, angles)."""
    off = _BEAM_ANGLES - angles[:, None]
    ranges = view.ranges[:, None, :]
    along, aside = ranges * np.cos(off), np.abs(ranges * np.sin(off))
    in_lane = (ranges < RANGE_M) & (np.cos(off) > 0) & (aside < half_width)
    reach = along - np.sqrt(np.maximum(0, half_width**2 - aside**2))
    way = np.where(in_lane, np.maximum(0, reach), RANGE_M).min(axis=2)
    # Between two beams that both end, there is most likely a wall from one end to the other.
    right = np.clip((angles - _BEAM_ANGLES[0]) / _BEAM_STEP, 0, BEAMS - 1).astype(int)
    left = np.minimum(right + 1, BEAMS - 1)
    return np.minimum(way, np.maximum(view.ranges[:, right], view.ranges[:, left]))


def _best_direction(view: View) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The direction to take, rad, and the free way there, m."""
    way = _free_way(view, _DIRECTIONS, HALF_WIDTH)
    goal_weight = np.minimum(0.3, 0.06 * view.goal_distance)[:, None]
    score = (np.minimum(way, LOOK_AHEAD) / LOOK_AHEAD + 0.35 * np.cos(_DIRECTIONS)
             + goal_weight * np.cos(_DIRECTIONS - view.goal_angle[:, None]) - 0.02 * np.maximum(_DIRECTIONS, 0))
    best = score.argmax(axis=1)
    return _DIRECTIONS[best], way[np.arange(len(way)), best]


def _wheels(speed: NDArray, turn: NDArray) -> NDArray[np.float64]:
    difference = np.clip(turn, -TOP_TURN, TOP_TURN) * HALF_TRACK_M
    return np.stack([speed - difference, speed + difference])


def _wished(view: View, left: NDArray, right: NDArray) -> NDArray[np.float64]:
    """Speeds of the left and right rims, (2, N), m/s, that the driver wants; given those that it ordered last."""
    ordered, ordered_turn = 0.5 * (left + right), 0.5 * (right - left)
    ahead = _free_way(view, _AHEAD, BODY_HALF_WIDTH)[:, 0]
    angle, way = _best_direction(view)

    bend = np.maximum(0.25, 1 - 0.75 * np.abs(angle))
    speed = np.maximum(np.minimum(TOP_SPEED * bend, 1.3 * (ahead - STOP)), 0)
    wish = _wheels(speed, GAIN * angle)

    # Nowhere to go: turn on the spot, always to the same side, until there is.
    on_the_spot = np.abs(ordered) < 0.2
    turns = on_the_spot & (np.abs(ordered_turn) > 0.2)
    room = np.maximum(way, ahead)
    half = BEAMS // 2
    open_side = np.where(view.ranges[:, -half:].sum(axis=1) >= view.ranges[:, :half].sum(axis=1), 1.0, -1.0)
    side = np.where(turns, np.where(ordered_turn > 0, 1.0, -1.0), open_side)
    wish = np.where((room < 0.5) | (turns & (room < 0.8)), _wheels(np.zeros_like(side), 1.8 * side), wish)

    # Contact is felt by wheels that turn in vain. It backs a little then.
    pushes = (ordered > 0.5) & (view.speed < 0.1)
    turns_in_vain = on_the_spot & (np.abs(ordered_turn) > 0.4) & (np.abs(view.yaw_rate) < 0.1)
    still_backs = (ordered < -0.15) & (ahead < 0.5)
    backs_in_vain = (ordered < -0.3) & (view.speed > -0.05)
    backs = (pushes | turns_in_vain | still_backs) & ~backs_in_vain
    return np.where(backs, BACK_SPEED, wish)
