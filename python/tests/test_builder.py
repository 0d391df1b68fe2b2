"""WorldBuilder: what it builds against closed forms and files, and what it refuses."""
import subprocess
import sys
import xml.etree.ElementTree as ET

import numpy as np
import pytest

import roboss
from conftest import REPOSITORY
from roboss import shapes


def inside(kind, points, radius, length):
    """Whether points are in the shape."""
    across, z = np.hypot(points[:, 0], points[:, 1]), np.abs(points[:, 2])
    if kind == "cylinder":
        return (across <= radius) & (z <= length / 2)
    return np.hypot(across, np.maximum(z - length / 2, 0)) <= radius


@pytest.mark.parametrize("kind", ["cylinder", "capsule"])
def test_moments_of_inertia_are_those_of_the_volume(kind):
    radius, length = 0.3, 0.8
    grid = [np.linspace(-reach, reach, count) for reach, count in ((radius, 81), (radius, 81), (length / 2 + radius, 241))]
    points = np.stack(np.meshgrid(*grid, indexing="ij"), axis=-1).reshape(-1, 3)
    x, y, z = points[inside(kind, points, radius, length)].T
    counted = [(y**2 + z**2).mean(), (x**2 + z**2).mean(), (x**2 + y**2).mean()]
    assert getattr(shapes, kind)(radius, length).inertia == pytest.approx(counted, rel=0.02)


def test_moments_of_a_short_capsule_and_a_box_of_equal_edges_are_those_known():
    assert shapes.capsule(0.5, 1e-9).inertia == pytest.approx(shapes.sphere(0.5).inertia)
    assert shapes.box([2, 2, 2]).inertia == pytest.approx((2 / 3,) * 3)


@pytest.mark.parametrize("angle", [0.1, 1.0])
def test_a_pendulum_swings_with_the_period_of_theory(angle):
    builder = roboss.WorldBuilder(dt=0.001)
    pendulum = builder.model("pendulum", pose=[0, 0, 3])
    pendulum.box("bar", [0.1, 0.1, 1], mass=2, pose=[0, 0, -0.5])
    pendulum.joint("pivot", "revolute", "world", "bar", axis=[0, 1, 0], at=[0, 0, 0.5])
    sim = roboss.Simulation(builder.build(accuracy="high"))
    bar = sim.robots("pendulum")
    bar.joint_position = angle
    signs = []
    for _ in range(4000):
        sim.step()
        signs.append(np.sign(bar.joint_position[0, 0]))
    turns = np.flatnonzero(np.diff(signs) < 0)
    moment = 2 * (0.1**2 + 1**2) / 12 + 2 * 0.5**2
    means = [1.0, np.cos(angle / 2)]  # the arithmetic-geometric mean gives the period at any angle
    for _ in range(6):
        means = [np.mean(means), np.sqrt(np.prod(means))]
    period = 2 * np.pi * np.sqrt(moment / (2 * 9.8 * 0.5)) / means[0]
    assert (turns[-1] - turns[0]) * sim.dt / (len(turns) - 1) == pytest.approx(period, abs=0.002)


def mixed_world():
    builder = roboss.WorldBuilder("mixed", dt=0.004, gravity=[0, 0, -1.62])
    builder.ground(friction=0.7)
    builder.box("wall", [0.2, 4, 1], pose=[2, 0, 0.5], color=[0.5, 0.5, 0.5])
    builder.sphere("ball", 0.2, mass=1, pose=[0, 0, 3], restitution=0.6, color=[1, 0, 0, 0.5])
    builder.cylinder("drum", 0.3, 0.6, mass=4, pose=[1, 1, 0.5])
    builder.capsule("pill", 0.1, 0.4, mass=1, pose=[0, 1, 1, 0, 0.6, 0, 0.8])
    builder.add("rover", REPOSITORY / "examples/first_robot/rover.urdf", pose=[-2, 0, 0.2])
    builder.add("car", roboss.example("models/car/model.sdf"), pose=[-4, 0, 0])
    builder.light("sun")
    return builder


def test_poses_names_and_settings_are_those_given():
    world = mixed_world().build()
    sim = roboss.Simulation(world)
    assert world.name == "mixed" and world.dt == 0.004 and world.gravity == pytest.approx((0, 0, -1.62))
    assert world.robots == ("ball", "drum", "pill", "rover", "car")
    assert world.scenery == ("ground::link::collision", "wall::link::collision")
    assert sim.robots("pill").pose[0] == pytest.approx([0, 1, 1, 0, 0.6, 0, 0.8], abs=1e-12)
    assert sim.robots("rover").joints and sim.robots("car").sensors


