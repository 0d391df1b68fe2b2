#!/usr/bin/env python3
"""A spider plans its gait while it walks: cross-entropy method with a receding horizon, on branches of the simulation.

Every 0.25 s the environment is branched: each branch continues from this moment with another gait, and the best one is
taken for the next 0.25 s. Prints the speed of the plain gait, and the one with plans.

Usage: plan_spider.py [--seconds 4] [--branches 16] [--threads N] [--seed 1] [--quiet]
It needs the gait: tools/build.sh release roboss_spider_gait.
"""
import argparse
import sys
import time
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(EXAMPLES), str(EXAMPLES / "spider")]
from imports import needed  # noqa: E402

with needed():
    import numpy as np
    from gymnasium.spaces import Box

    import roboss
    import roboss.envs
    from gait import GaitError, Gaits
    from walking import MOST_TURN, PERIOD, STAND, TURN_CHANGE, TURN_GAIN, upright, yaw_of

PLAIN = EXAMPLES / "spider" / "gaits" / "walk.toml"
# An action changes these numbers of the plain gait: from -1 to 1, with 0 for its own value.
RANGES = {"period_s": (0.18, 0.9), "duty": (0.36, 0.65), "stride": (0.04, 0.22), "lift": (0.02, 0.06),
          "height": (0.09, 0.15), "reach": (0.15, 0.29), "lead_s": (0.0, 0.035)}
HORIZON_S, TAKEN_S = 0.75, 0.25  # how far a branch walks; how much of the best one is taken
ROUNDS, ELITE = 2, 0.25           # rounds of a plan; part of the samples that shapes the next round
SPREAD, LEAST_SPREAD = 0.5, 0.15  # standard deviation of the first samples, and of later ones at least
FALLEN, LEAN, LEAN_COST = 0.5, 0.1, 2.0  # upright below: it fell; rad; m/s for each rad above


class SpiderTask(roboss.envs.Task):
    """Spiders, one in each world, whose actions are gaits; a step is a period of control, 10 ms.

    The reward is the way along x, m, less what a leaning trunk costs; a spider that falls is terminated. Observation:
    quaternion and height of the trunk, angles of the 18 joints.
    """

    def __init__(self, gaits, **options):
        world = roboss.load(roboss.example("spider.sdf"))
        size = np.ones(len(RANGES), np.float32)
        super().__init__(world, ("spider_0",), Box(-np.inf, np.inf, (23,)), Box(-size, size),
                         ticks=round(PERIOD / world.dt), **{"episode_steps": 10**6, **options})
        self.gaits, self.plain = gaits, gaits.load(PLAIN)
        self.columns = [gaits.names.index(name) for name in RANGES]
        self.cycles = np.zeros(self.count)  # steps of every foot since the start; it continues when the gait changes
        self.turns = np.zeros(self.count)   # rad a stride, to keep the heading
        self.x = np.zeros(self.count)       # m

    def gaits_of(self, actions):
        """Rows of numbers of gaits, (count, numbers), of actions."""
        low, high = np.array(list(RANGES.values())).T
        middle = self.plain[self.columns]
        rows = np.tile(self.plain, (len(actions), 1))
        actions = np.clip(actions, -1, 1)
        rows[:, self.columns] = middle + np.where(actions > 0, high - middle, middle - low) * actions
        return rows

    def observe(self):
        pose = self.rows_of(self.robots.pose)
        angles = self.rows_of(self.robots.joint_position)
        return np.concatenate([pose[:, 3:], pose[:, 2:3], angles], axis=1).astype(np.float32)

    def act(self, actions):
        rows = self.gaits_of(actions)
        wish = np.clip(-TURN_GAIN * yaw_of(self.rows_of(self.robots.pose)), -MOST_TURN, MOST_TURN)
        self.turns += np.clip(wish - self.turns, -TURN_CHANGE * PERIOD, TURN_CHANGE * PERIOD)
        period = rows[:, self.gaits.names.index("period_s")]
        self.cycles += PERIOD / period
        targets = [self.gaits.targets(rows[[i]], self.cycles[i] * period[i], self.turns[[i]])
                   for i in range(self.count)]
        self.robots.set_joint_targets(self.by_world(np.concatenate(targets)), mode="position")

    def outcome(self, rng):
        pose = self.rows_of(self.robots.pose)
        progress, self.x = pose[:, 0] - self.x, pose[:, 0].copy()
        up = upright(pose)
        lean = np.arccos(np.clip(up, -1, 1))
        rewards = progress - LEAN_COST * self.step_s * np.maximum(0, lean - LEAN)
        fell = up < FALLEN
        return np.where(self.present, rewards - fell, 0.0), fell & self.present, {"progress": progress, "lean": lean}

    def place(self, agents, rng):
        self.put(agents, np.tile([0, 0, 0, 0, 0, 0, 1.0], (agents.sum(), 1)))
        self.cycles[agents] = -STAND / self.plain[self.gaits.names.index("period_s")]
        self.turns[agents] = self.x[agents] = 0

    def remove(self, agents):
        """One that fell lies where it is."""


