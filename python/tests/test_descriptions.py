"""What arrays are of: descriptions of sensors are those of the world, and specs read and order what they say."""
import gymnasium
import numpy as np
import pytest

import roboss
from test_errors import refused
from test_types import _laser, _robots, _rover


@pytest.fixture(scope="module")
def cars():
    return roboss.Simulation(roboss.example("city.sdf"), threads=1).robots("car_*")


def test_beams_of_a_laser_are_where_its_angles_say():
    """A wall at x = 200 m: the range along each beam follows from its direction."""
    grid = """<sensor name="grid" type="gpu_lidar"><pose>0.1 0.2 0.3 0 0 0.4</pose><lidar><scan>
      <horizontal><samples>5</samples><min_angle>-1</min_angle><max_angle>0.2</max_angle></horizontal>
      <vertical><samples>3</samples><min_angle>0</min_angle><max_angle>0.3</max_angle></vertical></scan>
      <range><min>.1</min><max>50</max></range></lidar></sensor>"""
    wall = """<model name="wall"><static>true</static><link name="l"><collision name="c"><pose>200.5 0 0 0 0 0</pose>
      <geometry><box><size>1 400 400</size></box></geometry></collision></link></model>"""
    rover = _robots(_rover("r", sensors=grid), wall, wanted="r")
    rover.pose = [190, 0, 5, 0, 0, 0, 1]
    laser = rover["grid"].description
    assert laser.column_angles.tolist() == pytest.approx(np.linspace(-1, 0.2, 5)) and len(laser.row_angles) == 3
    assert (laser.link, laser.kind, laser.range) == ("base", "laser", (0.1, 50.0))
    assert np.allclose(laser.pose, [0.1, 0.2, 0.3, 0, 0, np.sin(0.2), np.cos(0.2)])
    turn = np.array([[np.cos(0.4), -np.sin(0.4), 0], [np.sin(0.4), np.cos(0.4), 0], [0, 0, 1]])
    along_x = (laser.directions @ turn.T)[:, 0]
    expected = (200 - rover.link_pose("base")[0, 0] - 0.1) / along_x
    assert np.allclose(rover["grid"].read()[0], expected, atol=1e-9)


def test_intrinsics_are_those_of_the_readings():
    sim = roboss.Simulation(roboss.example("cameras.sdf"))
    rover = sim.robots("rover")
    for name in ("eye", "depth"):
        fx, fy, cx, cy = rover[name].read_all()["intrinsics"][0]
        assert np.allclose(rover[name].description.intrinsics, [[fx, 0, cx], [0, fy, cy], [0, 0, 1]])
    assert rover["eye"].description.values["color"].shape == (240, 320, 3)
    assert rover["eye"].description.values["color"].dtype == "uint8"
    assert rover["imu"].description.intrinsics is None and rover["imu"].description.range is None


@pytest.mark.parametrize("world", ["city.sdf", "cameras.sdf", "arm_cell.sdf", "drives.sdf", "radio.sdf", "joints.sdf"])
def test_every_value_that_is_read_is_described(world):
    sim = roboss.Simulation(roboss.example(world))
    sim.step(20)
    for robot in sim.world.robots[:12]:
        robots = sim.robots([robot])
        for name in robots.sensors:
            reading, description = robots[name].read_all(), robots[name].description
            assert list(description.values) == list(reading) and description.link in robots.links
            assert {value: entry.unit for value, entry in description.values.items()} == robots[name].units
            for value, entry in description.values.items():
                array = np.asarray(reading[value][0])
                assert len(entry.shape) == array.ndim
                assert all(want in (None, have) for want, have in zip(entry.shape, array.shape))
                assert entry.dtype in ("object", array.dtype.name)


def test_vectors_have_frames(cars):
    compass = cars["compass"].description.values
    assert (compass["orientation_quat_xyzw"].frame, compass["magnetic_field"].frame) == ("world", "sensor")
    assert cars["gps"].description.values["world"].frame == "world"
    assert cars["laser"].description.parameters["noise"].value["stddev"] == 0.01
    assert cars["laser"].description.parameters["noise"].unit == "m"


def test_sensors_that_differ_are_described_by_type():
    robots = _robots(_rover("a", sensors=_laser()), _rover("b", sensors=_laser(samples=5)))
    with pytest.raises(roboss.ArgumentError) as error:
        robots["laser"].description
    refused(error, "mixed-types", "laser")
    assert [len(robots[row]["laser"].description.column_angles) for row in (0, 1)] == [8, 5]


