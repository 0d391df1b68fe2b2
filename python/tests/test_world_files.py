"""World.save: the file loads to the same world, edited or not; what it cannot write it names, and no file is spoilt."""
import pytest

import roboss
from conftest import REPOSITORY
from test_errors import refused
from test_spawn import BALL, FAR

WORLD = REPOSITORY / "worlds/crossroads.sdf"
ROVER = REPOSITORY / "examples/first_robot/rover.urdf"


def reloaded(world, path):
    world.save(path)
    return roboss.load(path)


@pytest.mark.parametrize("name", ["crossroads.sdf", "arm.sdf", "drives.sdf", "pile.sdf", "soccer.sdf"])
def test_a_world_of_a_file_is_the_same_elsewhere(name, tmp_path):
    world = roboss.load(roboss.example(name))
    again = reloaded(world, tmp_path / "copy.sdf")
    assert again.hash == world.hash and again.robots == world.robots


def test_a_world_that_was_built_is_the_text_that_was_built(tmp_path):
    builder = roboss.WorldBuilder("yard")
    builder.ground()
    builder.box("crate", [0.4, 0.4, 0.4], mass=5, pose=[1, 0, 0.2])
    builder.build().save(tmp_path / "yard.sdf")
    assert (tmp_path / "yard.sdf").read_text() == builder.to_sdf()


def test_robots_that_went_are_not_in_the_file(tmp_path):
    sim = roboss.Simulation(WORLD)
    sim.remove("car_1*")
    sim.remove(["car_3"])
    again = reloaded(sim.world, tmp_path / "edited.sdf")
    assert again.hash == sim.world.hash and "car_3" not in again.robots and "car_2" in again.robots


def test_robots_that_came_are_in_the_file_where_they_start(tmp_path):
    sim = roboss.Simulation(WORLD)
    sim.step(30)
    sim.spawn(BALL, ["a", "b", "c"], FAR)
    sim.spawn(roboss.load(roboss.example("arm.sdf"), dt=sim.dt), pose=[20, 0, 0, 0, 0, 0.6, 0.8])
    sim.remove(["b", "car_4"])
    sim.spawn(roboss.load(ROVER, dt=sim.dt), "rover", [-20, 0, 0, 0, 0, 0, 1], on_ground=True)
    again = reloaded(sim.world, tmp_path / "edited.sdf")
    assert again.hash == sim.world.hash
    assert again.robots[-4:] == ("a", "c", "arm", "rover")
    start = roboss.Simulation(again)
    start.step(100)
    sim.reset()
    sim.step(100)
    assert start.state_hash == sim.state_hash


def test_what_cannot_be_written_is_named(tmp_path):
    path = tmp_path / "world.sdf"
    with pytest.raises(roboss.WorldError) as error:
        roboss.load(ROVER, ground=True, on_ground=True).save(path)
    refused(error, "no-text", "SDFormat")
    with pytest.raises(roboss.WorldError) as error:
        roboss.load(WORLD, dt=0.004).save(path)
    refused(error, "other-world", "dt")
    sim = roboss.Simulation(WORLD)
    sim.save(tmp_path / "run.save")
    with pytest.raises(roboss.WorldError) as error:
        roboss.Simulation.load(tmp_path / "run.save").world.save(path)
    refused(error, "no-text")
    assert sorted(file.name for file in tmp_path.iterdir()) == ["run.save"]


def test_a_file_of_the_world_is_not_replaced(tmp_path):
    source = tmp_path / "source.sdf"
    source.write_text(WORLD.read_text())
    before = source.read_bytes()
    sim = roboss.Simulation(roboss.load(source, search_paths=[WORLD.parent / "models"]))
    sim.remove("car_3")
    for path, code in ((source, "output-is-input"), (tmp_path / "notes.txt", "other-kind")):
        (tmp_path / "notes.txt").write_text("remember")
        with pytest.raises(roboss.ArgumentError) as error:
            sim.world.save(path)
        assert error.value.code == code
    assert source.read_bytes() == before
    with pytest.raises(OSError):
        sim.world.save(tmp_path / "no" / "folder.sdf")
    sim.world.save(tmp_path / "edited.sdf"), sim.world.save(tmp_path / "edited.sdf")  # an older one of its kind
