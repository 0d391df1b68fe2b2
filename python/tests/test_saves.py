"""States and worlds on disk and in pickles: what is continued has the same bits, in this package and by the command."""
import copy
import json
import pickle
import subprocess

import numpy as np
import pytest

import roboss
import roboss.envs
from conftest import REPOSITORY, ROBOSS
from roboss import _core, pickling
from test_errors import refused
from test_spawn import BALL, FAR

WORLD = REPOSITORY / "worlds/crossroads.sdf"


def command(*arguments):
    """The JSON summary of `roboss run` of the world."""
    words = [ROBOSS, "run", WORLD, *arguments, "--headless", "--json", "-"]
    return json.loads(subprocess.run([str(word) for word in words], capture_output=True, text=True, check=True).stdout)


def after(sim, ticks=150):
    """The hash after an order that follows those that wait, and some ticks."""
    sim.robots("car_12").set_joint_targets(2.0)
    sim.step(ticks)
    return sim.state_hash


def test_a_file_continues_with_the_same_bits(sim, tmp_path):
    save = sim.save(tmp_path / "run.save")
    assert (save.tick, save.seed) == (200, 3)
    again = roboss.Simulation.load(tmp_path / "run.save", threads=1)
    with_world = roboss.Simulation.load(tmp_path / "run.save", sim.world)
    assert (again.tick, again.seed, again.state_hash, again.threads) == (200, 3, sim.state_hash, 1)
    assert again.world.hash == sim.world.hash and with_world.world is sim.world
    last = after(sim)
    assert after(again) == last and after(with_world) == last


def test_the_command_continues_a_file_of_the_package(sim, tmp_path):
    sim.save(tmp_path / "run.save")
    sim.step(150)
    summary = command("--from", tmp_path / "run.save", "--duration", 0.3)
    assert summary["state_hash"] == sim.state_hash


def test_the_package_continues_a_file_of_the_command(tmp_path):
    orders = ["--orders", REPOSITORY / "worlds/crossroads.jsonl"]
    command(*orders, "--duration", 0.5, "--seed", 5, "--save", tmp_path / "run.save")
    sim = roboss.Simulation.load(tmp_path / "run.save")
    assert sim.time == pytest.approx(0.5) and sim.seed == 5
    sim.step(250)
    assert sim.state_hash == command("--from", tmp_path / "run.save", "--duration", 0.5)["state_hash"]


def test_a_file_of_a_world_whose_robots_changed_is_continued_by_the_command(sim, tmp_path):
    sim.spawn(BALL, ["a", "b", "c"], FAR)
    sim.remove("car_3")
    sim.save(tmp_path / "run.save")
    again = roboss.Simulation.load(tmp_path / "run.save")
    assert again.world.robots == sim.world.robots and "a" in again.world.robots
    sim.step(100), again.step(100)
    assert again.state_hash == sim.state_hash
    assert command("--from", tmp_path / "run.save", "--duration", 0.2)["state_hash"] == sim.state_hash
    again.save(tmp_path / "run.save")  # its world file is still known
    again.step(50)
    assert command("--from", tmp_path / "run.save", "--duration", 0.1)["state_hash"] == again.state_hash


def test_a_save_replaces_only_saves(sim, tmp_path):
    notes = tmp_path / "notes.save"
    notes.write_text("remember")
    with pytest.raises(roboss.ArgumentError) as error:
        sim.save(notes)
    refused(error, "other-kind", "notes.save")
    assert notes.read_text() == "remember"
    link = tmp_path / "link.save"
    link.symlink_to(WORLD)
    with pytest.raises(roboss.ArgumentError) as error:
        sim.save(link)
    refused(error, "output-is-input", "link.save")
    journal = tmp_path / "run.journal"
    command("--duration", 0.1, "--journal", journal)
    before = journal.read_bytes()
    with pytest.raises(roboss.ArgumentError) as error:
        sim.save(journal)
    refused(error, "not-a-saved-run", "run.journal")
    assert journal.read_bytes() == before
    with pytest.raises(roboss.SaveError):
        sim.save(tmp_path / "no" / "folder.save")
    sim.save(tmp_path / "run.save"), sim.step(10), sim.save(tmp_path / "run.save")
    assert roboss.Simulation.load(tmp_path / "run.save").tick == 210


def test_files_that_cannot_be_loaded(sim, tmp_path):
    sim.save(tmp_path / "run.save")
    with pytest.raises(roboss.SaveError) as error:
        roboss.Simulation.load(tmp_path / "run.save", roboss.load(roboss.example("pile.sdf")))
    refused(error, "other-world", "run.save", "pile")
    with pytest.raises(roboss.ArgumentError):
        roboss.Simulation.load(tmp_path / "run.save", "crossroads.sdf")
    damaged = bytearray((tmp_path / "run.save").read_bytes())
    for place in range(0, len(damaged), 997):
        damaged[place] ^= 0x55
    (tmp_path / "damaged.save").write_bytes(damaged)
    (tmp_path / "text.save").write_text("no save")
    for name in ("damaged.save", "text.save", "missing.save"):
        with pytest.raises(roboss.JournalError, match=name):
            roboss.Simulation.load(tmp_path / name)


