"""Quaternions are x y z w at the edge of the package, and its texts say so; those of MuJoCo are w x y z."""
import inspect
import re

import numpy as np
import pytest

import roboss
import roboss.analysis
from roboss import envs

HALF = np.sqrt(0.5)
TURN = [0, 0, HALF, HALF]  # 90 degrees about z, x y z w
BALL = """<mujoco><worldbody><body name="top"><freejoint/><geom type="box" size=".1 .2 .3"/></body></worldbody></mujoco>"""


def described():
    for module in (roboss, envs, roboss.analysis):
        for name in module.__all__:
            thing = getattr(module, name)
            yield name, inspect.getdoc(thing) or ""
            for member, value in vars(thing).items() if isinstance(thing, type) else []:
                if not member.startswith("_"):
                    yield f"{name}.{member}", inspect.getdoc(value) or ""


def test_every_text_that_has_a_quaternion_names_its_order():
    seen = 0
    for name, text in described():
        if re.search(r"quaternion\b", text):  # one that is given or returned
            seen += 1
            assert any(order in text for order in ("x y z w", "w x y z", "_quat_xyzw")), name
    assert seen >= 10


def test_all_ways_in_and_out_have_one_order():
    world = roboss.load(BALL)
    sim = roboss.Simulation(world)
    top = sim.robots("top")
    top.pose = [0, 0, 1, *TURN]
    assert top.pose[0, 3:] == pytest.approx(TURN) and top.link_pose(top.links[0])[0, 3:] == pytest.approx(TURN)
    assert top.qpos[0, 3:] == pytest.approx([HALF, 0, 0, HALF])
    model = roboss.RobotModel(world)
    q = model.configuration(top)
    assert model.link_pose(q, model.links[0])[0, 3:] == pytest.approx(TURN)
    assert roboss.MujocoOrder(model).qpos(q)[0, 3:] == pytest.approx([HALF, 0, 0, HALF])
    came = sim.spawn(world, "other", pose=[3, 0, 1, *TURN])
    assert came.pose[0, 3:] == pytest.approx(TURN)
    assert roboss.ctraj([0, 0, 0, 0, 0, 0, 1], [0, 0, 0, *TURN], [0, 1]).pose[-1, 3:] == pytest.approx(TURN)


def test_built_worlds_have_the_same_order():
    world = roboss.WorldBuilder()
    world.box("crate", [1, 2, 3], mass=1, pose=[0, 0, 2, *TURN])
    assert roboss.Simulation(world.build()).robots("crate").pose[0, 3:] == pytest.approx(TURN)


def test_orientations_of_sensors_have_the_same_order():
    cars = roboss.Simulation(roboss.example("city.sdf")).robots("car_0")
    cars.pose = [*cars.pose[0, :3], *TURN]
    reading = cars["compass"].read_all()["orientation_quat_xyzw"][0]
    assert abs(reading @ TURN) == pytest.approx(1, abs=0.01)
