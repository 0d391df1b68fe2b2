"""Figures of walkers: cost of transport, and what each joint asks of its motor, as functions of arrays."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import ArgumentError
from ..robots import Floats

QUANTILES = (0.5, 0.95, 0.99)


@dataclass(frozen=True)
class TransportScore:
    """Cost of transport.

    Attributes:
        cost: positive mechanical work per weight and distance; without a unit.
        cost_net: the same with negative work counted back (a drive that recovers all).
        distance: along the ground, from begin to end, m.
        speed: mean, m/s.
        energy: positive work of all joints, J.
        power: mean of it, W.
    """

    cost: float
    cost_net: float
    distance: float
    speed: float
    energy: float
    power: float


def transport_score(time: Floats, power: Floats, xy: Floats, mass: float, gravity: float = 9.81) -> TransportScore:
    """Mechanical cost of transport c_mt = E / (m g d) (Tucker, The energetic cost of moving about, 1975; Collins et al.,
    Science 307, 2005).

    Args:
        time: (T,), s. power: (T, joints), W. xy: (T, 2), m. mass: kg. gravity: m/s^2.

    Work is integrated by the trapezoidal rule, per joint: one joint's negative work does not pay for another's.
    """
    if power.ndim != 2 or len(power) < 2:
        raise ArgumentError(f"a power of shape {power.shape}", "give two or more rows, a column for each joint", "bad-shape")
    distance = float(np.linalg.norm(xy[-1] - xy[0]))
    energy, net = (float(_integral(time, values).sum()) for values in (np.maximum(power, 0), power))
    weight = mass * gravity * distance
    duration = float(time[-1] - time[0])
    share = (lambda e: e / weight) if weight > 0 else (lambda e: float("inf"))
    return TransportScore(share(energy), share(net), distance, distance / duration, energy, energy / duration)


@dataclass(frozen=True)
class JointDemand:
    """What a joint asks of its motor: torque in N m (N), speed in rad/s (m/s), power in W.

    Attributes:
        effort_rms: heats the motor: its continuous torque must be above.
        effort_peak: largest magnitude: the peak torque must be above.
        effort_quantiles: magnitudes that are exceeded 50 %, 5 % and 1 % of the time.
        speed_peak, speed_quantiles: the same of the speed.
        power_rms, power_peak: of the mechanical power; peak: largest positive.
        power_mean: of the positive power.
    """

    effort_rms: float
    effort_peak: float
    effort_quantiles: tuple[float, ...]
    speed_peak: float
    speed_quantiles: tuple[float, ...]
    power_rms: float
    power_peak: float
    power_mean: float


def joint_demand(time: Floats, effort: Floats, velocity: Floats) -> JointDemand:
    """Demand of one joint from its torque (T,) and velocity (T,). Root mean squares are over time (trapezoidal rule)."""
    power = effort * velocity
    duration = time[-1] - time[0]
    mean = lambda values: float(_integral(time, values) / duration)
    return JointDemand(np.sqrt(mean(effort**2)), float(np.abs(effort).max()),
                       tuple(float(q) for q in np.quantile(np.abs(effort), QUANTILES)), float(np.abs(velocity).max()),
                       tuple(float(q) for q in np.quantile(np.abs(velocity), QUANTILES)), np.sqrt(mean(power**2)),
                       float(power.max()), mean(np.maximum(power, 0)))


def _integral(time: Floats, values: Floats) -> Floats:
    """Trapezoidal rule along the first axis."""
    widths = np.diff(time).reshape(-1, *[1] * (values.ndim - 1))
    return (0.5 * (values[1:] + values[:-1]) * widths).sum(axis=0)
