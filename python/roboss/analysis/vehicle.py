"""Figures of vehicles: steady circle, braking, weave (slalom), and UMBmark, as functions of arrays.

Positions in m, headings in rad, times in s.
"""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import ArgumentError
from ..robots import Floats


@dataclass(frozen=True)
class CircleScore:
    """A steady circle: radius m, speed m/s, yaw rate rad/s, lateral acceleration m/s^2, and the spread of the radius m
    (three standard deviations)."""

    radius: float
    speed: float
    yaw_rate: float
    lateral_acceleration: float
    radius_spread: float


def circle_score(time: Floats, xy: Floats) -> CircleScore:
    """Steady-state circular driving, in the manner of ISO 4138: the circle through positions (T, 2) by least squares
    (Kasa, 1976: x^2 + y^2 = 2 a x + 2 b y + c), and the mean speed on it."""
    _need(xy, 2, 8)
    terms = np.column_stack([2 * xy, np.ones(len(xy))])
    (a, b, c), *_ = np.linalg.lstsq(terms, (xy**2).sum(axis=1), rcond=None)
    radius = float(np.sqrt(c + a * a + b * b))
    around = np.unwrap(np.arctan2(xy[:, 1] - b, xy[:, 0] - a))
    rate = float((around[-1] - around[0]) / (time[-1] - time[0]))
    spread = 3 * np.hypot(xy[:, 0] - a, xy[:, 1] - b).std(ddof=1)
    return CircleScore(radius, abs(rate) * radius, rate, rate * rate * radius, float(spread))


@dataclass(frozen=True)
class StopScore:
    """Braking: initial speed m/s, distance m, time s, mean deceleration over the distance m/s^2, largest sideways
    deviation m."""

    speed: float
    distance: float
    time: float
    mean_deceleration: float
    deviation: float


def stop_score(time: Floats, xy: Floats, brake_at: float, *, rest_speed: float = 0.01) -> StopScore:
    """Stopping in a straight line, in the manner of ISO 21994: from the time of the brake command to rest.

    The mean deceleration is v^2 / (2 s). The deviation is that from the line of the initial velocity.
    """
    _need(xy, 2, 8)
    velocity = np.gradient(xy, time, axis=0)
    begin = int(np.searchsorted(time, brake_at))
    before = velocity[max(0, begin - 3):max(1, begin)].mean(axis=0)
    speed = float(np.linalg.norm(before))
    slow = np.flatnonzero(np.linalg.norm(velocity[begin:], axis=1) < rest_speed)
    if len(slow) == 0 or speed <= rest_speed:
        raise ArgumentError("it does not come from a drive to rest", "record until it stands", "no-stop")
    end = begin + int(slow[0])
    along = before / speed
    moved = xy[begin:end + 1] - xy[begin]
    distance = float(moved[-1] @ along)
    aside = moved @ np.array([-along[1], along[0]])
    return StopScore(speed, distance, float(time[end] - time[begin]), speed**2 / (2 * distance), float(np.abs(aside).max()))


@dataclass(frozen=True)
class WeaveScore:
    """A weave: gain of the yaw rate (response over command), its lag s, peak yaw rate rad/s, peak lateral acceleration
    m/s^2."""

    gain: float
    lag: float
    yaw_rate: float
    lateral_acceleration: float


def weave_score(time: Floats, yaw: Floats, speed: Floats, command: Floats, frequency: float) -> WeaveScore:
    """A slalom on a sinusoidal command, in the manner of the weave test of ISO 13674-1.

    Args:
        yaw: (T,) heading, rad. speed: (T,), m/s. command: (T,) commanded yaw rate, rad/s, of this frequency (Hz).

    Gain and lag are those of the first harmonics: least squares of cosine, sine and a constant.
    """
    rate = np.gradient(np.unwrap(yaw), time)
    phase = 2 * np.pi * frequency * time
    terms = np.column_stack([np.cos(phase), np.sin(phase), np.ones(len(time))])
    (response, wanted) = (complex(*np.linalg.lstsq(terms, values, rcond=None)[0][:2]) for values in (rate, command))
    ratio = response / wanted  # cos, sin as a complex number: a later response has a larger angle
    return WeaveScore(abs(ratio), float(np.angle(ratio) / (2 * np.pi * frequency)), float(np.abs(rate).max()),
                      float(np.abs(rate * speed).max()))


@dataclass(frozen=True)
class UmbmarkScore:
    """UMBmark of odometry.

    Attributes:
        center_cw, center_ccw: (2,), m: mean return position errors.
        max_systematic: E_max,syst, m: the larger of their lengths.
        alpha, beta: rad: turning error of a corner, and bend of a side.
        wheel_ratio: E_d: right over left wheel diameter.
        track_ratio: E_b: actual over nominal distance of the wheels.
    """

    center_cw: Floats
    center_ccw: Floats
    max_systematic: float
    alpha: float
    beta: float
    wheel_ratio: float
    track_ratio: float


def umbmark_score(errors_cw: Floats, errors_ccw: Floats, side: float, track: float) -> UmbmarkScore:
    """Borenstein and Feng: Measurement and correction of systematic odometry errors in mobile robots, IEEE Transactions
    on Robotics and Automation 12(6), 1996.

    Args:
        errors_cw, errors_ccw: (n, 2), m: return position errors, actual less computed position, of squares that begin
            along x from the origin, clockwise and counter-clockwise.
        side: L of the square, m.
        track: nominal distance of the wheels b, m.

    With the centres of gravity x of the errors:
    alpha = (x_cw + x_ccw) / (-4 L), beta = (x_cw - x_ccw) / (-4 L), R = (L / 2) / sin(beta / 2),
    E_d = (R + b / 2) / (R - b / 2), E_b = (pi / 2) / (pi / 2 - alpha).
    """
    _need(errors_cw, 2, 1)
    _need(errors_ccw, 2, 1)
    cw, ccw = errors_cw.mean(axis=0), errors_ccw.mean(axis=0)
    alpha, beta = (cw[0] + ccw[0]) / (-4 * side), (cw[0] - ccw[0]) / (-4 * side)
    bend = np.sin(beta / 2) / (side / 2)  # 1 / R; 0: straight
    ratio = (1 + bend * track / 2) / (1 - bend * track / 2)
    return UmbmarkScore(cw, ccw, float(max(np.linalg.norm(cw), np.linalg.norm(ccw))), float(alpha), float(beta), float(ratio),
                        float((np.pi / 2) / (np.pi / 2 - alpha)))


def odometry(left: Floats, right: Floats, radius: float, track: float) -> Floats:
    """Dead reckoning of a differential drive from wheel angles (T,) in rad: (T, 3): x, y in m, heading in rad; from zero.

    Each step is an arc (second order: the heading in its middle).
    """
    steps = np.diff(np.column_stack([left, right]), axis=0) * radius
    heading = np.concatenate([[0], np.cumsum((steps[:, 1] - steps[:, 0]) / track)])
    middle, length = (heading[1:] + heading[:-1]) / 2, steps.mean(axis=1)
    xy = np.cumsum(np.column_stack([length * np.cos(middle), length * np.sin(middle)]), axis=0)
    return np.column_stack([np.vstack([[0, 0], xy]), heading])


def _need(array: Floats, columns: int, rows: int) -> None:
    if array.ndim != 2 or array.shape[1] != columns or len(array) < rows:
        raise ArgumentError(f"an array of shape {array.shape}", f"give {rows} rows or more of {columns} numbers", "bad-shape")
