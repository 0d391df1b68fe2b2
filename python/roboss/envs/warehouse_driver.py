"""A driver for the carriers of the warehouse: it takes the free direction next to its way, and slows down for others."""
from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .warehouse_hall import BEAMS, RANGE_M

_ANGLES = np.linspace(-np.pi / 2, np.pi / 2, BEAMS)
_HALF_WIDTH_M, _BODY_M, _STOP_M = 0.42, 0.36, 0.35  # wanted beside the way; needed; in front


def fetch_and_carry(observations: NDArray) -> NDArray[np.float64]:
    """Actions, (N, 2), of N carriers from their observations, (N, 33). It has no memory.

    A carrier turns towards the free direction that is nearest to its way, drives as fast as the free way ahead allows,
    stops at its goal, and backs a little where it is blocked. It is a measure to compare with, and not a good one: where
    many meet it jams, and it collides, because the laser does not see behind. CarrierTraffic does not.
    """
    seen = np.asarray(observations, dtype=np.float64)
    ranges, wish = seen[:, :BEAMS] * RANGE_M, np.arctan2(seen[:, 24], seen[:, 23])
    distance, way = seen[:, 25] * 10, seen[:, 26] * 40
    behind = np.abs(wish) > 1.7  # it turns on the spot, whatever is in front
    chosen = _direction(ranges, wish, distance)
    angle = np.where(behind, wish, chosen)
    ahead = _free_way(ranges, np.zeros(1), _BODY_M)[:, 0]
    speed = np.minimum(1.2, 0.9 * (ahead - _STOP_M)) * np.clip(1.2 - 1.3 * np.abs(angle), 0, 1)
    speed = np.clip(speed, 0, np.maximum(0.15, 0.8 * way))  # slower near the goal
    blocked = (np.abs(seen[:, 21]) * 1.5 < 0.05) & (ranges[:, 5:16].min(axis=1) < _STOP_M) & ~behind
    speed = np.where(way < 0.35, 0, np.where(blocked & (way > 0.4), -0.3, speed))
    turns_away = (ahead < _STOP_M + 0.07) & (np.abs(angle) < 0.3) & ~behind
    turn = np.where(turns_away, -1.0, 2.2 * angle)
    return np.stack([speed / 1.2, turn / 2.0], axis=1).clip(-1, 1)


def _direction(ranges: NDArray, wish: NDArray, distance: NDArray) -> NDArray[np.float64]:
    """Of the directions of the beams the one to take, rad: free, near to the wish, rather to the right."""
    enough = np.minimum(distance, 1.6)[:, None]
    lacks = np.maximum(0, 1 - _free_way(ranges, _ANGLES, _HALF_WIDTH_M) / np.maximum(enough, 0.3))
    cost = np.abs(_ANGLES - wish[:, None]) + 3.0 * lacks + 0.1 * (_ANGLES > 0.01)
    best = _ANGLES[cost.argmin(axis=1)]
    return np.where(np.abs(best - wish) < 0.1, wish, best)


def _free_way(ranges: NDArray, angles: NDArray, half_width: float) -> NDArray[np.float64]:
    """How far each carrier could go in each direction before something is in its width, m, (N, angles)."""
    off = _ANGLES - angles[:, None]
    along, aside = ranges[:, None, :] * np.cos(off), np.abs(ranges[:, None, :] * np.sin(off))
    blocks = (ranges[:, None, :] < 0.999 * RANGE_M) & (np.cos(off) > 0.05) & (aside < half_width)
    return np.where(blocks, along, RANGE_M).min(axis=2)
