"""Robots.link_parameters: own numbers of links as arrays; what is refused changes nothing."""
import numpy as np
import pytest
import roboss
from conftest import refuse_one


@pytest.fixture
def cars():
    return roboss.Simulation(roboss.example("crossroads.sdf"), threads=2).robots("car_*")


def test_they_are_those_of_the_file_at_first(cars):
    assert "mass" in cars.link_parameters and len(cars.link_parameters) == 15
    for name in cars.link_parameters:
        array = cars.link_parameters[name]
        assert array.shape == (16, len(cars.links))
        assert np.array_equal(array, cars.link_parameters.of_file(name), equal_nan=True)
    assert cars.link_parameters.units("mass") == ("kg",) * len(cars.links)
    assert cars.link_parameters.units("friction")[0] == ""


def test_what_is_assigned_is_there_at_once_and_alone(cars):
    sim, mass = cars.simulation, cars.link_parameters["mass"].copy()
    before = sim.state_hash
    friction = np.linspace(0.3, 0.9, 16)[:, None]
    cars.link_parameters["friction"] = friction
    assert np.allclose(cars.link_parameters["friction"], friction) and sim.state_hash != before
    assert np.array_equal(cars.link_parameters["mass"], mass)
    body = cars.links[0]
    cars[3].link_parameters.set(body, mass=2 * mass[3, 0], centre_z=0.02)
    assert cars[3].link_parameters["mass"][0, 0] == 2 * mass[3, 0]
    assert cars[3].link_parameters["inertia_xx"][0, 0] == pytest.approx(2 * cars.link_parameters.of_file("inertia_xx")[3, 0])
    assert cars[4].link_parameters["mass"][0, 0] == mass[4, 0]
    cars.link_parameters.reset()
    assert sim.state_hash == before


def test_a_part_of_an_inertia_leaves_the_rest(cars):
    body, before = cars.links[0], cars.link_parameters.of_file("inertia_yy")[0, 0]
    cars[0].link_parameters.set(body, inertia_xx=1.05 * cars.link_parameters.of_file("inertia_xx")[0, 0])
    assert cars[0].link_parameters["inertia_yy"][0, 0] == pytest.approx(before)
    with pytest.raises(roboss.OrderError) as refused:
        cars[0].link_parameters.set(body, inertia_xx=1e3)
    assert refused.value.code == "bad-inertia"


