"""Cameras: distances against closed forms, whose pixels are whose, and frames of environments."""
import gymnasium
import numpy as np
import pytest

import roboss
import roboss.envs  # registers the environments


@pytest.fixture
def still():
    builder = roboss.WorldBuilder("still", gravity=[0, 0, 0])
    builder.ground()
    builder.sphere("ball", 1.0, mass=1, pose=[0, 0, 2], color=[0.9, 0.3, 0.1])
    builder.box("cube", [1, 1, 1], mass=1, pose=[0, 4, 0.5])
    builder.box("wall", [0.2, 20, 6], pose=[6, 0, 3])
    return roboss.Simulation(builder.build())


def test_distances_are_those_of_sphere_wall_and_ground(still):
    camera = still.camera([-5, 0, 2], [0, 0, 2], size=(301, 201), fov=1.2)
    depth, robot = camera.depth(), camera.segmentation()
    assert depth[100, 150] == pytest.approx(4.0, abs=1e-12) and robot[100, 150] == 0
    slope = np.tan(0.6) * 2 / 301
    below, beside = slope * (np.arange(201) - 100), slope * (np.arange(301) - 150)
    ground = 2 / below[190] * np.sqrt(1 + below[190] ** 2 + beside[3] ** 2)
    assert depth[190, 3] == pytest.approx(ground, rel=1e-9) and robot[190, 3] == -1
    wall = 10.9 * np.sqrt(1 + below[80] ** 2 + beside[20] ** 2)
    assert depth[80, 20] == pytest.approx(wall, rel=1e-9) and robot[80, 20] == -1
    angle = np.arcsin(1 / 5)
    assert (robot[100] == 0).sum() == pytest.approx(2 * np.tan(angle) / slope, abs=2)
    assert np.isinf(depth[0, 0]) == (depth[0, 0] > 200)


def test_robots_are_named_where_they_are(still):
    camera = still.camera([-5, 4, 0.5], [0, 4, 0.5], size=(101, 101))
    assert still.world.robots[camera.segmentation()[50, 50]] == "cube"
    still.robots("cube").pose = [0, 8, 0.5, 0, 0, 0, 1]
    assert camera.segmentation()[50, 50] == -1
    camera.position, camera.target = [-5, 8, 0.5], [0, 8, 0.5]
    assert still.world.robots[camera.segmentation()[50, 50]] == "cube"


def test_pictures_show_robots_in_colour_and_shadows(still):
    picture = still.camera([-6, -3, 5], [0, 0, 1], size=(160, 120)).picture().astype(int)
    robot = still.camera([-6, -3, 5], [0, 0, 1], size=(160, 120)).segmentation()
    colourful = (picture.max(axis=2) - picture.min(axis=2)) > 40
    assert colourful[robot == 0].mean() > 0.9
    ground = picture[(robot == -1) & ~colourful].mean(axis=1)
    assert ground.min() < 0.7 * ground.max()
    assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 100


def test_cameras_on_robots_see_what_a_camera_at_that_place_sees():
    sim = roboss.Simulation(roboss.example("city.sdf"), threads=2)
    cars = sim.robots("car_*")
    cars.set_joint_targets(8.0)
    sim.step(200)
    eye, target = [0.3, 0, 0.2], [2.3, 0, 0.1]
    front = cars.camera(eye, target, size=(41, 31), fov=1.0, far=200.0)
    depth, robot, picture = front.depth(), front.segmentation(), front.picture()
    assert depth.shape == robot.shape == (50, 31, 41) and picture.shape == (50, 31, 41, 3)
    for car in (0, 17):  # upright, so that the horizon of a camera at rest is the same
        x, y, z, _, _, qz, qw = cars.pose[car]
        yaw = 2 * np.arctan2(qz, qw)
        turn = np.array([[np.cos(yaw), -np.sin(yaw), 0], [np.sin(yaw), np.cos(yaw), 0], [0, 0, 1]])
        there = sim.camera([x, y, z] + turn @ eye, [x, y, z] + turn @ target, size=(41, 31), fov=1.0)
        near = depth[car] < 5
        assert near.sum() > 100 and np.median(np.abs(depth[car][near] - there.depth()[near])) < 0.02
        assert (robot[car] == there.segmentation()).mean() > 0.97
    assert ((robot >= 0) & (robot != np.array(cars.ids)[:, None, None])).any()   # some see others


