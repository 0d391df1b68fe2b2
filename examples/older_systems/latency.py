#!/usr/bin/env python3
"""How much latency can a control loop tolerate? A rod is balanced upright by a motor, with delayed measurements.

    python examples/older_systems/latency.py

A loop at 1 kHz holds a rod on a hinge upright: torque = -kp angle - kd speed, of what was measured some ticks ago. All
delays are tried at once, each in a simulation of its own. The limit is known: with a = m g l / J, b = kp / J and
c = kd / J the rod obeys x'' = a x - b x(t - T) - c x'(t - T). It begins to oscillate where
|b + i c w| = w^2 + a, at T = atan2(c w, b) / w (characteristic equation on the imaginary axis).
"""
import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from imports import needed  # noqa: E402

with needed():
    import numpy as np

    import roboss

LENGTH, MASS = 1.0, 1.0                                   # m, kg


def rod_world():
    """A rod on a hinge in the ground; position 0 is upright."""
    world = roboss.WorldBuilder("rod", dt=0.001)
    rod = world.model("rod")
    rod.box("rod", [0.04, 0.04, LENGTH], mass=MASS, pose=[0, 0, LENGTH / 2], color=[0.9, 0.5, 0.1])
    rod.joint("hinge", "revolute", "world", "rod", axis=[0, 1, 0], at=[0, 0, -LENGTH / 2], effort=100)
    return world.build()


def delay_limit(kp, kd):
    """The longest delay in s at which the loop is stable, by the characteristic equation."""
    inertia = MASS * (LENGTH**2 / 3 + 0.04**2 / 12)
    a, b, c = MASS * 9.8 * LENGTH / 2 / inertia, kp / inertia, kd / inertia
    # (w^2 + a)^2 = b^2 + c^2 w^2: a quadratic equation of w^2
    p, q = 2 * a - c**2, a**2 - b**2
    w = np.sqrt(-p / 2 + np.sqrt(p**2 / 4 - q))
    return np.arctan2(c * w, b) / w


def balance(kp, kd, delays, seconds=10.0):
    """Largest angle (rad) of the last second for each delay in ticks of 1 ms."""
    batch = roboss.Batch(rod_world(), len(delays))
    rods = batch.robots("rod")
    rods.joint_position = 0.01
    past = np.zeros((max(delays) + 1, 2, len(delays)))
    number, largest = np.arange(len(delays)), np.zeros(len(delays))
    ticks = round(seconds / 0.001)
    for tick in range(ticks):
        past[tick % len(past)] = rods.joint_position.reshape(-1), rods.joint_velocity.reshape(-1)
        angle, speed = past[(tick - np.array(delays)) % len(past), :, number].T
        rods.set_joint_targets((-kp * angle - kd * speed).reshape(rods.joint_position.shape), mode="effort")
        batch.step(1)
        if tick >= ticks - 1000:
            largest = np.maximum(largest, np.abs(rods.joint_position.reshape(-1)))
    return largest


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kp", type=float, default=40.0, help="N m/rad")
    parser.add_argument("--kd", type=float, default=8.0, help="N m s/rad")
    arguments = parser.parse_args()
    if arguments.kp <= MASS * 9.8 * LENGTH / 2 or arguments.kd <= 0:
        parser.error(f"without latency the rod stands if kp is above m g l / 2 = {MASS * 9.8 * LENGTH / 2:g} N m/rad and kd above 0")
    limit = delay_limit(arguments.kp, arguments.kd)
    delays = sorted({max(1, round(1000 * limit * share)) for share in (0.2, 0.5, 0.8, 0.95, 1.05, 1.2, 1.5)})
    print(f"limit by the characteristic equation: {1000 * limit:.1f} ms")
    for delay, angle in zip(delays, balance(arguments.kp, arguments.kd, delays)):
        print(f"{delay:4d} ms: largest angle in the last second {np.degrees(angle):9.4f} degrees, "
              + ("stable" if angle < 0.01 else "unstable"))


if __name__ == "__main__":
    main()