def test_a_heavier_arm_sags_by_its_weight():
    sim = roboss.Simulation(roboss.example("arm.sdf"))
    arm = sim.robots("arm")
    arm.set_joint_targets([0, 0.5, 0.5, 0, 0, 0], mode="position", position_gain=2000, velocity_gain=100)
    sim.step(3000)
    efforts = [arm.joint_effort[0].copy()]
    more = {name: arm.link_parameters[name][0, -1] for name in ("mass", "centre_x", "centre_y", "centre_z")}
    arm.link_parameters.set(arm.links[-1], mass=more["mass"] + 1.0)
    sim.step(3000)
    efforts.append(arm.joint_effort[0].copy())
    pose = arm.link_pose(arm.links[-1])[0]
    x, y, z, w = pose[3:]
    rotation = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                         [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                         [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    centre = pose[:3] + rotation @ [more["centre_x"], more["centre_y"], more["centre_z"]]
    model = roboss.RobotModel(sim.world, "arm")
    lever = model.jacobian(arm.joint_position[0], arm.links[-1])  # of the link's origin
    lift = lever[:3] + np.cross(lever[3:].T, centre - pose[:3]).T
    gravity = -sim.world.gravity[2]
    assert np.allclose(efforts[1] - efforts[0], gravity * lift[2], rtol=0.05, atol=0.05)
    assert np.abs(gravity * lift[2]).max() > 2


def test_slippery_cars_slide():
    sim = roboss.Simulation(roboss.example("crossroads.sdf"))
    cars = sim.robots("car_*")
    start = cars.pose[:, :2].copy()
    cars[:8].link_parameters["friction"] = 0.001
    cars.set_joint_targets(10.0)
    sim.step(300)
    way = np.linalg.norm(cars.pose[:, :2] - start, axis=1)
    assert way[:8].max() < 0.05 * way[8:].min()


def test_saves_resets_and_batches():
    batch = roboss.Batch(roboss.example("crossroads.sdf"), 3, threads=2)
    cars = batch.robots("car_*")
    cars.link_parameters["friction"] = np.array([0.2, 0.5, 0.8])[:, None, None]
    assert cars.link_parameters["friction"].shape == (3, 16, len(cars.links))
    sim = roboss.Simulation(roboss.example("crossroads.sdf"))
    alone = sim.robots("car_*")
    alone.link_parameters["friction"] = 0.5
    for some in (cars, alone):
        some.set_joint_targets(8.0)
    batch.step(100), sim.step(100)
    assert batch[1].state_hash == sim.state_hash and batch[2].state_hash != sim.state_hash
    save = sim.save()
    sim.reset()
    assert np.array_equal(alone.link_parameters["friction"], alone.link_parameters.of_file("friction"), equal_nan=True)
    sim.restore(save)
    assert sim.state_hash == batch[1].state_hash and np.nanmax(alone.link_parameters["friction"]) == 0.5


def test_what_is_not_a_number_stays_and_links_without_shapes_are_left_out():
    sim = roboss.Simulation(roboss.example("arm.sdf"))
    arm = sim.robots("arm")
    mass = arm.link_parameters["mass"].copy()
    wanted = np.full_like(mass, np.nan)
    wanted[0, 2] = 1.5
    arm.link_parameters["mass"] = wanted
    assert arm.link_parameters["mass"][0, 2] == 1.5
    assert np.array_equal(np.delete(arm.link_parameters["mass"], 2), np.delete(mass, 2), equal_nan=True)
    arm.link_parameters["friction"] = 0.7
    has = ~np.isnan(arm.link_parameters.of_file("friction"))
    assert np.all(arm.link_parameters["friction"][has] == 0.7)


@pytest.mark.parametrize("name, value, code", [
    ("mass", 0, "bad-parameter"), ("mass", -1, "bad-parameter"), ("mass", np.inf, "not-finite"),
    ("friction", -0.1, "bad-parameter"), ("restitution", 1.5, "bad-parameter"), ("centre_x", 1e13, "beyond-limit")])
def test_numbers_that_no_link_has_are_refused(cars, name, value, code):
    values = np.array(cars.link_parameters.of_file(name)) + 0.01
    values[11, 0] = value
    refuse_one(cars, cars.link_parameters, name, values, code)


def test_wrong_names_and_shapes(cars):
    with pytest.raises(roboss.UnknownNameError, match="did you mean 'mass'"):
        cars.link_parameters["mas"]
    with pytest.raises(roboss.UnknownNameError):
        cars.link_parameters["damping"] = 1
    with pytest.raises(roboss.UnknownNameError):
        cars.link_parameters.set("no_link", mass=1)
    with pytest.raises(roboss.ArgumentError):
        cars.link_parameters["mass"] = np.ones((3, 3))
    with pytest.raises(roboss.ArgumentError, match="no parameter"):
        cars.link_parameters.set(cars.links[0])


def test_they_stay_where_robots_come_and_go():
    sim = roboss.Simulation(roboss.example("crossroads.sdf"))
    cars = sim.robots("car_*")
    cars[1].link_parameters["friction"] = 0.2
    sim.remove("car_0")
    left = sim.robots("car_1")
    assert np.nanmax(left.link_parameters["friction"]) == 0.2
    sim.step(10)
    save = sim.save()
    other = roboss.Simulation(roboss.example("crossroads.sdf"))
    other.remove("car_0")
    del sim, cars, left
    other.restore(save)
    del save
    other.step(10)
    assert np.nanmax(other.robots("car_1").link_parameters["friction"]) == 0.2