def test_the_saved_file_is_the_same_world_for_the_command(tmp_path):
    builder = mixed_world()
    file = tmp_path / "mixed.sdf"
    builder.save(file)
    assert roboss.load(file).hash == builder.build().hash
    done = subprocess.run([sys.executable, "-P", "-m", "roboss", "check", file], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_restitution_and_gravity_act():
    sim = roboss.Simulation(mixed_world().build())
    ball = sim.robots("ball")
    heights = []
    for _ in range(1500):
        sim.step()
        heights.append(ball.pose[0, 2] - 0.2)
    lowest = int(np.argmin(heights[:600]))
    assert lowest * sim.dt == pytest.approx(np.sqrt(2 * 2.8 / 1.62), abs=0.02)
    assert max(heights[lowest:]) == pytest.approx(0.36 * 2.8, rel=0.05)


def test_colours_reach_the_page():
    scene = ET.fromstring(mixed_world().to_sdf())
    assert [float(x) for x in scene.findtext(".//model[@name='ball']//diffuse").split()] == [1, 0, 0, 0.5]


WRONG = {
    "a name that is taken": (lambda b: b.sphere("box", 1), "name-taken"),
    "a name with colons": (lambda b: b.sphere("a::b", 1), "bad-name"),
    "no name": (lambda b: b.sphere("", 1), "bad-name"),
    "a radius of 0": (lambda b: b.sphere("x", 0), ""),
    "an edge that is negative": (lambda b: b.box("x", [1, -1, 1]), ""),
    "two edges": (lambda b: b.box("x", [1, 1]), "bad-shape"),
    "edges that are text": (lambda b: b.box("x", "abc"), "bad-shape"),
    "a mass of 0": (lambda b: b.sphere("x", 1, mass=0), ""),
    "a pose of 6 numbers": (lambda b: b.sphere("x", 1, pose=[0] * 6), "bad-pose"),
    "a pose that is not finite": (lambda b: b.sphere("x", 1, pose=[0, 0, np.nan]), "bad-pose"),
    "a quaternion of length 0": (lambda b: b.sphere("x", 1, pose=[0] * 7), "bad-pose"),
    "a color above 1": (lambda b: b.sphere("x", 1, color=[255, 0, 0]), "bad-color"),
    "a negative friction": (lambda b: b.sphere("x", 1, friction=-1), "bad-value"),
    "a restitution above 1": (lambda b: b.sphere("x", 1, restitution=2), ""),
    "a property that is not there": (lambda b: b.sphere("x", 1, colour=[1, 0, 0]), "unknown-name"),
    "a file that is not there": (lambda b: b.add("x", "no_such.urdf"), "no-file"),
    "a light that is not there": (lambda b: b.light("x", "laser"), "unknown-name"),
    "a link without mass": (lambda b: b.model("x").sphere("a", 1), ""),
    "a link called world": (lambda b: b.model("x").sphere("world", 1, mass=1), "name-taken"),
    "a joint to nobody": (lambda b: arm(b).joint("j", "revolute", "upper", "hand"), "unknown-name"),
    "a joint that is not there": (lambda b: arm(b).joint("j", "hinge", "upper", "lower"), "unknown-name"),
    "a joint of a link with itself": (lambda b: arm(b).joint("j", "revolute", "upper", "upper"), ""),
    "the world as a child": (lambda b: arm(b).joint("j", "revolute", "upper", "world"), "unknown-name"),
    "limits that cross": (lambda b: arm(b).joint("j", "revolute", "upper", "lower", lower=1, upper=0), ""),
    "an axis of length 0": (lambda b: arm(b).joint("j", "revolute", "upper", "lower", axis=[0, 0, 0]), "bad-shape"),
    "an axis of a ball joint": (lambda b: arm(b).joint("j", "ball", "upper", "lower", axis=[0, 0, 1]), ""),
    "a second joint of this name": (lambda b: arm(b).joint("j", "ball", "upper", "lower").joint("j", "ball", "world", "upper"),
                                    "name-taken"),
}


def arm(builder):
    return builder.model("arm").sphere("upper", 0.1, mass=1).sphere("lower", 0.1, mass=1, pose=[0, 0, -1])


@pytest.mark.parametrize("wrong", WRONG)
def test_refuses(wrong):
    builder = roboss.WorldBuilder()
    builder.box("box", [1, 1, 1], mass=1)
    add, code = WRONG[wrong]
    with pytest.raises(roboss.RobossError) as refused:
        add(builder)
    assert refused.value.code == code and str(refused.value)


def test_a_refused_shape_leaves_nothing_behind():
    builder = roboss.WorldBuilder()
    before = builder.to_sdf()
    with pytest.raises(roboss.ArgumentError):
        builder.sphere("x", 1, mass=-1)
    assert builder.to_sdf() == before and builder.sphere("x", 1, mass=1).links == ("link",)


def test_what_a_file_says_wrong_is_said_by_build(tmp_path):
    broken = tmp_path / "broken.urdf"
    broken.write_text("<robot name='r'><link")
    builder = roboss.WorldBuilder()
    builder.add("r", broken)
    with pytest.raises(roboss.WorldError, match="broken.urdf"):
        builder.build(strict=True)
