"""RobotModel against a second implementation, against the simulation, and on bad input; trajectories."""
import threading

import numpy as np
import pytest

import roboss
from random_robots import random_urdf
from reference_robot import ReferenceRobot

LOOP = roboss.example("four_bar.sdf")


@pytest.fixture(scope="module")
def arm():
    return roboss.RobotModel(roboss.example("arm.sdf"), "arm")


def same_pose(a, b, tolerance):
    sign = np.where(np.sum(a[..., 3:] * b[..., 3:], axis=-1) < 0, -1, 1)[..., None]
    assert np.allclose(a[..., :3], b[..., :3], rtol=0, atol=tolerance)
    assert np.allclose(a[..., 3:] * sign, b[..., 3:], rtol=0, atol=tolerance)


@pytest.mark.parametrize("seed", range(10))
def test_agrees_with_a_second_implementation_on_random_trees(seed):
    text = random_urdf(seed)
    world = roboss.load(text, fixed_base=[f"random_{seed}"])
    robot, reference = roboss.RobotModel(world), ReferenceRobot(text, world.gravity)
    order = [reference.moving.index(name) for name in robot.joints]
    random = np.random.default_rng(seed)
    q, v, a = random.uniform(-1.5, 1.5, (3, len(order)))
    mine = np.empty(len(order))
    mine[np.argsort(order)] = np.arange(len(order))  # their columns in mine
    columns = np.argsort(order)
    M, g = reference.mass_and_gravity(q[columns])
    assert np.allclose(robot.mass_matrix(q)[np.ix_(columns, columns)], M, rtol=0, atol=1e-11)
    assert np.allclose(robot.gravity_forces(q)[columns], g, rtol=0, atol=1e-11)
    C = reference.coriolis_matrix(q[columns], v[columns])
    assert np.allclose(robot.coriolis_matrix(q, v)[np.ix_(columns, columns)], C, rtol=0, atol=1e-6)
    forces = robot.inverse_dynamics(q, v, a)[columns]
    assert np.allclose(forces, M @ a[columns] + C @ v[columns] + g, rtol=0, atol=1e-6)
    places, paths = reference.place(q[columns])
    for link in robot.links:
        R, p = places[link]
        assert np.allclose(robot.link_pose(q, link)[:3], p, rtol=0, atol=1e-12)
        J = reference.jacobian(paths[link], p)
        assert np.allclose(robot.jacobian(q, link)[:, columns], J, rtol=0, atol=1e-12)
        in_link = np.vstack([R.T @ J[:3], R.T @ J[3:]])
        assert np.allclose(robot.jacobian(q, link, axes="tool")[:, columns], in_link, rtol=0, atol=1e-12)


def test_takes_the_states_of_a_simulation():
    sim = roboss.Simulation(roboss.example("crossroads.sdf"), threads=1)
    cars = sim.robots("car_*")
    cars.set_joint_targets(5 + np.arange(16.0)[:, None])
    sim.step(300)
    car = roboss.RobotModel(sim.world, "car_0")
    assert car.free_base and car.joints == cars.joints and (car.q_columns, car.v_columns) == (11, 10)
    q, v = car.configuration(cars), car.velocity(cars)
    assert np.array_equal(q[:, :7], cars.pose) and np.array_equal(v[:, 6:], cars.joint_velocity)
    for link in car.links:
        same_pose(car.link_pose(q, link), cars.link_pose(link), 1e-12)
        assert np.allclose(car.link_twist(q, v, link), cars.link_twist(link), rtol=0, atol=1e-11)
        assert np.allclose(np.einsum("nij,nj->ni", car.jacobian(q, link), v), cars.link_twist(link), rtol=0, atol=1e-11)
    assert np.array_equal(car.link_poses(q)[:, 0], car.link_pose(q, car.links[0]))


def test_forces_give_the_accelerations_in_the_simulation():
    dt = 1e-6
    sim = roboss.Simulation(roboss.load(roboss.example("arm.sdf"), dt=dt), threads=1)
    robots, arm = sim.robots("arm"), roboss.RobotModel(sim.world, "arm")
    q, v, a = np.array([[0.3, 0.5, -0.7, 0.4, 0.6, -0.2], [1, -0.5, 0.8, 2, -1, 0.5], [1, 2, -3, 4, -2, 5]])
    robots.joint_position, robots.joint_velocity = q, v
    forces = arm.inverse_dynamics(q, v, a) - arm.passive_forces(q, v)
    robots.set_joint_targets(forces[None], mode="effort", max_effort=1e4)
    sim.step(1)
    assert np.allclose((robots.joint_velocity[0] - v) / dt, a, rtol=0, atol=1e-3)
    assert np.allclose(arm.forward_dynamics(q, v, forces + arm.passive_forces(q, v)), a, rtol=0, atol=1e-10)


