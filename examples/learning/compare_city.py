#!/usr/bin/env python3
"""The learned driver beside the hand-written one: the same city, the same starts, the same measure.

Each drives all cars for some minutes of simulated time. A car that touches something is taken away and starts again
elsewhere. Told are the mean speed towards the goals, the way towards the goals for each collision, and a score: metres
towards the goals in a minute of a car, minus 10 for each collision.

Usage: compare_city.py [--policy city_policy.npz] [--cars 64] [--minutes 3] [--seeds 100 101 102]
"""
import argparse
from pathlib import Path

import numpy as np

import roboss.envs
from city_features import load


def drive(driver, cars, minutes, seed, threads=None, world=None):
    """(metres towards goals, collisions, crossings, minutes of cars) of one driver."""
    env = roboss.envs.CityVectorEnv(num_envs=cars, autoreset_mode="SameStep", threads=threads, world=world)
    observations, _ = env.reset(seed=seed)
    sums = np.zeros(3)
    steps = round(minutes * 60 / env.task.step_s)
    for _ in range(steps):
        observations, _, _, _, infos = env.step(driver(observations))
        sums += [infos[name].sum() for name in ("progress", "collided", "arrived")]
    return np.array([*sums, cars * minutes])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--policy", type=Path, default=Path(__file__).with_name("city_policy.npz"))
    parser.add_argument("--cars", type=int, default=64)
    parser.add_argument("--minutes", type=float, default=3)
    parser.add_argument("--seeds", type=int, nargs="+", default=[100, 101, 102])
    parser.add_argument("--threads", type=int, default=None)
    given = parser.parse_args()
    print("| driver | m/s towards the goal | m for each collision | crossings a minute | score |\n|---|---|---|---|---|")
    for name, driver in (("hand-written", roboss.envs.follow_the_gap), ("learned", load(given.policy))):
        metres, collisions, crossings, car_minutes = sum(
            drive(driver, given.cars, given.minutes, seed, given.threads) for seed in given.seeds)
        print(f"| {name} | {metres / (60 * car_minutes):.2f} | {metres / max(1, collisions):.0f} | "
              f"{crossings / car_minutes:.1f} | {(metres - 10 * collisions) / car_minutes:.1f} |", flush=True)


if __name__ == "__main__":
    main()
