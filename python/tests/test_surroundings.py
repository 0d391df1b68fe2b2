"""Robots.surroundings: own gravity and wind as arrays, against closed forms; what is refused changes nothing."""
import numpy as np
import pytest

import roboss
from roboss.randomize import Randomizer, surroundings, uniform

BALLS = """<sdf version="1.9"><world name="balls"><physics type="ode"><max_step_size>.001</max_step_size></physics>
<gravity>0 0 {}</gravity>{}</world></sdf>"""
BALL = """<model name="ball_{0}"><pose>0 {0} 100 0 0 0</pose><link name="body"><inertial><mass>2</mass>
  <inertia><ixx>.02</ixx><iyy>.02</iyy><izz>.02</izz></inertia></inertial>
  <collision name="c"><geometry><sphere><radius>.1</radius></sphere></geometry></collision></link></model>"""


def world(gravity=-9.81, count=4):
    return roboss.load(BALLS.format(gravity, "".join(BALL.format(number) for number in range(count))))


def balls(gravity=-9.81, count=4):
    return roboss.Simulation(world(gravity, count), threads=1).robots("ball_*")


def test_they_are_those_of_the_file_at_first():
    robots = balls()
    own = robots.surroundings
    assert own.names == ("gravity", "wind") and own.units("gravity") == ("m/s^2",) * 3 and own.units("wind")[0] == "m/s"
    for values in (own["gravity"], own.of_file("gravity")):
        assert np.array_equal(values, np.tile([0, 0, -9.81], (4, 1)))
    assert np.array_equal(own["wind"], np.zeros((4, 3)))


def test_a_ball_falls_with_its_own_gravity_from_the_moment_on():
    robots = balls()
    robots.simulation.step(400)
    gravity = np.array([[0, 0, -9.81], [0, 0, -1.62], [0.5, 0, 0], [0, 0, 2]])
    robots.surroundings["gravity"] = gravity
    assert np.array_equal(robots.surroundings["gravity"], gravity)
    robots.simulation.step(600)
    fallen = 100 - 9.81 * (0.08 + 0.4 * 0.6) + gravity[:, 2] * 0.18
    assert np.allclose(robots.pose[:, 2], fallen, rtol=0, atol=1e-10)
    assert np.allclose(robots.pose[:, 0], gravity[:, 0] * 0.18, rtol=0, atol=1e-10)
    weight = 2 * gravity[:, 2] * robots.pose[:, 2] + 2 * gravity[:, 0] * robots.pose[:, 0]
    assert np.allclose(robots.energy[:, 1], -weight)


def test_what_is_given_back_leaves_no_trace():
    robots = balls()
    before = robots.simulation.state_hash
    robots.surroundings.set(gravity=[0, 0, -1.62], wind=[1, 2, 3])
    robots[1].surroundings.set("z", gravity=-3.71)
    assert np.array_equal(robots.surroundings["gravity"][:2], [[0, 0, -1.62], [0, 0, -3.71]])
    assert robots.simulation.state_hash != before
    robots.surroundings.reset(["x", "y"])
    assert np.array_equal(robots.surroundings["wind"], np.tile([0, 0, 3], (4, 1)))
    robots.surroundings.reset()
    assert robots.simulation.state_hash == before
    robots.surroundings.reset("x")  # none has any of its own
    assert robots.simulation.state_hash == before
    robots.surroundings["gravity"] = [0, 0, -1.62]
    robots.surroundings["gravity"] = robots.simulation.world.gravity
    assert robots.simulation.state_hash == before


def test_a_run_is_that_of_a_file_with_this_gravity():
    ordered, written = balls(), balls(gravity=-1.62)
    ordered.surroundings["gravity"] = [0, 0, -1.62]
    for robots in (ordered, written):
        robots.twist = [1, 0, 0, 0.3, 2, 0.1]
        robots.simulation.step(500)
    assert np.array_equal(ordered.pose, written.pose) and np.array_equal(ordered.twist, written.twist)


