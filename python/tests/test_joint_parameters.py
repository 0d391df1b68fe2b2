"""Robots.parameters: own numbers of joints as arrays; what is refused changes nothing."""
import numpy as np
import pytest
import roboss
from conftest import refuse_one


@pytest.fixture
def cars():
    return roboss.Simulation(roboss.example("crossroads.sdf"), threads=2).robots("car_*")


def test_they_are_those_of_the_file_at_first(cars):
    assert "damping" in cars.parameters.names and len(cars.parameters) == 13
    for name in cars.parameters:
        array = cars.parameters[name]
        assert array.shape == (16, 4) and np.array_equal(array, cars.parameters.of_file(name))
        assert not array.flags.writeable
    assert np.array_equal(cars.parameters["max_effort"][0], cars.joint_effort_limits)
    assert cars.parameters.units("damping") == ("N m s/rad",) * 4
    assert cars.parameters.units("upper") == ("rad",) * 4


def test_what_is_assigned_is_there_at_once_and_alone(cars):
    sim, friction = cars.simulation, cars.parameters["friction"].copy()
    before = sim.state_hash
    wanted = np.arange(64).reshape(16, 4) / 100
    cars.parameters["damping"] = wanted
    assert np.array_equal(cars.parameters["damping"], wanted) and sim.state_hash != before
    assert np.array_equal(cars.parameters["friction"], friction)
    cars[3].parameters.set(["front_left"], damping=7, friction=0.5)
    assert cars[3].parameters["damping"][0, 0] == 7 and cars[3].parameters["damping"][0, 1] == wanted[3, 1]
    assert cars[4].parameters["friction"][0, 0] == friction[4, 0]
    cars.parameters.reset()
    assert sim.state_hash == before


def test_limits_are_set_one_by_one_or_together():
    arm = roboss.Simulation(roboss.example("arm.sdf")).robots("arm")
    arm.parameters["upper"] = 0.5
    assert np.all(arm.parameters["upper"] == 0.5)
    assert np.array_equal(arm.parameters["lower"], arm.parameters.of_file("lower"))
    arm.parameters.set("elbow", lower=-0.1, upper=0.1)
    with pytest.raises(roboss.OrderError) as refused:
        arm.parameters["lower"] = 0.3
    assert refused.value.code == "bad-parameter" and arm.parameters["lower"][0, 0] != 0.3


def test_a_bound_of_effort_slows_the_cars_that_have_it():
    sim = roboss.Simulation(roboss.example("crossroads.sdf"))
    cars = sim.robots("car_*")
    cars[:8].parameters["max_effort"] = 0.01                           # too weak to turn the wheels as ordered
    cars.set_joint_targets(10.0)
    sim.step(200)
    speed = cars.joint_velocity.mean(axis=1)
    assert np.all(speed[:8] < 5) and np.all(speed[8:] > 5)


def test_gains_of_targets_are_the_robots_own():
    sim = roboss.Simulation(roboss.example("arm.sdf"))
    arm = sim.robots("arm")
    arm.set_joint_targets([0, 0.5, 0.5, 0, 0, 0], mode="position", position_gain=2000, velocity_gain=100)
    assert np.all(arm.parameters["position_gain"] == 0)               # an order: from the next tick on
    sim.step(1)
    assert np.all(arm.parameters["position_gain"] == 2000) and np.all(arm.parameters["velocity_gain"] == 100)
    sim.step(3000)
    sag = np.array([0, 0.5, 0.5, 0, 0, 0]) - arm.joint_position[0]
    assert np.abs(sag).max() > 1e-4
    assert np.allclose(2000 * sag, arm.joint_effort[0], atol=1e-2)


def test_saves_and_resets():
    sim = roboss.Simulation(roboss.example("crossroads.sdf"))
    cars = sim.robots("car_*")
    cars.parameters["friction"] = 0.05
    save, hash_ = sim.save(), sim.state_hash
    cars.set_joint_targets(5.0)
    sim.step(50)
    after = sim.state_hash
    sim.reset()
    assert np.array_equal(cars.parameters["friction"], cars.parameters.of_file("friction"))
    sim.restore(save)
    assert sim.state_hash == hash_ and np.all(cars.parameters["friction"] == 0.05)
    cars.set_joint_targets(5.0)
    sim.step(50)
    assert sim.state_hash == after


def test_of_a_batch_each_simulation_has_its_own():
    batch = roboss.Batch(roboss.example("crossroads.sdf"), 3, threads=2)
    cars = batch.robots("car_*")
    cars.parameters["damping"] = np.array([0.0, 0.1, 0.2])[:, None, None]
    assert cars.parameters["damping"].shape == (3, 16, 4)
    assert np.all(cars.parameters["damping"][2] == 0.2)
    alone = roboss.Simulation(roboss.example("crossroads.sdf"))
    alone.robots("car_*").parameters["damping"] = 0.1
    for some in (cars, alone.robots("car_*")):
        some.set_joint_targets(8.0)
    batch.step(100), alone.step(100)
    assert batch[1].state_hash == alone.state_hash and batch[2].state_hash != alone.state_hash
    cars.parameters.reset(["front_left"])
    assert np.all(cars.parameters["damping"][..., 0] == cars.parameters.of_file("damping")[..., 0])


@pytest.mark.parametrize("name, value, code", [
    ("damping", -1, "bad-parameter"), ("friction", np.nan, "not-finite"), ("position_gain", np.inf, "not-finite"),
    ("armature", 1e13, "beyond-limit"), ("limit_stiffness", 0, "bad-parameter")])
def test_numbers_that_no_joint_has_are_refused(cars, name, value, code):
    values = np.array(cars.parameters.of_file("damping")) + 0.1
    values[11, 2] = value
    refuse_one(cars, cars.parameters, name, values, code)


def test_wrong_names_and_shapes(cars):
    with pytest.raises(roboss.UnknownNameError, match="did you mean 'damping'"):
        cars.parameters["dampin"]
    with pytest.raises(roboss.UnknownNameError):
        cars.parameters["mass"] = 1
    with pytest.raises(roboss.UnknownNameError):
        cars.parameters.set("rudder", damping=1)
    with pytest.raises(roboss.ArgumentError):
        cars.parameters.set("front_left")
    with pytest.raises(roboss.ArgumentError):
        cars.parameters["damping"] = np.zeros(5)
    with pytest.raises(ValueError):
        cars.parameters["damping"][0, 0] = 1