def test_leading_axes_are_broadcast(arm):
    random = np.random.default_rng(1)
    q, v, a = random.uniform(-1, 1, (3, 4, 5, 6))
    forces = arm.inverse_dynamics(q, v, a)
    assert forces.shape == (4, 5, 6)
    assert np.array_equal(forces[2, 3], arm.inverse_dynamics(q[2, 3], v[2, 3], a[2, 3]))
    assert np.array_equal(arm.inverse_dynamics(q[0, 0], v, a[0])[3, 4], arm.inverse_dynamics(q[0, 0], v[3, 4], a[0, 4]))
    assert arm.mass_matrix(np.empty((0, 6))).shape == (0, 6, 6)
    assert arm.link_poses(q).shape == (4, 5, len(arm.links), 7)
    total = arm.coriolis_forces(q, v) + arm.gravity_forces(q) + np.einsum("...ij,...j->...i", arm.mass_matrix(q), a)
    assert np.allclose(forces, total, rtol=0, atol=1e-11)
    assert np.allclose(np.einsum("...ij,...j->...i", arm.coriolis_matrix(q, v), v), arm.coriolis_forces(q, v), atol=1e-11)


def test_inverse_kinematics_reach_targets_within_limits(arm):
    random = np.random.default_rng(2)
    q = random.uniform(*arm.joint_limits.clip(-3, 3).T, (200, 6))
    tool = [0.02, 0, 0.05, 0, 0, np.sin(0.2), np.cos(0.2)]
    found = arm.inverse_kinematics(arm.link_pose(q, "tool", tool=tool), "tool", tool=tool)
    assert found.success.all() and found.q.shape == (200, 6)
    same_pose(arm.link_pose(found.q, "tool", tool=tool), arm.link_pose(q, "tool", tool=tool), 1e-7)
    assert np.all(found.q >= arm.joint_limits[:, 0]) and np.all(found.q <= arm.joint_limits[:, 1])
    again = arm.inverse_kinematics(arm.link_pose(q[7:9], "tool", tool=tool), "tool", tool=tool)
    assert np.array_equal(again.q, found.q[7:9])


def test_inverse_kinematics_tell_what_they_could_not_reach(arm):
    found = arm.inverse_kinematics([5, 0, 0, 0, 0, 0, 1], "tool", weights=[1, 1, 1, 0, 0, 0], attempts=3)
    assert not found.success and found.attempts == 3
    assert 3.5 < found.position_error < 4 and found.orientation_error == 0
    held = arm.inverse_kinematics(arm.link_pose(np.full(6, 0.2), "tool"), "tool", joints=["yaw"], attempts=2)
    assert not held.success and np.array_equal(held.q[1:], arm.start[1:])


def test_a_path_is_followed_without_jumps(arm):
    start = arm.inverse_kinematics([0.5, -0.3, 0.7, 0, 1, 0, 0], "tool")
    line = roboss.ctraj([0.5, -0.3, 0.7, 0, 1, 0, 0], [0.5, 0.3, 0.4, 0, 1, 0, 0], np.linspace(0, 2, 201))
    found = arm.inverse_kinematics(line.pose, "tool", start=start.q, path=True)
    assert found.success.all() and np.max(np.abs(np.diff(found.q, axis=0))) < 0.05
    v = np.gradient(found.q, line.time, axis=0)[1:-1]
    twists = arm.link_twist(found.q[1:-1], v, "tool")
    assert np.allclose(twists, line.twist[1:-1], rtol=0, atol=0.02)