def test_cameras_of_a_batch_have_simulations_first():
    batch = roboss.Batch(roboss.example("crossroads.sdf"), 2, threads=2)
    cars = batch.robots("car_*")
    cars.set_joint_targets(np.array([0.0, 8.0])[:, None, None])
    batch.step(300)
    front = cars.camera([0.05, 0, 0], [1, 0, 0], link="chassis", size=(16, 12))
    depth = front.depth()
    assert depth.shape == (2, 16, 12, 16) and front.picture().shape == (2, 16, 12, 16, 3)
    alone = batch[1].robots("car_*").camera([0.05, 0, 0], [1, 0, 0], link="chassis", size=(16, 12))
    assert np.array_equal(depth[1], alone.depth()) and not np.array_equal(depth[0], depth[1])
    with pytest.raises(roboss.UnknownNameError):
        cars.camera([0, 0, 0], [1, 0, 0], link="mast")
    with pytest.raises(roboss.ArgumentError):
        cars.camera([0, 0, 1], [0, 0, 2])


def test_threads_change_no_pixel_and_pictures_no_bit():
    pictures, hashes = [], []
    for threads in (1, 3):
        sim = roboss.Simulation(roboss.example("city.sdf"), threads=threads)
        sim.step(20)
        pictures.append(sim.camera([20, 20, 15], [0, 0, 0], size=(97, 61)).picture())
        sim.step(20)
        hashes.append(sim.state_hash)
    plain = roboss.Simulation(roboss.example("city.sdf"))
    plain.step(40)
    np.testing.assert_array_equal(*pictures)
    assert hashes == [plain.state_hash] * 2


@pytest.mark.parametrize("wrong", [{"size": (0, 10)}, {"fov": 4}, {"far": 0}, {"position": [0, 0]}])
def test_refuses_cameras_that_cannot_be(still, wrong):
    options = {"position": [1, 0, 0], "target": [0, 0, 0], **wrong}
    with pytest.raises(roboss.ArgumentError):
        still.camera(options.pop("position"), options.pop("target"), **options)


def test_refuses_to_look_straight_down(still):
    with pytest.raises(roboss.ArgumentError, match="straight"):
        still.camera([0, 0, 9], [0, 0, 0]).picture()


@pytest.mark.parametrize("name, others", [("City", {"traffic": 3}), ("Soccer", {"cars": 1}), ("Warehouse", {"others": 1})])
def test_environments_render_frames_that_change(name, others):
    env = gymnasium.make(f"roboss/{name}-v0", render_mode="rgb_array", **others)
    env.reset(seed=1)
    first = env.render()
    assert first.shape == (320, 480, 3) and first.dtype == np.uint8 and first.std() > 10
    for _ in range(20):
        env.step(np.array([1.0, 0.2], dtype=np.float32))
    assert (env.render() != first).mean() > 0.05
    env.close()


def test_rendering_changes_no_bit():
    hashes = []
    for mode in (None, "rgb_array"):
        env = gymnasium.make("roboss/City-v0", traffic=3, render_mode=mode)
        env.reset(seed=1)
        for _ in range(5):
            env.step(np.array([0.5, 0.1], dtype=np.float32))
            if mode:
                env.render()
        hashes.append(env.unwrapped.state_hash)
        env.close()
    assert hashes[0] == hashes[1]


def test_human_mode_opens_the_page_once(monkeypatch, capsys):
    opened = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    env = roboss.envs.CityEnv(traffic=1, render_mode="human")
    env.reset(seed=1)
    env.render(), env.render()
    assert len(opened) == 1 and opened[0] in capsys.readouterr().out
    env.close()
    with pytest.raises(roboss.UnknownNameError, match="rgb_array"):
        roboss.envs.CityEnv(render_mode="ascii")
