"""Live views: arrays that follow a simulation, for as long as they are held."""
import gc
import sys

import numpy as np
import pytest

import roboss

PROPERTIES = ("pose", "twist", "joint_position", "joint_velocity")


def moving(threads=1):
    """Sixteen cars under way, and them."""
    sim = roboss.Simulation(roboss.example("crossroads.sdf"), threads=threads)
    cars = sim.robots("car_*")
    cars.set_joint_targets(np.linspace(4, 12, 64).reshape(16, 4))
    sim.step(100)
    return sim, cars


@pytest.mark.parametrize("name", PROPERTIES)
def test_an_array_that_is_held_follows_all_that_changes_states(name):
    sim, cars = moving()
    live = getattr(cars, name)
    slices, some = live[3:5], getattr(cars[3:5], name)
    sim.step(20)
    save, kept = sim.save(), live.copy()

    def follows():
        fresh = getattr(sim.robots("car_*"), name)
        return np.array_equal(live, fresh) and np.array_equal(slices, fresh[3:5]) and np.array_equal(some, fresh[3:5])

    assert follows() and not np.array_equal(live, np.zeros_like(live))
    for change in (lambda: sim.step(30), lambda: sim.restore(save), lambda: setattr(cars[4], name, live[5]), sim.reset):
        before = live.copy()
        change()
        assert follows() and not np.array_equal(live, before)
    sim.restore(save)
    assert np.array_equal(live, kept)


@pytest.mark.parametrize("name", PROPERTIES)
def test_every_access_gives_the_same_memory_read_only(name):
    _, cars = moving()
    one, other = getattr(cars, name), getattr(cars, name)
    assert one.ctypes.data == other.ctypes.data and one.flags.c_contiguous and one.dtype == np.float64
    with pytest.raises(ValueError):
        one[0, 0] = 1
    with pytest.raises(ValueError):
        other += 1
    with pytest.raises(ValueError):
        one[2:4].flags.writeable = True


def test_a_slice_that_outlives_its_array_and_its_robots_still_follows():
    sim, cars = moving()
    row = cars[7].pose[0]
    del cars
    gc.collect()
    sim.step(50)
    assert np.array_equal(row, sim.robots("car_7").pose[0])


def test_arrays_outlive_the_simulation():
    sim, cars = moving()
    pose = cars.pose
    kept = pose.copy()
    del sim, cars
    gc.collect()
    [np.ones(len(kept) * 7) for _ in range(1000)]  # freed memory would be taken by these
    assert np.array_equal(pose, kept)


def test_arrays_keep_their_last_values_when_robots_come_or_go():
    sim, cars = moving()
    pose = cars.pose
    kept = pose.copy()
    sim.remove("car_3")
    sim.step(50)
    assert np.array_equal(pose, kept)
    with pytest.raises(roboss.StateError):
        cars.pose
    assert not np.array_equal(sim.robots("car_0").pose[0], kept[0])


def test_an_array_has_the_tick_at_which_a_step_failed():
    text = """<robot name="ball"><link name="b"><inertial><mass value="1e-3"/>
      <inertia ixx="1e-6" iyy="2e-6" izz="1e-6" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>"""
    sim = roboss.Simulation(roboss.load(text, dt=0.1))
    ball = sim.robots("ball")
    twist = ball.twist
    ball.apply_wrench([0, 0, 0, 1e9, 1e9, 1e9], ticks=100)
    with pytest.raises(roboss.StateError):
        sim.step(100)
    assert 0 < sim.tick < 100 and np.array_equal(twist, sim.robots("ball").twist) and twist.any()


def test_what_a_robot_of_a_batch_refuses_shows_what_was_set_before_it():
    batch = roboss.Batch(roboss.example("crossroads.sdf"), 2)
    cars = batch.robots("car_*")
    live = cars.pose
    poses = live.copy()
    poses[0, 0, 0] += 1
    poses[1, 3, 1] = np.nan
    with pytest.raises(roboss.OrderError):
        cars.pose = poses
    assert live[0, 0, 0] == batch[0].robots("car_0").pose[0, 0] == poses[0, 0, 0]


def test_arrays_of_a_batch_follow_each_of_its_simulations():
    batch = roboss.Batch(roboss.example("crossroads.sdf"), 3, threads=2)
    cars = batch.robots("car_*")
    cars.set_joint_targets(np.arange(3.0)[:, None, None] * 4)
    live, of_one = cars.joint_velocity, batch[1].robots("car_*").joint_velocity
    batch.step(200)
    assert np.allclose(live[:, :, 0].mean(axis=1), [0, 4, 8], atol=0.1) and np.array_equal(live[1], of_one)
    batch[1].step(50)
    assert np.array_equal(live[1], batch[1].robots("car_*").joint_velocity) and np.array_equal(live[1], of_one)
    batch.reset([2])
    assert not live[2].any() and live[1].any()


def test_arrays_come_and_go_without_leaving_anything():
    sim, cars = moving()
    kept = cars.pose
    references = sys.getrefcount(sim)
    for _ in range(2000):
        cars[3].pose, cars.twist  # each array is let go at once
    sim.step()
    gc.collect()
    assert sys.getrefcount(sim) == references and np.array_equal(kept, sim.robots("car_*").pose)
