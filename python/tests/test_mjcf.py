"""MJCF files against MuJoCo, and on bad input."""
import numpy as np
import pytest

import roboss
from conftest import REPOSITORY

mujoco = pytest.importorskip("mujoco")
from mujoco_pair import MujocoPair  # noqa: E402

FILES = sorted((REPOSITORY / "tests" / "mjcf").glob("*.xml"))
BALL = '<geom size="0.1"/>'


def mjcf(body, rest=""):
    return f"<mujoco>{rest}<worldbody>{body}</worldbody></mujoco>"


def test_there_are_files():
    assert len(FILES) >= 12


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_accelerations_are_those_of_mujoco(path):
    pair = MujocoPair(path)
    mine, theirs = pair.columns
    assert mine == theirs
    worst = pair.compare()
    assert worst["pose"] < 1e-12 and worst["round trip"] < 1e-12, worst
    assert worst["acceleration"] < 1e-9, worst


@pytest.mark.parametrize("name", ["cart_pole", "arm", "quadruped", "hopper", "pendulum"])
def test_actuators_push_as_those_of_mujoco(name):
    pair = MujocoPair(REPOSITORY / "tests" / "mjcf" / f"{name}.xml")
    for seed in range(3):
        mine, theirs = pair.step_with_actuators(pair.robots[0], seed)
        assert np.abs(mine - theirs).max() < 1e-3 * max(1, np.abs(theirs).max()), (mine, theirs)


def test_robots_take_and_give_qpos_and_qvel():
    sim = roboss.Simulation(str(REPOSITORY / "tests" / "mjcf" / "ball_chain.xml"), threads=1)
    robots = sim.robots("*")
    order = roboss.MujocoOrder(robots)
    assert (order.nq, order.nv) == (13, 10)
    assert robots.qpos.tolist() == [[1, 0, 0, 0] * 3 + [0]]
    random = np.random.default_rng(5)
    qpos, qvel = random.normal(size=13), random.normal(size=10)
    for at in (0, 4, 8):
        qpos[at:at + 4] /= np.linalg.norm(qpos[at:at + 4]) * np.sign(qpos[at])
    robots.qpos, robots.qvel = qpos, qvel
    assert np.allclose(robots.qpos, qpos, rtol=0, atol=1e-14)
    assert np.allclose(robots.qvel, qvel, rtol=0, atol=1e-13)


def test_a_world_is_its_robots_one_behind_the_other():
    path = REPOSITORY / "tests" / "mjcf" / "includes.xml"
    model = mujoco.MjModel.from_xml_path(str(path))
    sim = roboss.Simulation(str(path), threads=1)
    qpos = np.concatenate([sim.robots([name]).qpos[0] for name in sim.world.robots])
    assert np.allclose(qpos, model.qpos0, rtol=0, atol=1e-14)


def test_falls_and_turns_as_in_mujoco():
    body = '<body name="b" pos="0 0 9"><freejoint/><geom type="box" size=".1 .2 .3"/></body>'
    text = mjcf(body, '<option timestep="0.001" integrator="RK4"/>')
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    sim = roboss.Simulation(text, threads=1)
    box = sim.robots("b")
    data.qvel[:] = box.qvel = [1, 2, 3, 4, 5, 6]
    mujoco.mj_step(model, data, 500)
    sim.step(500)
    mine = box.qpos[0]
    mine[3:] *= np.sign(mine[3:] @ data.qpos[3:])  # q and -q are the same rotation
    assert np.allclose(mine, data.qpos, rtol=0, atol=1e-7)
    assert np.allclose(box.qvel[0], data.qvel, rtol=0, atol=1e-7)


def test_a_position_servo_rests_where_that_of_mujoco_does():
    text = mjcf('<body name="b"><joint name="j" axis="0 1 0"/><geom pos=".5 0 0" size=".1" mass="2"/></body>',
                '<option timestep="0.002"/><actuator><position joint="j" kp="8" kv="3" gear="2"/></actuator>')
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    data.ctrl[0] = 2 * 0.3  # gear times the angle
    mujoco.mj_step(model, data, 20000)
    sim = roboss.Simulation(text, threads=1)
    sim.robots("b").set_joint_targets(0.3, "j", mode="position")
    sim.step(20000)
    assert abs(data.qpos[0] - 0.3) > 0.1  # the load pulls it down
    assert abs(sim.robots("b").qpos[0, 0] - data.qpos[0]) < 1e-6