def test_threads_of_python_share_a_robot(arm):
    random = np.random.default_rng(3)
    q, v, a = random.uniform(-1, 1, (3, 20000, 6))
    wanted = arm.inverse_dynamics(q, v, a)
    results = [None] * 4

    def compute(number):
        results[number] = arm.inverse_dynamics(q, v, a)

    workers = [threading.Thread(target=compute, args=(number,)) for number in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert all(np.array_equal(result, wanted) for result in results)


def test_loops_are_refused_or_cut():
    world = roboss.load(LOOP)
    with pytest.raises(roboss.ArgumentError) as error:
        roboss.RobotModel(world, world.robots[0])
    assert error.value.code == "closed-loop"
    cut = roboss.RobotModel(world, world.robots[0], cut_loops=True)
    assert cut.cut_joints and not set(cut.cut_joints) & set(cut.joints)


def test_followers_are_named():
    text = random_urdf(3, kinds=["revolute"]).replace("</axis>", "").replace(
        'name="joint_2" type="revolute">', 'name="joint_2" type="revolute"><mimic joint="joint_1" multiplier="2"/>')
    robot = roboss.RobotModel(roboss.load(text, fixed_base=["random_3"]))
    assert robot.followers == (roboss.Follower("joint_2", "joint_1", 2.0, 0.0),)


def test_merged_links_of_a_urdf_are_frames():
    text = random_urdf(5, links=4, kinds=["revolute"]).replace(
        "</robot>", '<link name="flange"/><joint name="weld" type="fixed"><parent link="link_3"/><child link="flange"/>'
        '<origin xyz="0 0.1 0.2" rpy="0.3 0 0"/></joint></robot>')
    robot = roboss.RobotModel(roboss.load(text, fixed_base=["random_5"]))
    assert robot.frames == ("flange",) and "flange" not in robot.links
    q, on_link = [0.1, 0.2, 0.3], [0, 0.1, 0.2, np.sin(0.15), 0, 0, np.cos(0.15)]
    same_pose(robot.link_pose(q, "flange"), robot.link_pose(q, "link_3", tool=on_link), 1e-14)
    assert np.allclose(robot.jacobian(q, "flange", axes="tool"), robot.jacobian(q, "link_3", tool=on_link, axes="tool"))
    found = robot.inverse_kinematics(robot.link_pose(q, "flange"), "flange")
    assert found.success


def test_a_fixed_base_stands_where_it_is_put():
    arm = roboss.RobotModel(roboss.example("arm.sdf"), "arm", base_pose=[1, 2, 3, 0, 0, 1, 1])
    assert np.allclose(arm.link_pose(np.zeros(6), "tool")[:3], [1, 2, 4.45])


def test_bad_input_is_named(arm):
    def code_of(error, call):
        with pytest.raises(error) as raised:
            call()
        return raised.value.code

    argument = roboss.ArgumentError
    assert code_of(argument, lambda: arm.link_pose(np.zeros(5), "tool")) == "bad-shape"
    assert code_of(argument, lambda: arm.link_pose(0.0, "tool")) == "bad-shape"
    assert code_of(argument, lambda: arm.inverse_dynamics(np.zeros((2, 6)), np.zeros((3, 6)))) == "bad-shape"
    assert code_of(argument, lambda: arm.mass_matrix(np.full(6, np.nan))) == "not-finite"
    assert code_of(argument, lambda: arm.inverse_kinematics(np.zeros(7), "tool")) == "no-rotation"
    assert code_of(roboss.UnknownNameError, lambda: arm.link_pose(np.zeros(6), "tolo")) == "unknown-name"
    assert code_of(roboss.UnknownNameError, lambda: arm.jacobian(np.zeros(6), "tool", axes="local")) == "unknown-name"
    for options in (dict(weights=np.zeros(6)), dict(weights=[-1, 1, 1, 1, 1, 1]), dict(attempts=0), dict(tolerance=0)):
        code_of(argument, lambda: arm.inverse_kinematics([0, 0, 1, 0, 0, 0, 1], "tool", **options))
    with pytest.raises(argument):
        roboss.RobotModel(roboss.example("crossroads.sdf"))
    with pytest.raises(argument):
        roboss.RobotModel(roboss.example("crossroads.sdf"), "car_0", base_pose=[0, 0, 0, 0, 0, 0, 1])


def test_joint_trajectories_keep_their_ends():
    path = roboss.jtraj([[0, 1], [2, 3]], [[1, 1], [1, 1]], [1, 2, 4], v0=0.5, v1=[[0, 1], [2, 3]])
    assert path.q.shape == (3, 2, 2)
    assert np.allclose(path.q[[0, -1]], [[[0, 1], [2, 3]], [[1, 1], [1, 1]]])
    assert np.allclose(path.v[[0, -1]], [np.full((2, 2), 0.5), [[0, 1], [2, 3]]])
    assert np.allclose(path.a[[0, -1]], 0)
    for time in ([1], [1, 1], [2, 1], [[0, 1]], [0, np.inf]):
        with pytest.raises(roboss.ArgumentError):
            roboss.jtraj([0], [1], time)
    with pytest.raises(roboss.ArgumentError):
        roboss.ctraj([0, 0, 0, 0, 0, 0, 1], [0, 0, 0, 0, 0, 0, 1], [0, 1], ramp=0.6)