@pytest.mark.parametrize("copied", [copy.deepcopy, lambda thing: pickle.loads(pickle.dumps(thing))], ids=["deepcopy", "pickle"])
def test_copies_of_simulations_go_on_with_the_same_bits(sim, copied):
    cars = sim.robots("car_*")
    again, its_cars, save = copied((sim, cars, sim.save()))
    assert its_cars.simulation is again and its_cars.names == cars.names
    last = after(sim)
    assert after(again) == last and np.array_equal(its_cars.pose, cars.pose)
    again.restore(save)
    assert again.tick == 200 and after(again) == last
    sim.restore(save)
    assert after(sim) == last


def test_copies_share_nothing_that_changes(sim):
    again = copy.deepcopy(sim)
    assert again.world is sim.world and again is not sim
    again.step(10)
    assert (sim.tick, again.tick) == (200, 210)


def test_a_pickled_world_is_the_world(tmp_path):
    world = roboss.load(WORLD)
    again = pickle.loads(pickle.dumps(world))
    assert (again.hash, again.robots, again.dt, again.file) == (world.hash, world.robots, world.dt, world.file)
    assert [str(finding) for finding in again.diagnostics] == [str(finding) for finding in world.diagnostics]
    pictures = [roboss.Simulation(one).camera([12, -12, 8], [0, 0, 0], size=(40, 30)).picture() for one in (world, again)]
    assert np.array_equal(*pictures) and pictures[0].std() > 5
    assert copy.copy(world) is world and copy.deepcopy(world) is world


def test_a_pickled_world_does_not_need_its_file(tmp_path):
    file = tmp_path / "world.sdf"
    file.write_text(f'<sdf version="1.9"><world name="w">{BALL.split("1.9")[1][2:-6]}</world></sdf>')
    world = roboss.load(file)
    data = pickle.dumps(world)
    file.unlink()
    again = pickle.loads(data)
    sims = [roboss.Simulation(one) for one in (world, again)]
    for one in sims:
        one.step(20)
    assert sims[0].state_hash == sims[1].state_hash


def test_damaged_bytes_of_a_pickle_are_errors(sim):
    model, tick, seed, given, states, orders, check = sim.save().parts()
    def damaged(data):
        return data[:len(data) // 2] + bytes([data[len(data) // 2] ^ 0xFF]) + data[len(data) // 2 + 1:]
    with pytest.raises(roboss.WorldError):
        pickling.model_of(damaged(_core.model_bytes(model)))
    for parts in ((damaged(states), orders), (states, damaged(orders)), (states[:-3], orders)):
        with pytest.raises(roboss.SaveError) as error:
            pickling.save_of(model, tick, seed, given, *parts, check)
        refused(error, "damaged")


def test_stale_sets_of_robots_have_no_copy(sim):
    cars = sim.robots("car_*")
    sim.remove("car_3")
    with pytest.raises(roboss.StateError) as error:
        pickle.dumps(cars)
    refused(error, "changed-world")


def test_a_batch_goes_on_with_the_same_bits():
    batch = roboss.Batch(WORLD, 3, threads=2, seed=4)
    cars = batch.robots("car_*")
    cars.set_joint_targets(np.arange(3.0)[:, None, None])
    batch.step(50)
    again, its_cars, second = pickle.loads(pickle.dumps((batch, cars, batch[1])))
    assert its_cars.simulation is again and [sim.seed for sim in again] == [4, 5, 6]
    batch.step(50), again.step(50)
    assert [sim.state_hash for sim in again] == [sim.state_hash for sim in batch]
    assert second.state_hash == batch[1].state_hash and np.array_equal(its_cars.pose, cars.pose)


@pytest.mark.parametrize("make", [
    lambda: roboss.envs.CityVectorEnv(num_envs=8, worlds=2, autoreset_mode="SameStep"),
    lambda: roboss.envs.SoccerVectorEnv(num_envs=6),
    lambda: roboss.envs.WarehouseVectorEnv(num_envs=4)], ids=["city", "soccer", "warehouse"])
def test_a_pickled_environment_repeats_what_follows(make):
    env = make()
    env.reset(seed=1)
    env.action_space.seed(2)
    for _ in range(30):
        env.step(env.action_space.sample())
    again = pickle.loads(pickle.dumps(env))
    for _ in range(30):
        actions = env.action_space.sample()
        one, other = env.step(actions), again.step(actions)
        assert all(np.array_equal(mine, its) for mine, its in zip(one[:4], other[:4]))
    assert env.state_hashes == again.state_hashes