def test_saves_resets_and_batches():
    batch, sim = roboss.Batch(world(), 3, threads=2), balls().simulation
    robots, alone = batch.robots("ball_*"), sim.robots("ball_*")
    robots.surroundings["gravity"] = np.array([[0, 0, -1], [0, 0, -2], [0, 0, -3]])[:, None, :]
    assert robots.surroundings["gravity"].shape == (3, 4, 3)
    alone.surroundings["gravity"] = [0, 0, -2]
    batch.step(100), sim.step(100)
    assert batch[1].state_hash == sim.state_hash and batch[2].state_hash != sim.state_hash
    save = sim.save()
    sim.reset()
    assert np.array_equal(alone.surroundings["gravity"], alone.surroundings.of_file("gravity"))
    sim.restore(save)
    assert sim.state_hash == batch[1].state_hash
    assert np.array_equal(alone.surroundings["gravity"], np.tile([0, 0, -2], (4, 1)))


def test_they_stay_where_robots_come_and_go():
    sim = balls().simulation
    sim.robots("ball_1").surroundings["gravity"] = [0, 0, -5]
    sim.remove("ball_0")
    assert np.array_equal(sim.robots("ball_1").surroundings["gravity"], [[0, 0, -5]])
    sim.step(100)
    assert sim.robots("ball_1").twist[0, 2] == pytest.approx(-0.5, abs=1e-12)
    assert sim.robots("ball_2").twist[0, 2] == pytest.approx(-0.981, abs=1e-12)


@pytest.mark.parametrize("name, value, code", [
    ("gravity", np.nan, "not-finite"), ("gravity", -1001, "beyond-limit"), ("wind", np.inf, "not-finite"),
    ("wind", 1e4, "beyond-limit")])
def test_what_no_robot_can_have_is_refused(name, value, code):
    robots = balls()
    values = robots.surroundings.of_file(name) + 0.5
    values[3, 1] = value
    before = robots.simulation.state_hash
    with pytest.raises(roboss.OrderError, match="ball_3") as refused:
        robots.surroundings[name] = values
    assert refused.value.code == code and robots.simulation.state_hash == before


def test_wrong_names_and_shapes():
    own = balls().surroundings
    with pytest.raises(roboss.UnknownNameError, match="did you mean 'gravity'"):
        own["gravitiy"]
    with pytest.raises(roboss.UnknownNameError, match="component"):
        own.set("w", gravity=1)
    for wrong in (lambda: own.set(gravity=-9.81), lambda: own.__setitem__("wind", 3)):
        with pytest.raises(roboss.ArgumentError) as refused:
            wrong()
        assert refused.value.code == "bad-shape"
    with pytest.raises(roboss.ArgumentError):
        own["gravity"] = np.ones((3, 3))
    with pytest.raises(roboss.ArgumentError, match="no parameter"):
        own.set()


def test_they_are_drawn_for_each_episode():
    robots = balls()
    own = robots.surroundings
    own["wind"] = [7, 0, 0]
    terms = [surroundings("gravity", uniform(0.5, 1.5), "scale", shared=True),
             surroundings("wind", uniform(-3, 3), components="y", name="gust")]
    randomizer = Randomizer(robots, terms, seed=1)
    randomizer.reset()
    factor, gust = randomizer.drawn["gravity"], randomizer.drawn["gust"]
    assert randomizer.columns("gust") == ("y",) and randomizer.units("gust") == ("m/s",)
    assert len(set(factor[:, 2])) == 4 and (factor >= 0.5).all() and (factor <= 1.5).all()
    assert np.allclose(own["gravity"], factor * [0, 0, -9.81])
    assert np.array_equal(own["wind"], np.column_stack([np.full(4, 7.0), gust[:, 0], np.zeros(4)]))
    robots.simulation.step(100)
    assert np.allclose(robots.twist[:, 2], own["gravity"][:, 2] * 0.1, rtol=0, atol=1e-12)
    with pytest.raises(roboss.UnknownNameError):
        Randomizer(robots, [surroundings("gravity", uniform(0, 1), components="w")], seed=1).reset()
