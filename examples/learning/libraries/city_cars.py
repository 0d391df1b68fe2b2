"""What all examples of this folder have in common: the cars of one city as sub-environments, and how well they drive.

The same task, seed and measure for each library: cars that drive by laser (docs/learning.md, "The city"), one world, one
sub-environment for each car. `SameStep` is the autoreset of Stable-Baselines3 and of most training scripts: an agent whose
episode is over starts again at once, and what it saw last is in `infos["final_obs"]`.
"""
import argparse
import sys
import time
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from imports import needed  # noqa: E402

with needed():
    import numpy as np

    import roboss.envs

SECONDS = 10.0  # of the measure
TICK_S = 0.005  # twice as fast as the city's own


def new_env(cars, seed, autoreset_mode="SameStep", worlds=1):
    """A gymnasium.vector.VectorEnv of the cars of one city, or of several."""
    env = roboss.envs.CityVectorEnv(num_envs=cars, worlds=worlds, autoreset_mode=autoreset_mode, dt=TICK_S)
    env.reset(seed=seed)
    return env


@dataclass(frozen=True)
class Drive:
    """How well cars drove: mean speed towards their goals, m/s, and collisions in a minute of a car."""

    speed: float
    collisions: float

    def __str__(self):
        return f"{self.speed:5.2f} m/s towards the goals, {self.collisions:5.2f} collisions in a minute of a car"


def drive(act, cars=32, seed=100):
    """Drive of a policy: act(observations (N, 29)) gives actions (N, 2). The same start each time."""
    env = new_env(cars, seed)
    observations, _ = env.reset(seed=seed)
    metres = collisions = 0.0
    steps = round(SECONDS / env.task.step_s)
    for _ in range(steps):
        observations, _, _, _, infos = env.step(np.clip(act(observations), -1, 1))
        metres, collisions = metres + infos["progress"].sum(), collisions + infos["collided"].sum()
    return Drive(float(metres) / (cars * SECONDS), float(collisions) / (cars * SECONDS / 60))


def arguments(description, steps=150_000, cars=64):
    """What the command line says: steps, cars, seed."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=int, default=steps, help="agent-steps to learn from")
    parser.add_argument("--cars", type=int, default=cars, help="sub-environments")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    for name in ("steps", "cars"):
        if getattr(given, name) < 1:
            parser.error(f"--{name} {getattr(given, name)}: give 1 or more")
    return given


def train_and_compare(train, act):
    """Calls train() between two measures of act(observations), and tells what it changed. Returns both."""
    before, start = drive(act), time.monotonic()
    print(f"before: {before}", flush=True)
    train()
    print(f"trained in {time.monotonic() - start:.0f} s", flush=True)
    after = drive(act)
    print(f"after:  {after}", flush=True)
    return before, after