def test_an_observation_is_what_its_columns_say(cars):
    spec = cars.observation_spec(["twist", "laser", "compass", "joint_velocity"])
    assert spec.names[:2] == ("vx", "vy") and spec.names[6] == "laser[0]" and spec.names[-1] == "rear_right"
    assert len(spec) == len(spec.names) == len(spec.units) == len(spec.low) == 6 + 21 + 11 + 4
    cars.twist = [0.5, 0, 0, 0, 0, 0.1]
    cars.joint_velocity = 3.0
    seen = spec.read()
    assert seen.shape == (50, len(spec)) and seen.dtype == np.float32
    ranges = cars["laser"].read().clip(0.02, 6.0)
    assert np.array_equal(seen[:, 6:27], ranges.astype(np.float32)) and (seen[:, -4:] == 3).all()
    assert np.array_equal(seen[:, :6], cars.twist.astype(np.float32))
    assert isinstance(spec.space, gymnasium.spaces.Box) and all(spec.space.contains(row) for row in seen)
    assert {part.name: part.unit for part in spec.parts}["compass.heading"] == "rad"


def test_an_observation_of_a_batch_has_its_axis():
    batch = roboss.Batch(roboss.example("crossroads.sdf"), 3)
    cars = batch.robots("car_*")
    assert cars.observation_spec(["laser"]).read().shape == (3, 16, 21)
    cars.action_spec("velocity", low=-9, high=9).give_scaled(np.array([0, 0.5, 1])[:, None, None])
    batch.step(600)
    assert np.allclose(cars.joint_velocity[:, 0, 0], [0, 4.5, 9], atol=0.05)


def test_without_names_an_observation_has_all_numbers():
    arm = roboss.Simulation(roboss.example("arm.sdf")).robots("arm")
    spec = arm.observation_spec()
    assert spec.names == (*arm.joints, *arm.joints) and {"rad", "rad/s"} == set(spec.units)
    assert np.array_equal(spec.low[:6], arm.joint_limits[:, 0]) and np.isinf(spec.low[6:]).all()
    rover = roboss.Simulation(roboss.example("cameras.sdf")).robots("rover")
    assert not any(name.startswith("eye") for name in rover.observation_spec().names)


def test_actions_reach_the_motors_within_their_bounds():
    sim = roboss.Simulation(roboss.example("arm.sdf"))
    arm = sim.robots("arm")
    spec = arm.action_spec("position")
    target = 0.2 * spec.high
    for _ in range(3000):
        spec.give(target)
        sim.step()
    assert np.allclose(arm.joint_position[0], target, atol=0.02)
    spec = arm.action_spec("velocity")
    assert np.array_equal(spec.high, arm.joint_velocity_limits) and set(spec.units) == {"rad/s"}
    assert set(arm.action_spec("effort").units) == {"N m"}
    rover = roboss.Simulation(roboss.example("drives.sdf")).robots("rover")
    spec = rover.action_spec(command="cmd_vel", low=-1, high=1)
    spec.give_scaled([0.5, 0, 0, 0, 0, 0][:len(spec)])
    rover.simulation.step(500)
    assert rover.twist[0, 0] == pytest.approx(0.5, abs=0.05)


def test_what_cannot_be_a_spec_is_told(cars):
    with pytest.raises(roboss.UnknownNameError) as error:
        cars.observation_spec(["lazer"])
    refused(error, "unknown-name", "laser", "twist")
    with pytest.raises(roboss.ArgumentError) as error:
        roboss.Simulation(roboss.example("cameras.sdf")).robots("rover").observation_spec(["eye"])
    refused(error, "no-columns", "eye")
    with pytest.raises(roboss.UnknownNameError):
        cars.action_spec("torque")
    for wrong in ({}, {"mode": "velocity", "command": "cmd_vel"}):
        with pytest.raises(roboss.ArgumentError):
            cars.action_spec(**wrong)
    with pytest.raises(roboss.ArgumentError) as error:
        cars.action_spec("velocity", low=1, high=-1)
    refused(error, "bad-bounds")
    with pytest.raises(roboss.ArgumentError):
        cars.action_spec("velocity", low=-1, high=1).give(np.zeros((50, 3)))
    with pytest.raises(roboss.OrderError):
        cars.action_spec("velocity", low=-1, high=1).give(np.nan)
    rover = roboss.Simulation(roboss.example("drives.sdf")).robots("rover")
    with pytest.raises(roboss.ArgumentError) as error:
        rover.action_spec(command="cmd_vel").give_scaled(0)
    refused(error, "no-bounds", "linear_x")
