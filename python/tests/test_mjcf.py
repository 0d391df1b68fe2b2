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


CURVE = [0.05, 0.4, -0.3, 0.25, 0.1]  # follower = polynomial of the leader


def curved(dt, flags=""):
    """A pendulum that moves a slider along a curve."""
    bodies = ('<body name="a"><joint name="lead" axis="0 1 0"/><geom size=".05" pos="0 0 -.5" mass="2"/></body>'
              '<body name="b" pos="0 1 0"><joint name="follow" type="slide" axis="1 0 0"/><geom size=".1" mass="3"/></body>')
    coefficients = " ".join(map(str, CURVE))
    return mjcf(bodies, f'<option timestep="{dt}"/><equality><joint joint1="follow" joint2="lead" {flags} '
                        f'polycoef="{coefficients}"/></equality>')


def curved_exactly(angle, seconds):
    """The leader after that time, from rest: Lagrange's equation by Runge-Kutta steps of fourth order."""
    poly = np.polynomial.Polynomial(CURVE)
    slope, bend = poly.deriv(), poly.deriv(2)
    inertia, weight = 2 * (0.5**2 + 0.4 * 0.05**2), 2 * 9.81 * 0.5

    def rate(y):
        q, v = y
        return np.array([v, -(weight * np.sin(q) + 3 * slope(q) * bend(q) * v * v) / (inertia + 3 * slope(q)**2)])

    y, h = np.array([angle, 0.0]), 1e-4
    for _ in range(round(seconds / h)):
        a = rate(y)
        b = rate(y + h / 2 * a)
        c = rate(y + h / 2 * b)
        y = y + h / 6 * (a + 2 * b + 2 * c + rate(y + h * c))
    return y[0]


def test_a_curved_equality_moves_as_in_mujoco():
    start = np.array([0.9, np.polynomial.Polynomial(CURVE)(0.9)])
    model = mujoco.MjModel.from_xml_string(curved(2e-4, 'solref="0.0005 1" solimp=".9999 .9999 .001"'))
    data = mujoco.MjData(model)
    data.qpos[:] = start
    sim = roboss.Simulation(curved(5e-4), threads=1)
    assert sim.world.robots == ("a",)
    robot = sim.robots("a")
    robot.qpos = start
    for tenth in range(1, 16):
        mujoco.mj_step(model, data, 500)
        sim.step(200)
        mine = robot.qpos[0]
        assert abs(mine[1] - np.polynomial.Polynomial(CURVE)(mine[0])) < 1e-6
        assert abs(mine[0] - curved_exactly(0.9, tenth / 10)) < 2e-3
        assert np.abs(mine - data.qpos).max() < 3e-3, (tenth, mine, data.qpos)


KEYED = """<mujoco><compiler angle="radian"/><worldbody><geom type="plane" size="5 5 .1"/>
  <body name="hand" mocap="true" pos="3 0 1"><geom size=".05" contype="0" conaffinity="0"/></body>
  <body name="dog" pos="0 0 1" euler="0 0 .5"><freejoint/><geom type="box" size=".3 .2 .1"/>
    <body name="leg" pos=".2 0 0"><joint name="hip" axis="0 1 0" ref=".2"/><geom type="capsule" fromto="0 0 0 0 0 -.3" size=".03"/>
      <body name="foot" pos="0 0 -.3"><joint name="ankle" type="ball" pos="0 0 .02"/><geom size=".05" pos=".05 0 0"/></body></body></body>
  <replicate count="2" offset="0 1 0"><body name="post" pos="1 0 0"><joint name="turn"/><geom size=".1" pos="0 0 1"/></body></replicate>
  </worldbody>
  <keyframe><key name="lie" qpos="{q0}"/><key name="jump" qpos="{q}" qvel="{v}" mpos="1 2 3" mquat="0 1 0 0"/></keyframe></mujoco>"""


def keyed():
    random = np.random.default_rng(7)
    q, v = random.uniform(-1, 1, 14), random.uniform(-1, 1, 12)
    q[2] = 2
    for at in (3, 8):
        q[at:at + 4] /= np.linalg.norm(q[at:at + 4])
    text = KEYED.format(q0=" ".join(map(str, [*q[:13], 0.25])), q=" ".join(map(repr, map(float, q))),
                        v=" ".join(map(repr, map(float, v))))
    return text, q, v


@pytest.mark.parametrize("name", ["jump", "1"])
def test_a_world_starts_at_a_keyframe_as_mujoco_does(name):
    text, q, v = keyed()
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 1)
    mujoco.mj_forward(model, data)
    sim = roboss.Simulation(roboss.load(text, keyframe=name), threads=1)
    mine_q = np.concatenate([sim.robots([robot]).qpos[0] for robot in ("dog", "post0", "post1")])
    mine_v = np.concatenate([sim.robots([robot]).qvel[0] for robot in ("dog", "post0", "post1")])
    for at in (3, 8):
        mine_q[at:at + 4] *= np.sign(mine_q[at:at + 4] @ q[at:at + 4])
    assert np.allclose(mine_q, q, rtol=0, atol=1e-12)
    assert np.allclose(mine_v, v, rtol=0, atol=1e-9)
    for link in ("dog", "leg", "foot"):
        assert np.allclose(sim.robots("dog").link_pose(link)[0, :3], data.body(link).xpos, rtol=0, atol=1e-12)
    assert np.allclose(sim.robots("hand").pose[0, :3], data.body("hand").xpos, rtol=0, atol=1e-12)


def test_a_world_starts_where_bodies_stand_and_names_its_keyframes():
    text, _, _ = keyed()
    world = roboss.load(text)
    sim = roboss.Simulation(world, threads=1)
    assert np.allclose(sim.robots("dog").qpos[0, :3], [0, 0, 1]) and abs(sim.robots("dog").qpos[0, 7] - 0.2) < 1e-12
    notes = [finding.message for finding in world.diagnostics if finding.code == "keyframe"]
    assert len(notes) == 1 and "lie, jump" in notes[0]


@pytest.mark.parametrize("text, keyframe, code, hint", [
    (keyed()[0], "leap", "no-keyframe", "lie, jump"),
    (keyed()[0], "2", "no-keyframe", "lie, jump"),
    (mjcf(f"<body>{BALL}</body>"), "0", "no-keyframe", "none"),
    (mjcf(f"<body><joint/>{BALL}</body>", '<keyframe><key qpos="1 2"/></keyframe>'), "0", "bad-value", ""),
    ('<sdf version="1.9"><model name="m"><link name="l"/></model></sdf>', "home", "no-keyframe", "state"),
])
def test_unknown_keyframes_are_refused(text, keyframe, code, hint):
    with pytest.raises(roboss.WorldError) as error:
        roboss.load(text, keyframe=keyframe)
    found = [finding for finding in error.value.diagnostics if finding.code == code]
    assert found and hint in found[0].remedy


def test_copies_are_of_one_type():
    post = '<body name="post"><joint name="j" axis="0 1 0"/><geom size=".1" pos="0 0 1"/><body pos="0 0 1"><joint/><geom size=".1"/></body></body>'
    sim = roboss.Simulation(mjcf(f'<replicate count="12" offset="1 0 0">{post}</replicate>'), threads=1)
    posts = sim.robots("post*")
    assert posts.names == tuple(f"post{k:02}" for k in range(12)) and posts.joints == ("j", "body_1_joint")
    posts.qpos = np.arange(24.0).reshape(12, 2) / 24
    assert posts.qpos.shape == (12, 2) and posts[3].qpos[0, 1] == 7 / 24
