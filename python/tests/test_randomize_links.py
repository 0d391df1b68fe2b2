"""roboss.randomize of links: masses, centres of mass, inertias and surfaces, as Robots.link_parameters has them."""
import numpy as np
import pytest

import roboss
from roboss.randomize import Randomizer, joint, link, normal, uniform

BOXES = """<sdf version="1.9"><world name="boxes"><gravity>0 0 -9.81</gravity>{}</world></sdf>"""
BOX = """<model name="box_{0}"><pose>0 {0} .1 0 0 0</pose><link name="body">
  <inertial><mass>2</mass><inertia><ixx>.02</ixx><iyy>.02</iyy><izz>.02</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>.2 .2 .2</size></box></geometry></collision></link>
  <link name="flag"><pose>0 0 .3 0 0 0</pose>
  <inertial><mass>.1</mass><inertia><ixx>.001</ixx><iyy>.001</iyy><izz>.001</izz></inertia></inertial></link>
  <joint name="pole" type="revolute"><parent>body</parent><child>flag</child>
    <axis><xyz>0 0 1</xyz></axis></joint></model>"""


def boxes(count=4):
    world = roboss.load(BOXES.format("".join(BOX.format(number) for number in range(count))), ground=True)
    return roboss.Simulation(world, threads=1).robots("box_*")


def test_a_payload_is_added_to_the_mass_of_the_file_and_weighs():
    robots = boxes()
    randomizer = Randomizer(robots, [link("mass", uniform(0.5, 3), "add", links="body", name="payload")], seed=1)
    for _ in range(2):
        robots.simulation.reset()
        randomizer.reset()
        payload = randomizer.drawn["payload"][:, 0]
        masses, of_file = robots.link_parameters["mass"], robots.link_parameters.of_file("mass")
        body = robots.links.index("body")
        assert np.array_equal(masses[:, body], of_file[:, body] + payload)
        assert np.array_equal(np.delete(masses, body, axis=1), np.delete(of_file, body, axis=1))
        robots.simulation.step(1000)
        contacts = robots.simulation.contacts
        carried = [contacts["force"][contacts["robot_a"] == number, 2].sum() for number in robots.ids]
        assert np.allclose(carried, 9.81 * (2.1 + payload), rtol=1e-3)
    assert randomizer.columns("payload") == ("body",) and randomizer.units("payload") == ("kg",)


def test_friction_is_that_of_links_with_shapes_and_slows_a_box_as_coulomb_says():
    robots = boxes()
    randomizer = Randomizer(robots, [link("friction", uniform(0.2, 0.6))], seed=2)
    randomizer.reset()
    own, body, flag = robots.link_parameters, robots.links.index("body"), robots.links.index("flag")
    friction = randomizer.drawn["link_friction"][:, body]
    assert np.array_equal(own["friction"][:, body], friction)
    assert np.isnan(own["friction"][:, flag]).all() and np.isfinite(randomizer.drawn["link_friction"]).all()
    own["friction_across"] = own["friction"]
    robots.twist = [1, 0, 0, 0, 0, 0]
    robots.simulation.step(round(0.1 / robots.simulation.dt))
    assert np.allclose(robots.twist[:, 0], 1 - 9.81 * 0.1 * friction, atol=1e-3)
    shared = Randomizer(robots, [link("friction", uniform(0.2, 0.6), shared=True)], seed=3)
    shared.reset()
    drawn = shared.drawn["link_friction"]
    assert (drawn == drawn[:, :1]).all() and np.array_equal(own["friction"][:, body], drawn[:, body])


def test_links_and_joints_in_one_list_and_nothing_changes_if_one_is_refused():
    robots = boxes()
    terms = [joint("damping", uniform(0, 0.01)), link("mass", uniform(0.8, 1.2), "scale"),
             link("centre_x", normal(0, 0.005), "add")]
    randomizer = Randomizer(robots, terms, seed=4)
    randomizer.reset()
    own = robots.link_parameters
    assert np.allclose(own["mass"], own.of_file("mass") * randomizer.drawn["link_mass"], rtol=1e-12)
    assert np.allclose(own["centre_x"], own.of_file("centre_x") + randomizer.drawn["link_centre_x"], atol=1e-15)
    assert np.array_equal(robots.parameters["damping"], randomizer.drawn["joint_damping"])
    before = robots.simulation.state_hash
    refused = Randomizer(robots, [*terms, link("mass", uniform(-9, -8), "add", name="less")])
    with pytest.raises(roboss.OrderError):
        refused.reset()
    assert robots.simulation.state_hash == before and not refused.begun


def test_numbers_that_no_term_is_about_stay():
    robots = boxes()
    own = robots.link_parameters
    own.set("body", centre_z=0.03)
    terms = [link("mass", uniform(2, 3), "scale", links="body"),
             link("inertia_xx", uniform(1, 2), "scale", links="flag")]
    randomizer = Randomizer(robots, terms, seed=5)
    randomizer.reset()
    body, flag = robots.links.index("body"), robots.links.index("flag")
    factor, of_flag = randomizer.drawn["link_mass"][:, 0], randomizer.drawn["link_inertia_xx"][:, 0]
    assert (own["centre_z"][:, body] == 0.03).all()
    assert np.array_equal(own["mass"][:, flag], own.of_file("mass")[:, flag])
    for name in ("inertia_xx", "inertia_yy", "inertia_zz"):                              # in proportion to the mass
        assert np.allclose(own[name][:, body], own.of_file(name)[:, body] * factor, rtol=1e-12)
    assert np.allclose(own["inertia_xx"][:, flag], own.of_file("inertia_xx")[:, flag] * of_flag)


def test_unknown_numbers_and_links_are_refused():
    robots = boxes()
    for term in (link("weight", uniform(0, 1)), link("mass", uniform(0, 1), links="mast")):
        with pytest.raises(roboss.UnknownNameError):
            Randomizer(robots, [term])


def test_of_a_batch_each_simulation_has_its_own_and_the_seed_repeats_them():
    world, hashes = boxes().simulation.world, []
    for seed in (1, 1, 2):
        batch = roboss.Batch(world, 3, threads=1)
        robots = batch.robots("box_*")
        randomizer = Randomizer(robots, [link("mass", uniform(1, 3)), link("friction", uniform(0.2, 1))], seed=seed)
        randomizer.reset()
        randomizer.reset(np.array([True, False, True]))
        batch.step(50)
        assert np.array_equal(robots.link_parameters["mass"], randomizer.drawn["link_mass"])
        hashes.append([sim.state_hash for sim in batch])
    assert hashes[0] == hashes[1] and not set(hashes[0]) & set(hashes[2]) and len(set(hashes[0])) == 3
