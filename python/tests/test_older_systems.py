"""The examples of docs/older-systems.md: a crowd that does not touch, and the longest latency of a control loop."""
import importlib.util
from pathlib import Path

import numpy as np
import pytest

import roboss

EXAMPLES = Path(__file__).parents[2] / "examples" / "older_systems"


def example(name):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_a_crowd_wanders_without_touching_and_with_the_same_bits_for_any_threads():
    crowd, hashes = example("crowd"), set()
    world = crowd.crowd_world(16)
    for threads in (1, 2):
        sim = roboss.Simulation(world, threads=threads)
        robots = sim.robots("robot_*")
        start, touched = robots.pose[:, :2].copy(), np.zeros(16, bool)
        for _ in range(100):
            crowd.step(sim, robots)
            touched |= robots.touching
        assert not touched.any()
        assert np.linalg.norm(robots.pose[:, :2] - start, axis=1).mean() > 1.0
        hashes.add(sim.state_hash)
    assert len(hashes) == 1


def test_sonars_look_outwards():
    world = roboss.WorldBuilder("sonars")
    world.ground()
    world.add("robot", EXAMPLES / "wanderer.sdf")
    world.box("wall", [0.1, 4, 1], pose=[1.25, 0, 0.5])   # its face is 1.2 m in front of the robot's middle
    robot = roboss.Simulation(world.build()).robots("robot")
    heard = np.array([float(robot[f"sonar_{i}"].read().squeeze()) for i in range(8)])
    assert np.isinf(heard[[0, 7]]).all()
    ahead = 1.2 - 0.2 * np.cos(np.radians(10))
    edge = np.arctan(0.4 / 3)                              # half the angle of the cone, which is 10 degrees off
    assert heard[3:5] == pytest.approx(ahead / np.cos(max(0.0, np.radians(10) - edge)), rel=0.01)
    assert heard[3] == pytest.approx(heard[4], rel=1e-6)


@pytest.mark.parametrize("kp, kd", [(40.0, 8.0), (20.0, 3.0)])
def test_a_loop_tolerates_the_latency_that_its_characteristic_equation_says(kp, kd):
    latency = example("latency")
    limit = 1000 * latency.delay_limit(kp, kd)          # ms, which are ticks
    angles = latency.balance(kp, kd, [round(0.96 * limit), round(1.04 * limit)])
    assert angles[0] < 0.01 / 2 < 0.02 < angles[1]