class Planner:
    """The cross-entropy method over one gait for the whole horizon; the next plan begins with the last one's."""

    def __init__(self, branches, seed):
        self.count, self.rng = branches, np.random.default_rng(seed)
        self.mean, self.spider_seconds = np.zeros(len(RANGES)), 0.0

    def plan(self, env):
        """The best action found for what comes; `env` stays as it is."""
        spread, best = np.full(len(RANGES), SPREAD), (-np.inf, self.mean)
        for _ in range(ROUNDS):
            samples = self.mean + spread * self.rng.normal(size=(self.count, len(RANGES)))
            samples[0] = best[1]
            samples = np.clip(samples, -1, 1)
            values = self.walk(env.branch(self.count), samples)
            order = np.argsort(-values)
            if values[order[0]] > best[0]:
                best = values[order[0]], samples[order[0]]
            elite = samples[order[:max(2, round(ELITE * self.count))]]
            self.mean, spread = elite.mean(axis=0), np.maximum(elite.std(axis=0), LEAST_SPREAD)
        return best[1]

    def walk(self, branches, samples):
        """Sum of rewards of each branch over the horizon."""
        values = np.zeros(branches.num_envs)
        for _ in range(round(HORIZON_S / PERIOD)):
            values += branches.step(samples)[1]
        self.spider_seconds += HORIZON_S * branches.num_envs
        return values


def walk(env, seconds, planner=None, told=None):
    """Speed along x in the second half of the time, m/s, and the largest lean, rad: of the plain gait, or with plans.

    `told(time, speed, action)` is called for each plan.
    """
    env.reset(seed=0)
    steps, action, xs, lean = round(seconds / PERIOD), np.zeros(len(RANGES)), [0.0], 0.0
    for step in range(steps):
        if planner is not None and step % round(TAKEN_S / PERIOD) == 0:
            action = planner.plan(env)
            if told is not None:
                told(step * PERIOD, (xs[-1] - xs[-round(TAKEN_S / PERIOD):][0]) / TAKEN_S, action)
        _, _, fell, _, infos = env.step(action)
        xs.append(env.task.x[0])
        lean = max(lean, infos["lean"])
        if fell:
            break
    return (xs[-1] - xs[min(len(xs) - 1, steps // 2)]) / (PERIOD * (steps - steps // 2)), lean


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=4.0, help="of the walk; its second half counts (default 4)")
    parser.add_argument("--branches", type=int, default=16, help="of each round of a plan (default 16)")
    parser.add_argument("--threads", type=int, help="that step the branches; default: all cores")
    parser.add_argument("--seed", type=int, default=1, help="of the samples")
    parser.add_argument("--quiet", action="store_true", help="print the result alone")
    given = parser.parse_args()
    if given.branches < 4 or not given.seconds >= TAKEN_S:
        parser.error(f"give 4 branches or more, and {TAKEN_S} s or more")
    try:
        env = roboss.envs.TaskEnv(SpiderTask(Gaits(), threads=given.threads))
    except (GaitError, roboss.RobossError) as error:
        print(f"plan_spider: {error}", file=sys.stderr)
        return 2

    def told(now, speed, action):
        values = zip(RANGES, env.task.gaits_of(action[None])[0, env.task.columns])
        gait = "  ".join(f"{name} {value:.3f}" for name, value in values)
        print(f"{now:5.2f} s  {speed:.2f} m/s  {gait}", flush=True)

    planner, begin = Planner(given.branches, given.seed), time.perf_counter()
    plain, plain_lean = walk(env, given.seconds)
    planned, lean = walk(env, given.seconds, planner, None if given.quiet else told)
    wall = time.perf_counter() - begin
    print(f"plain gait {plain:.2f} m/s, with plans {planned:.2f} m/s; they lean by up to "
          f"{np.degrees(plain_lean):.1f} and {np.degrees(lean):.1f} degrees")
    print(f"{planner.spider_seconds:.0f} s of walking on branches in {wall:.0f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
