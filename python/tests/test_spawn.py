"""Robots that come and go: the others keep every bit, names and errors fit, old Robots do not read the new world."""
import numpy as np
import pytest

import roboss

BALL = ('<sdf version="1.9"><model name="ball"><link name="body"><inertial><mass>1</mass><inertia><ixx>0.01</ixx>'
        '<iyy>0.01</iyy><izz>0.01</izz></inertia></inertial><collision name="c"><geometry><sphere><radius>0.1</radius>'
        '</sphere></geometry></collision></link></model></sdf>')
FAR = [[50, 50 + i, 1, 0, 0, 0, 1] for i in range(3)]


@pytest.fixture
def sim():
    sim = roboss.Simulation(roboss.example("crossroads.sdf"), threads=2, seed=3)
    sim.robots("car_*").set_joint_targets(6.0)
    sim.step(50)
    return sim


def test_those_that_stay_keep_every_bit(sim):
    other = roboss.Simulation(sim.world, threads=1, seed=3)
    other.restore(sim.save())
    balls = sim.spawn(BALL, ["a", "b", "c"], FAR)
    assert balls.names == ("a", "b", "c") and sim.tick == 50 and sim.seed == 3
    assert np.array_equal(balls.pose, FAR)
    sim.step(100), other.step(100)
    assert np.array_equal(sim.robots("car_*").pose, other.robots("car_*").pose)
    sim.remove(["a", "b", "c"])
    assert sim.world.hash == other.world.hash and sim.state_hash == other.state_hash
    sim.step(100), other.step(100)
    assert sim.state_hash == other.state_hash


def test_orders_that_wait_go_along(sim):
    other = roboss.Simulation(sim.world, seed=3)
    other.restore(sim.save())
    for one in (sim, other):
        one.robots("car_2").set_joint_targets(-3.0)
    sim.remove("car_1")
    other.step(5), sim.step(5)
    assert np.array_equal(sim.robots("car_2").joint_velocity, other.robots("car_2").joint_velocity)


def test_a_ball_that_came_rests_on_the_ground_and_touches(sim):
    ball = sim.spawn(BALL, "ball", [50, 50, 0.3, 0, 0, 0, 1])
    sim.step(1000)
    assert ball.pose[0, 2] == pytest.approx(0.1, abs=1e-3)
    number = sim.world.robots.index("ball")
    assert number in sim.contacts["robot_a"] or number in sim.contacts["robot_b"]


def test_robots_stand_on_the_ground_where_that_is_asked_for(sim):
    balls = sim.spawn(BALL, ["low", "high"], [[50, 50, -3, 0, 0, 0, 1], [50, 52, 7, 0, 0, 0, 1]], on_ground=True)
    assert np.allclose(balls.pose[:, 2], 0.1, atol=1e-6)
    world = roboss.load(BALL, ground=True, on_ground=True)
    assert roboss.Simulation(world).robots().pose[0, 2] == pytest.approx(0.1, abs=1e-6)


def test_robots_deep_in_the_ground_are_a_warning(sim):
    with pytest.warns(roboss.WorldWarning, match="deep"):
        sim.spawn(BALL, "deep", [50, 50, 0, 0, 0, 0, 1])
    with pytest.warns(roboss.WorldWarning, match="deep"):
        roboss.load(BALL, ground=True)


def test_old_robots_say_that_the_world_changed(sim):
    cars = sim.robots("car_*")
    laser = cars["laser"]
    sim.spawn(BALL, "ball", FAR[0])
    for read in (lambda: cars.pose, laser.read, lambda: cars[3], lambda: cars.set_joint_targets(0.0)):
        with pytest.raises(roboss.StateError) as error:
            read()
        assert error.value.code == "changed-world"
    assert sim.robots("car_*")["laser"].read().shape[0] == 16


def test_what_is_refused_changes_nothing(sim):
    cars, before = sim.robots("car_*"), sim.state_hash
    with pytest.raises(roboss.WorldError) as error:
        sim.spawn(BALL, "car_0")
    assert error.value.code == "name-taken"
    with pytest.raises(roboss.WorldError) as error:
        sim.spawn(roboss.load(BALL, dt=0.01), "ball")
    assert error.value.code == "other-step"
    with pytest.raises(roboss.UnknownNameError):
        sim.remove("lorry")
    with pytest.raises(roboss.ArgumentError):
        sim.spawn(BALL, ["a", "b"], [1, 2, 3])
    assert sim.state_hash == before and len(cars.pose) == 16


def test_simulations_of_a_batch_keep_their_world():
    batch = roboss.Batch(roboss.example("crossroads.sdf"), 2)
    with pytest.raises(roboss.StateError) as error:
        batch[0].spawn(BALL)
    assert error.value.code == "in-batch"


def test_reset_puts_them_where_they_came(sim):
    ball = sim.spawn(BALL, "ball", FAR[0])
    sim.step(100)
    sim.reset()
    assert sim.tick == 0 and np.array_equal(ball.pose, FAR[:1])


def test_a_thousand_times_leaves_the_memory_where_it_was():
    import resource

    sim = roboss.Simulation(roboss.example("pile.sdf"), threads=1)

    def come_and_go(times):
        for _ in range(times):
            sim.spawn(BALL, "ball", FAR[0])
            sim.step()
            sim.remove("ball")
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    first = come_and_go(100)
    assert come_and_go(300) < first + 20_000                # kB
