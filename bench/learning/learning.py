#!/usr/bin/env python3
"""How fast agents of roboss.envs learn from RoBOSS, beside MuJoCo: agent-steps a second, with laser.

Cars of cities of the same density, 8, 64 and 512 in one world, and 8 in each of many small worlds. A step of an agent is
0.05 s, 25 ticks of 2 ms: targets of the wheels, the ticks, poses, velocities, collisions, 21 beams of a laser, the next
goal, the observation. `follow_the_gap` drives; its own time does not count. Engines take turns; the rows have medians:
CPU time of the process for an agent-step, which other work on the machine changes less, and agent-steps a second of the
clock.

Usage: ./bench.sh learning [--rounds 5] [--seconds 2] [--only 64] [--json FILE]
"""
import argparse
import json
import os
import platform
import subprocess
import time
from pathlib import Path

import numpy as np

import roboss
from mujoco_city import DepthCameras, MujocoCityTask, mujoco
from roboss.camera import _axes_of, _plane_of, _rays_of
from roboss.envs import CityTask, TaskVectorEnv, follow_the_gap

ROOT = Path(__file__).resolve().parents[2]
# cars in a world, worlds, camera
SIZES = ((8, 1, ""), (64, 1, ""), (512, 1, ""), (8, 8, ""), (8, 64, ""), (1, 64, ""), (8, 1, "depth"), (64, 1, "depth"),
         (8, 8, "depth"), (8, 1, "colours"), (64, 1, "colours"))
EYE_M, TARGET_M, PIXELS, FOV_RAD, FAR_M = (0.21, 0, 0.12), (1.21, 0, 0.1), (64, 64), 1.2, 50.0


def city_of(cars):
    """Path of a city for this number of cars, with the density of all cities of roboss-world."""
    path = ROOT / "build" / "bench" / f"city_{cars}.sdf"
    path.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run([ROOT / "build/release/bin/roboss-world", "city", "--cars", str(cars), "-o", path], check=True)
    return str(path)


class Entry:
    """One engine at one size."""

    def __init__(self, engine, threads, cars, worlds, camera):
        self.engine, self.threads, self.cars, self.worlds, self.camera = engine, threads, cars, worlds, camera
        sdf = city_of(cars)
        task = (CityTask(cars, worlds=worlds, world=sdf, threads=threads) if engine == "RoBOSS"
                else MujocoCityTask(sdf, cars, worlds, threads))
        self.env = TaskVectorEnv(task)
        self.look = self.look_of(task) if camera else lambda: None
        self.observations, _ = self.env.reset(seed=1)
        self.rates, self.cpu_us, self.metres, self.driven_s, self.collisions = [], [], 0.0, 0.0, 0
        self.run(0.0, least=20)  # up to speed
        self.rates.clear(), self.cpu_us.clear()

    def look_of(self, task):
        """What gives the images of all cars."""
        if self.engine == "MuJoCo":
            axes = _axes_of(np.array(EYE_M), np.array(TARGET_M))
            return DepthCameras(task.robots, EYE_M, _rays_of(_plane_of(PIXELS, FOV_RAD, FAR_M), axes), FAR_M).depth
        cameras = task.robots.camera(EYE_M, TARGET_M, size=PIXELS, fov=FOV_RAD, far=FAR_M)
        return cameras.depth if self.camera == "depth" else cameras.picture

    def run(self, seconds, least=2):
        """Drives for this time; one rate, agent-steps a second."""
        spent, cpu_spent, steps = 0.0, 0.0, 0
        while spent < seconds or steps < least:
            actions = follow_the_gap(self.observations)
            start, cpu_start = time.perf_counter(), time.process_time()
            self.observations, _, _, _, infos = self.env.step(actions)
            self.look()
            spent, cpu_spent = spent + time.perf_counter() - start, cpu_spent + time.process_time() - cpu_start
            steps += 1
            self.metres += infos["progress"].sum()
            self.collisions += int(infos["collided"].sum())
        self.driven_s += steps * self.env.num_envs * self.env.task.step_s
        self.rates.append(steps * self.env.num_envs / spent)
        self.cpu_us.append(1e6 * cpu_spent / (steps * self.env.num_envs))

    def row(self):
        """What was measured."""
        rate, cpu_us = float(np.median(self.rates)), float(np.median(self.cpu_us))
        return {"engine": self.engine, "threads": self.threads, "cars": self.cars, "worlds": self.worlds,
                "camera": self.camera,
                "agent_steps_per_s": rate, "cpu_us_per_agent_step": cpu_us,
                "spread": float(np.ptp(self.cpu_us) / cpu_us),
                "real_time_factor_of_one_core": self.env.task.step_s / (self.env.num_envs * cpu_us * 1e-6),
                "mean_speed_m_s": self.metres / self.driven_s, "collisions": self.collisions}


HEADER = ("| worlds x cars | camera | engine | threads | us of CPU | spread | agent-steps a CPU-second | times real time, one core | "
          "agent-steps/s | m/s | collisions |\n" + "|---" * 11 + "|")


def line_of(row):
    """A row of the table."""
    return (f"| {row['worlds']} x {row['cars']} | {row['camera'] or '-'} | {row['engine']} | {row['threads']} | {row['cpu_us_per_agent_step']:.0f} | "
            f"{100 * row['spread']:.0f} % | {1e6 / row['cpu_us_per_agent_step']:.0f} | "
            f"{row['real_time_factor_of_one_core']:.3g} | {row['agent_steps_per_s']:.0f} | {row['mean_speed_m_s']:.2f} | "
            f"{row['collisions']} |")


def measure(cars, worlds, camera, given):
    """Rows of all engines at one size, which take turns."""
    engines = ("RoBOSS",) if camera == "colours" else ("RoBOSS", "MuJoCo")
    entries = [Entry(engine, threads, cars, worlds, camera) for engine in engines for threads in given.threads]
    for _ in range(given.rounds):
        for entry in entries:
            entry.run(given.seconds)
    return [entry.row() for entry in entries]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=2, help="of each engine in a round")
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--only", type=int, help="only the sizes with this number of agents")
    parser.add_argument("--json", type=Path)
    given = parser.parse_args()
    about = {"commit": os.environ.get("ROBOSS_COMMIT", "unknown"), "cpu": cpu(), "python": platform.python_version(),
             "roboss": roboss.__version__, "mujoco": mujoco.__version__}
    print(" ".join(f"{name}={value}" for name, value in about.items()))
    print(HEADER)
    rows = []
    for cars, worlds, camera in SIZES:
        if given.only in (None, cars * worlds):
            for row in measure(cars, worlds, camera, given):
                rows.append({**about, **row})
                print(line_of(row), flush=True)
    if given.json:
        given.json.write_text(json.dumps(rows, indent=1) + "\n")


def cpu():
    """Name of the processor."""
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.processor()


if __name__ == "__main__":
    main()
