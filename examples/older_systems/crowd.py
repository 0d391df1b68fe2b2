#!/usr/bin/env python3
"""A crowd of robots wanders about by laser and sonar, as users of Stage know it.

    python examples/older_systems/crowd.py --robots 100 --seconds 60
    python examples/older_systems/crowd.py --view

Each robot turns to where its laser sees most room, and slows down for what its sonars hear. An on-board controller
(DiffDrive) makes wheel speeds of that, with bounded accelerations. Laser and sonars of all robots are arrays.
"""
import argparse
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from imports import needed  # noqa: E402

with needed():
    import numpy as np

    import roboss

ROBOT = Path(__file__).with_name("wanderer.sdf")
PERIOD = 0.1                                              # s, between two decisions
SPEED, TURN = 0.6, 1.2                                    # m/s, rad/s


def crowd_world(robots, seed=1):
    """A walled hall with pillars and robots at free places of a grid; 3 m x 3 m for each of them."""
    side = 3.0 * np.ceil(np.sqrt(robots)) + 2
    world = roboss.WorldBuilder("crowd", dt=0.005)
    world.ground()
    for name, x, y, size in (("east", side / 2, 0, [0.2, side, 0.6]), ("west", -side / 2, 0, [0.2, side, 0.6]),
                             ("north", 0, side / 2, [side, 0.2, 0.6]), ("south", 0, -side / 2, [side, 0.2, 0.6])):
        world.box(f"wall_{name}", size, pose=[x, y, 0.3], color=[0.55, 0.6, 0.65])
    random = np.random.default_rng(seed)
    cells = np.stack(np.meshgrid(*[np.arange(3.0 * np.ceil(np.sqrt(robots)), step=3) + 2.5 - side / 2] * 2), -1).reshape(-1, 2)
    for number, (x, y) in enumerate(random.permutation(cells)[:robots]):
        half = random.uniform(-np.pi, np.pi) / 2           # of its heading, rad
        world.add(f"robot_{number}", ROBOT, pose=[x, y, 0, 0, 0, np.sin(half), np.cos(half)])
    for number, (x, y) in enumerate(cells[::2]):
        world.cylinder(f"pillar_{number}", 0.2, 0.8, pose=[x + 1.5, y + 1.5, 0.4], color=[0.8, 0.7, 0.4])
    return world.build()


def decide(ranges, heard):
    """Forward speed (m/s) and turn rate (rad/s) of N robots from ranges (N, 181) and sonars (N, 8), m."""
    room = np.minimum(ranges, 4.0)
    room = np.lib.stride_tricks.sliding_window_view(np.pad(room, ((0, 0), (15, 15)), mode="edge"), 31, axis=1).min(axis=2)
    bearing = np.linspace(-np.pi / 2, np.pi / 2, room.shape[1])
    goal = bearing[np.argmax(room - 0.3 * np.abs(bearing), axis=1)]
    ahead = np.minimum(heard[:, 1:7].min(axis=1), room[:, 70:111].min(axis=1))
    stuck = ahead < 0.35
    forward = np.where(stuck, 0.0, SPEED * np.clip((ahead - 0.3) / 1.2, 0, 1) * np.cos(goal).clip(0.2))
    turn = np.where(stuck, TURN, np.clip(2 * goal, -TURN, TURN))
    return forward, turn


def step(sim, robots):
    """One decision of all robots, and the time until the next one."""
    heard = np.stack([robots[f"sonar_{i}"].read().reshape(-1) for i in range(8)], axis=1)
    forward, turn = decide(robots["laser"].read(), np.maximum(heard, 0))
    robots.command("cmd_vel", linear_x=forward, angular_z=turn)
    sim.step(round(PERIOD / sim.dt))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robots", type=int, default=100, help="default: 100")
    parser.add_argument("--seconds", type=float, default=60, help="simulated time")
    parser.add_argument("--view", action="store_true", help="show them on the viewer's page, in real time")
    arguments = parser.parse_args()
    if arguments.robots < 1 or not arguments.seconds > 0:
        parser.error("give one robot or more, and a time above 0")
    sim = roboss.Simulation(crowd_world(arguments.robots))
    robots = sim.robots("robot_*")
    view = sim.view() if arguments.view else None
    if view:
        print(f"{view.url} for {arguments.seconds:g} s (--seconds)")
    start, way, touched = time.perf_counter(), np.zeros(len(robots)), np.zeros(len(robots), bool)
    while sim.time < arguments.seconds:
        before = robots.pose[:, :2].copy()
        step(sim, robots)
        way += np.linalg.norm(robots.pose[:, :2] - before, axis=1)
        touched |= robots.touching
        if arguments.view:
            time.sleep(max(0.0, start + sim.time - time.perf_counter()))
    wall = time.perf_counter() - start
    if view:
        view.close()
    print(f"{len(robots)} robots, {sim.time:.0f} s in {wall:.1f} s ({sim.time / wall:.1f} times real time); "
          f"distance {way.mean():.1f} m each, {touched.sum()} touched something; state hash {sim.state_hash}")


if __name__ == "__main__":
    main()
