"""Many simulations of one world."""
import numpy as np
import pytest

import roboss


def push(robots, number):
    robots.apply_wrench([50.0 * number, 0, 100, 0, 0, 5], ticks=50)


@pytest.mark.parametrize("threads", [1, 3])
def test_has_the_bits_of_simulations_alone(threads):
    world = roboss.load(roboss.example("crossroads.sdf"))
    batch = roboss.Batch(world, 4, threads=threads, seed=3)
    cars = batch.robots("car_*")
    cars.apply_wrench([[[50.0 * number, 0, 100, 0, 0, 5]] for number in range(4)], ticks=50)
    assert not batch.step(120).any()
    for number in range(4):
        alone = roboss.Simulation(world, threads=1, seed=3 + number)
        push(alone.robots("car_*"), number)
        alone.step(120)
        assert batch[number].state_hash == alone.state_hash
        assert np.array_equal(cars.pose[number], alone.robots("car_*").pose)
        assert np.array_equal(cars["laser"].read()[number], alone.robots("car_*")["laser"].read())


def test_arrays_have_simulations_first():
    batch = roboss.Batch(roboss.example("crossroads.sdf"), 3)
    cars = batch.robots("car_*")
    assert cars.twist.shape == (3, 16, 6) and cars["gps"].read().shape == (3, 16, 3)
    assert cars["compass"].read_all()["heading"].shape == (3, 16)
    poses = cars.pose.copy()
    poses[1, 5, 2] += 1
    cars.pose = poses
    assert np.allclose(cars.pose, poses) and np.allclose(batch[1].robots("car_5").pose, poses[1, 5])
    cars[2].joint_velocity = [1, 2, 3, 4]
    assert np.array_equal(cars.joint_velocity[:, 2], np.tile([1.0, 2, 3, 4], (3, 1)))
    with pytest.raises(roboss.ArgumentError):
        cars.pose = np.zeros((2, 16, 7))
    with pytest.raises(roboss.ArgumentError):
        roboss.Batch(batch.world, 0)


def test_readings_are_the_same_for_any_number_of_threads():
    readings = []
    for threads in (1, 2, 5):
        batch = roboss.Batch(roboss.example("crossroads.sdf"), 7, threads=threads, seed=3)
        cars = batch.robots("car_*")
        cars.set_joint_targets(np.arange(7.0)[:, None, None])
        batch.step(400)
        read = {name: cars[name].read_all() for name in cars.sensors}
        readings.append((read, cars.touching))
    for read, touching in readings[1:]:
        assert np.array_equal(touching, readings[0][1])
        for name, values in readings[0][0].items():
            for value, expected in values.items():
                assert all(map(np.array_equal, read[name][value], expected)), (name, value)
    alone = roboss.Simulation(batch.world, threads=1, seed=3 + 4)
    alone.robots("car_*").set_joint_targets(4.0)
    alone.step(400)
    assert np.array_equal(read["laser"]["ranges"][4], alone.robots("car_*")["laser"].read())


def test_one_that_stops_keeps_no_other_from_going_on():
    batch = roboss.Batch("""<sdf version="1.9"><world name="w"><physics name="p" type="ode">
        <max_step_size>0.1</max_step_size></physics><model name="top"><link name="body"><inertial><mass>1e-3</mass>
        <inertia><ixx>1e-6</ixx><iyy>2e-6</iyy><izz>2.5e-6</izz></inertia></inertial></link></model></world></sdf>""", 3)
    batch[1].robots("top").apply_wrench([0, 0, 0, 1e9, 1e9, 1e9], ticks=100)
    assert batch.step(100).tolist() == [False, True, False]
    assert [sim.tick for sim in (batch[0], batch[2])] == [100, 100] and batch[1].tick < 100
    with pytest.raises(roboss.StateError):
        batch[1].step(100)
    batch.reset(np.array([False, True, False]))
    assert [sim.tick for sim in batch] == [100, 0, 100]
    assert not batch.step(10).any()