def test_joined_bars_keep_together():
    bars = ('<body name="a"><joint name="u" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0 0 -1" size=".02"/>'
            '<body name="b" pos="0 0 -1"><joint name="v" axis="0 1 0"/>'
            '<geom type="capsule" fromto="0 0 0 1 0 0" size=".02"/></body></body>'
            '<body name="c" pos="1 0 0"><joint name="w" axis="0 1 0"/>'
            '<geom type="capsule" fromto="0 0 0 0 0 -1" size=".02"/></body>')
    text = mjcf(bars, '<option timestep="0.001"/><equality><connect body1="b" body2="c" anchor="1 0 0"/></equality>')
    sim = roboss.Simulation(text, threads=1)
    assert sim.world.robots == ("a",)
    robots = sim.robots("a")
    robots.apply_wrench([3, 0, 0, 0, 0, 0], "b", ticks=300)
    sim.step(2000)
    assert np.ptp(robots.joint_velocity) > 0.1
    places = {link: robots.link_pose(link)[0] for link in ("b", "c")}

    def point(pose, offset):
        return pose[:3] + _rotated(pose[3:], offset)
    assert np.allclose(point(places["b"], [1, 0, 0]), point(places["c"], [0, 0, -1]), rtol=0, atol=1e-4)
    with pytest.raises(roboss.ArgumentError) as error:
        robots.qpos = [0, 0, 0]
    assert error.value.code == "closed-loop"


def _rotated(quaternion, vector):
    u, w = quaternion[:3], quaternion[3]
    t = 2 * np.cross(u, vector)
    return vector + w * t + np.cross(u, t)


@pytest.mark.parametrize("text, code, line", [
    (mjcf('\n<body><freejoint/><geom size="wide"/></body>'), "bad-value", 2),
    (mjcf('\n\n<body><geom class="x" size="1"/></body>'), "unknown-class", 3),
    (mjcf("\n<body><joint/></body>", '<equality><weld body1="x"/></equality>'), "unknown-body", 1),
])
def test_bad_files_are_refused_with_their_line(text, code, line):
    with pytest.raises(roboss.WorldError) as error:
        roboss.load(text)
    found = [finding for finding in error.value.diagnostics if finding.code == code]
    assert found and found[0].line == line and found[0].remedy


def test_what_has_no_effect_is_a_warning_with_its_line():
    text = mjcf('<body name="b"><joint name="j"/><geom size=".1"/></body>',
                '\n<tendon><fixed><joint joint="j" coef="1"/></fixed></tendon>')
    with pytest.warns(roboss.WorldWarning, match=":2: .*tendon"):
        roboss.load(text)


def test_order_refuses_wrong_shapes():
    order = roboss.MujocoOrder(roboss.RobotModel(mjcf(f'<body><freejoint/>{BALL}</body>')))
    assert order.q(np.tile([0, 0, 0, 2, 0, 0, 0], (4, 5, 1))).shape == (4, 5, 7)
    with pytest.raises(roboss.ArgumentError):
        order.q([0, 0, 0])
    with pytest.raises(roboss.ArgumentError):
        order.q(np.zeros(7))  # a quaternion of length 0


def test_a_robot_that_stands_in_mujoco_stands():
    path = str(REPOSITORY / "tests" / "mjcf" / "quadruped.xml")
    model = mujoco.MjModel.from_xml_path(path)
    data = mujoco.MjData(model)
    sim = roboss.Simulation(path, threads=1)
    trunk = sim.robots("trunk")
    data.qpos[:] = trunk.qpos = model.key("home").qpos
    trunk.set_joint_targets(0.0, mode="position")
    mujoco.mj_step(model, data, 2000)
    sim.step(2000)
    assert 0.38 < data.qpos[2] < 0.42
    assert abs(trunk.qpos[0, 2] - data.qpos[2]) < 0.01  # contacts are soft there, rigid here
    assert np.abs(trunk.qvel).max() < 0.01


def test_copies_are_of_one_type():
    post = '<body name="post"><joint name="j" axis="0 1 0"/><geom size=".1" pos="0 0 1"/><body pos="0 0 1"><joint/><geom size=".1"/></body></body>'
    sim = roboss.Simulation(mjcf(f'<replicate count="12" offset="1 0 0">{post}</replicate>'), threads=1)
    posts = sim.robots("post*")
    assert posts.names == tuple(f"post{k:02}" for k in range(12)) and posts.joints == ("j", "body_1_joint")
    posts.qpos = np.arange(24.0).reshape(12, 2) / 24
    assert posts.qpos.shape == (12, 2) and posts[3].qpos[0, 1] == 7 / 24
