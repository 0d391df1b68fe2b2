#!/usr/bin/env python3
"""64 cars in one city learn to drive by laser without touching anything.

Writes the driver (city_policy.npz) and the curve (city_curve.csv, a row for each update: agent-steps, seconds, and the
metres towards the goals and collisions of the update). The same seed gives the same driver on one machine, if --minutes is
long enough for all steps.

Usage: train_city.py [--steps 2500000] [--cars 64] [--seed 1] [--output FOLDER]
"""
import argparse
import time
from pathlib import Path

import numpy as np
from gymnasium.vector import VectorWrapper

import roboss.envs
from city_features import features, new_policy
from ppo import Learner, Settings


class KeepDistance(VectorWrapper):
    """Also costs up to 0.1 m a step where something is nearer than 0.6 m: it shows the way before there is a collision."""

    def step(self, actions):
        """See gymnasium.vector.VectorEnv.step."""
        observations, rewards, *rest = self.env.step(actions)
        view = roboss.envs.city_view.unpack(observations)
        return observations, rewards - 0.1 * np.maximum(0, 1 - view.ranges.min(axis=1) / 0.6), *rest


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=int, default=2_500_000, help="agent-steps to learn from")
    parser.add_argument("--minutes", type=float, default=20, help="stop after this time, whatever was learned")
    parser.add_argument("--cars", type=int, default=64)
    parser.add_argument("--threads", type=int, default=None, help="that step the world; default: all cores")
    parser.add_argument("--dt", type=float, default=0.005, help="length of a tick, s; 0.002 is the city's own")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--output", type=Path, default=Path(__file__).parent)
    given = parser.parse_args()
    env = roboss.envs.CityVectorEnv(num_envs=given.cars, autoreset_mode="SameStep", threads=given.threads,
                                     dt=given.dt)
    policy = new_policy(given.seed)
    learner = Learner(KeepDistance(env), policy, Settings(), given.seed, features)
    curve = learn(learner, given.steps, given.minutes * 60)
    policy.save(given.output / "city_policy.npz")
    np.savetxt(given.output / "city_curve.csv", curve, fmt="%.6g", delimiter=",",
               header="agent_steps,seconds,metres,collisions", comments="")


def learn(learner, most_steps, most_seconds):
    """Rows of the curve, one for each update."""
    per_update = learner.settings.steps * learner.env.num_envs
    updates, start, curve = max(1, most_steps // per_update), time.monotonic(), []
    for update in range(updates):
        done = max(update / updates, (time.monotonic() - start) / most_seconds)
        if done >= 1:
            break
        learner.env.unwrapped.task.collision_cost = 5 + 10 * min(1.0, 2 * done)  # first to drive, then to drive with care
        learner.update(learner.collect(), done)
        curve.append(((update + 1) * per_update, time.monotonic() - start, learner.told["progress"],
                      learner.told["collided"]))
        if (update + 1) % 10 == 0:
            report(curve[-10:], per_update * learner.env.unwrapped.task.step_s)
    return np.array(curve)


def report(rows, car_seconds):
    """One line about the last updates; `car_seconds`: simulated time of an update, summed over the cars."""
    metres, collisions = np.sum(rows, axis=0)[2:]
    print("%9d steps  %6.0f s  %5.2f m/s  %6.0f m for each collision" % (
        *rows[-1][:2], metres / (len(rows) * car_seconds), metres / max(1, collisions)), flush=True)


if __name__ == "__main__":
    main()
