"""A Batch of different worlds: each simulation has the bits that it has alone, arrays are padded, errors name what differs."""
import pickle

import numpy as np
import pytest

import roboss
from test_errors import refused


def row_of(count, mass=2.0):
    """A world of so many balls in a row, 1 m above the ground."""
    builder = roboss.WorldBuilder(f"row_{count}")
    builder.ground()
    for number in range(count):
        builder.sphere(f"ball_{number}", 0.1, mass=mass, pose=[number, 0, 1])
    return builder.build()


@pytest.fixture
def batch():
    return roboss.Batch([row_of(2), row_of(5), row_of(3)], threads=2, seed=7)


def test_each_goes_on_as_it_does_alone(batch):
    balls = batch.robots("ball_*", padded=True)
    balls.twist = [1, 0, 0, 0, 0, 0]
    batch.step(300)
    for world, sim, seed in zip(batch.worlds, batch, (7, 8, 9)):
        alone = roboss.Simulation(world, threads=1, seed=seed)
        alone.robots("ball_*").twist = [1, 0, 0, 0, 0, 0]
        alone.step(300)
        assert sim.state_hash == alone.state_hash and sim.seed == seed and sim.world is world


def test_rows_without_a_robot_are_empty_and_ignored(batch):
    balls = batch.robots("ball_*", padded=True)
    assert balls.pose.shape == (3, 5, 7) and balls.counts.tolist() == [2, 5, 3]
    assert np.array_equal(np.isnan(balls.pose).all(axis=2), ~balls.mask)
    poses = balls.pose
    poses[..., 2] += np.arange(3)[:, None]
    balls.pose = poses
    assert np.array_equal(balls.pose, poses, equal_nan=True)
    assert [member.pose[0, 2] for member in balls.members] == [1, 2, 3]
    balls.apply_wrench(np.full((3, 5, 6), [0, 0, 100.0, 0, 0, 0]), ticks=10)
    batch.step(10)
    assert (balls.twist[balls.mask][:, 2] > 0).all()
    assert balls.touching.dtype == bool and not balls.touching.any()


def test_a_pattern_may_match_nothing_in_some_worlds(batch):
    last = batch.robots("ball_4", padded=True)
    assert last.counts.tolist() == [0, 1, 0] and last.pose.shape == (3, 1, 7)
    assert np.isnan(last.pose[[0, 2]]).all() and last.pose[1, 0, 0] == 4
    with pytest.raises(roboss.UnknownNameError) as error:
        batch.robots("cube_*", padded=True)
    refused(error, "unknown-name", "cube_*", "ball_0")


def test_joints_and_sensors_are_padded_where_they_are_the_same():
    batch = roboss.Batch([roboss.load(roboss.example(name)) for name in ("crossroads.sdf", "city.sdf")])
    cars = batch.robots("car_*", padded=True)
    cars.set_joint_targets(np.broadcast_to(np.arange(50.0)[None, :, None] % 7, (2, 50, 4)))
    batch.step(300)
    assert cars.joint_velocity.shape == (2, 50, 4) and cars["laser"].shape == (2, 50, 21)
    assert np.allclose(cars.joint_velocity[1, 3], 3, atol=0.1) and np.allclose(cars.joint_velocity[0, 8], 1, atol=0.1)
    assert np.array_equal(cars["laser"][0, :16], batch[0].robots("car_*")["laser"].read())
    both = roboss.Batch([roboss.load(roboss.example("arm.sdf")), roboss.load(roboss.example("city.sdf"), dt=0.001)])
    with pytest.raises(roboss.ArgumentError) as error:
        both.robots("*", padded=True).joint_position
    refused(error, "mixed-types")


def test_it_is_pickled(batch):
    batch.step(20)
    again, balls = pickle.loads(pickle.dumps((batch, batch.robots("*", padded=True))))
    batch.step(50), again.step(50)
    assert [sim.state_hash for sim in again] == [sim.state_hash for sim in batch]
    assert balls.batch is again and np.array_equal(balls.pose, batch.robots("*", padded=True).pose, equal_nan=True)


def test_what_cannot_be_is_told(batch):
    with pytest.raises(roboss.ArgumentError) as error:
        batch.robots("ball_*")
    refused(error, "different-worlds", "padded=True")
    with pytest.raises(roboss.ArgumentError) as error:
        roboss.Batch([row_of(1), roboss.load(roboss.example("arm.sdf"))])
    refused(error, "other-step", "0.001 s", "0.002 s")
    for worlds, count in (([], None), ([row_of(1)], 2)):
        with pytest.raises(roboss.ArgumentError) as error:
            roboss.Batch(worlds, count)
        refused(error, "wrong-count")
    with pytest.raises(roboss.ArgumentError):
        roboss.Batch(row_of(1))  # how many?
    with pytest.raises(roboss.ArgumentError):
        batch.robots("*", padded=True).pose = np.zeros((3, 4, 7))
    with pytest.raises(roboss.StateError):
        batch[0].remove("ball_0")


def test_one_world_many_times_is_one_batch_of_arrays():
    world = row_of(2)
    batch = roboss.Batch([world, world])
    assert batch.robots("ball_*").pose.shape == (2, 2, 7)
    assert roboss.Batch(world, 2).robots("*", padded=True).pose.shape == (2, 2, 7)
