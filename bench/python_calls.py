#!/usr/bin/env python3
"""What calls of the Python package cost: microseconds a call, for the 50 cars of the city, best of seven.

Usage: tools/build_wheel.sh, then build/python/venv/bin/python bench/python_calls.py
"""
import time
import timeit

import numpy as np

import roboss


def measure(call, times, after=lambda: None):
    """Best of seven rounds, us a call; after() follows each round and does not count."""
    best = float("inf")
    for _ in range(7):
        best = min(best, timeit.timeit(call, number=times) / times)
        after()
    return best * 1e6


def main():
    sim = roboss.Simulation(roboss.example("city.sdf"), threads=1)
    cars = sim.robots("car_*")
    targets, poses = np.full((50, 4), 8.0), cars.pose.copy()
    cars.set_joint_targets(targets)
    sim.step(250)

    def set_poses():
        cars.pose = poses

    rows = [("tick", lambda: sim.tick, 2000), ("twist", lambda: cars.twist, 2000), ("pose", lambda: cars.pose, 2000),
            ("joint_velocity", lambda: cars.joint_velocity, 2000),
            ("link_pose", lambda: cars.link_pose("chassis"), 500), ("set pose", set_poses, 500),
            ("set_joint_targets", lambda: cars.set_joint_targets(targets), 20), ("save", sim.save, 200),
            ("laser", cars["laser"].read, 20), ("step(1)", sim.step, 200), ("step(10)", lambda: sim.step(10), 50),
            ("reset", sim.reset, 100)]
    for name, call, times in rows:
        print(f"{name:20s} {measure(call, times, after=sim.step):9.2f} us")
    views_that_are_held()


def views_that_are_held():
    """What live views cost a step of one tick: medians of 41 rounds by turns, thread time."""
    spent = {"nothing is held": [], "four live views": []}
    sim = roboss.Simulation(roboss.example("city.sdf"), threads=1)
    cars = sim.robots("car_*")
    for _ in range(41):
        for what, times in spent.items():
            held = [cars.pose, cars.twist, cars.joint_position, cars.joint_velocity] if what != "nothing is held" else []
            sim.reset()
            cars.set_joint_targets(8.0)
            start = time.thread_time()
            for _ in range(200):
                sim.step()
            times.append((time.thread_time() - start) / 200 * 1e6)
            del held
    for what, times in spent.items():
        print(f"step(1), {what}: {np.median(times):.2f} us, quartiles {np.percentile(times, [25, 75]).round(2)}")


main()
