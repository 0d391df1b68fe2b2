"""Save, restore, reset; arrays; memory; threads of Python."""
import resource
import threading

import numpy as np
import pytest

import roboss


def drive(sim):
    """Sends the cars into each other, each at a speed of its own."""
    cars = sim.robots("car_*")
    speeds = 5.0 + np.arange(len(cars))[:, None] * np.array([1, 0.8, 1, 0.8])
    cars.set_joint_targets(speeds)
    return cars


def test_continues_exactly_from_a_save(crossroads):
    drive(crossroads)
    crossroads.step(100)
    drive(crossroads)  # orders that wait
    save = crossroads.save()
    assert (save.tick, save.seed) == (100, 0)
    crossroads.step(300)
    wanted = crossroads.state_hash
    other = roboss.Simulation(crossroads.world, threads=3, seed=7)
    for sim in (crossroads, other):
        sim.restore(save)
        assert sim.tick == 100
        sim.step(300)
        assert sim.state_hash == wanted
    assert other.seed == 0


def test_is_new_after_a_reset(crossroads):
    start = crossroads.state_hash
    drive(crossroads)
    crossroads.step(50)
    drive(crossroads)
    crossroads.reset(seed=5)
    assert (crossroads.tick, crossroads.seed, crossroads.state_hash) == (0, 5, start)
    crossroads.step(50)
    fresh = roboss.Simulation(crossroads.world)
    fresh.step(50)
    assert crossroads.state_hash == fresh.state_hash


def test_noise_follows_the_seed():
    sim = roboss.Simulation(roboss.example("city.sdf"), seed=1)
    laser = sim.robots("car_*")["laser"]
    one = laser.read()
    sim.reset(seed=2)
    assert not np.array_equal(laser.read(), one)
    sim.reset(seed=1)
    assert np.array_equal(laser.read(), one)


def test_memory_stays_flat_over_resets_and_restores():
    sim = roboss.Simulation(roboss.example("crossroads.sdf"), threads=2)
    cars = drive(sim)
    saved = []

    def cycle(times):
        for _ in range(times):
            sim.reset()
            sim.step(2)
            saved[:] = [sim.save()]
            sim.restore(saved[0])
            cars.pose = cars.pose
            len(sim.contacts)
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss  # KiB, the most so far

    before = cycle(100)
    assert cycle(1000) - before < 1024


def test_what_is_set_is_there_at_once(crossroads):
    cars = crossroads.robots("car_*")
    pose = cars.pose.copy()
    assert pose.shape == (16, 7) and np.allclose(np.linalg.norm(pose[:, 3:], axis=1), 1)
    pose[:, 2] += np.arange(16)
    cars.pose = pose
    assert np.allclose(cars.pose, pose, atol=1e-12)
    cars.twist = [1, 2, 3, 0, 0, 4]
    assert np.array_equal(cars.twist, np.tile([1.0, 2, 3, 0, 0, 4], (16, 1)))
    cars.joint_position = np.arange(64).reshape(16, 4) / 10
    assert np.array_equal(cars.joint_position, np.arange(64).reshape(16, 4) / 10)
    cars.joint_velocity = 2
    assert np.all(cars.joint_velocity == 2)
    assert np.array_equal(cars[1:3].joint_position, cars.joint_position[1:3])
    assert cars[np.arange(16) % 5 == 0].names == ("car_0", "car_5", "car_10", "car_15")
    assert cars[-1].names == ("car_15",)


def test_falls_as_a_body_falls(crossroads):
    cars = crossroads.robots("car_*")
    pose = cars.pose.copy()
    pose[:, 2] += 10
    cars.pose = pose
    crossroads.step(100)
    time = crossroads.time
    assert np.allclose(cars.twist[:, 2], -9.8 * time, atol=1e-9)
    assert np.allclose(cars.pose[:, 2], pose[:, 2] - 4.9 * time**2, atol=1e-9)
    assert np.allclose(cars.link_pose(cars.links[0])[:, 2], cars.pose[:, 2], atol=1)


def test_contacts_carry_the_weight(crossroads):
    crossroads.step(300)
    contacts = crossroads.contacts
    assert contacts.dtype == roboss.CONTACT and len(contacts) > 0
    of_one = contacts[contacts["robot_a"] == 3]
    assert np.all(of_one["robot_b"] == -1) and np.allclose(of_one["normal"], [0, 0, 1])
    weights = [contacts["force"][contacts["robot_a"] == car, 2].sum() for car in range(16)]
    assert np.allclose(weights, weights[0], rtol=1e-3) and 20 < weights[0] < 500


def test_other_threads_run_while_it_steps():
    sim = roboss.Simulation(roboss.example("city.sdf"), threads=1)
    worker = threading.Thread(target=sim.step, args=(2000,))
    worker.start()
    seen = set()
    while worker.is_alive():
        try:
            sim.tick
        except roboss.StateError as error:
            seen.add(error.code)
    worker.join()
    assert seen == {"busy"} and sim.tick == 2000


def test_effort_motors_drive_as_their_torques(crossroads):
    cars = crossroads.robots("car_*")
    crossroads.step(200)
    cars.set_joint_targets(0.1, mode="effort")
    crossroads.step(100)
    speeds = cars.joint_velocity.copy()
    assert np.allclose(speeds, speeds[0, 0], rtol=1e-3) and speeds[0, 0] > 1
    assert cars.joint_limits.shape == (4, 2) and np.all(cars.joint_effort_limits == 0.8)


def test_commands_by_name_and_by_row_are_the_same():
    hashes = []
    for give in (lambda rover: rover.command("cmd_vel", linear_x=0.8, angular_z=0.5),
                 lambda rover: rover.command("cmd_vel", [[0.8, 0, 0, 0, 0, 0.5]])):
        sim = roboss.Simulation(roboss.example("drives.sdf"), threads=1)
        assert sim.robots("rover").commands["cmd_vel"][5] == ("angular_z", "rad/s")
        give(sim.robots("rover"))
        sim.step(100)
        hashes.append(sim.state_hash)
    assert hashes[0] == hashes[1]
