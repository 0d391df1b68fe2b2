"""Branches of simulations and environments, and training that is killed and resumed: all continue with the same bits."""
import copy
import pickle
import signal
import subprocess
import sys

import gymnasium
import numpy as np
import pytest

import roboss
from roboss import envs
from test_errors import refused

WORLD = roboss.example("crossroads.sdf")
VECTORS = {
    "city": lambda **o: envs.CityVectorEnv(num_envs=6, threads=2, **o),
    "two_cities": lambda **o: envs.CityVectorEnv(num_envs=6, worlds=2, threads=2, **o),
    "soccer": lambda **o: envs.SoccerVectorEnv(num_envs=2, cars=1, threads=2, match_s=1.5, **o),
    "warehouse": lambda **o: envs.WarehouseVectorEnv(num_envs=3, threads=2, **o)}
SINGLES = {
    "city": lambda: envs.CityEnv(traffic=3, threads=2, episode_s=2.5),
    "soccer": lambda: envs.SoccerEnv(cars=2, threads=2, match_s=2.5),
    "warehouse": lambda: envs.WarehouseEnv(others=2, threads=2, episode_s=2.5),
    "alone": lambda: envs.CityEnv(traffic=0, episode_s=2.5)}
COPIED = pytest.mark.parametrize("copied", [copy.deepcopy, lambda thing: pickle.loads(pickle.dumps(thing))],
                                 ids=["deepcopy", "pickle"])


def after(sim, ticks=73):
    """The hash after some ticks, and what a sensor reads that has noise and is due at other times than ticks."""
    sim.step(ticks)
    return sim.state_hash, sim.robots("car_*")["gps"].read().tolist(), sim.robots("car_*")["laser"].read().tolist()


def fast(env, rng):
    """Actions at high speed, so that cars collide and start again."""
    return rng.uniform([0.9, -0.3], [1, 0.3], env.action_space.shape)


def same(one, other):
    """Checks that two results of step() agree to the last bit, infos included."""
    np.testing.assert_equal(plain(one), plain(other))


def plain(value):
    """A form that numpy compares, also of arrays of arrays."""
    if isinstance(value, dict):
        return {name: plain(inner) for name, inner in value.items()}
    is_nested = isinstance(value, tuple) or (isinstance(value, np.ndarray) and value.dtype == object)
    return [plain(inner) for inner in value] if is_nested else value


def begun(make, steps, seed=1, **options):
    """A vector environment amid its episodes."""
    env, rng = make(**options), np.random.default_rng(seed)
    env.reset(seed=seed)
    for _ in range(steps):
        env.step(fast(env, rng))
    return env


def rows(result, copy_number, count):
    """The part of one copy of `count` agents in a result of step() of branches."""
    mine = slice(copy_number * count, (copy_number + 1) * count)

    def of(values):
        return {name: of(inner) for name, inner in values.items()} if isinstance(values, dict) else values[mine]

    return tuple(of(values) for values in result)


def test_branches_of_a_simulation_go_on_with_its_bits(sim):
    branches = sim.branch(3)
    of_branches = branches.branch(2)
    assert (len(branches), len(of_branches), branches.threads, sim.branch(1, threads=1).threads) == (3, 6, 2, 1)
    assert {one.state_hash for one in of_branches} == {sim.state_hash}
    last = after(sim)
    assert all(after(one) == last for one in [*branches, *of_branches])


def test_branches_that_get_other_orders_leave_the_original_as_it_was(sim):
    before = sim.save()
    branches = sim.branch(2)
    branches[1].robots("car_*").set_joint_targets(1.0)
    branches.step(50)
    assert len({one.state_hash for one in branches}) == 2 and sim.tick == before.tick
    last = after(sim, 50)
    sim.restore(before)
    assert after(sim, 50) == last and branches[0].state_hash == last[0]


def test_branches_of_a_world_whose_robots_changed(sim):
    sim.remove("car_3")
    branches = sim.branch(2)
    assert branches.world.robots == sim.world.robots
    last = after(sim)
    assert after(branches[1]) == last


@COPIED
def test_a_part_of_a_batch_has_its_simulations(sim, copied):
    batch = roboss.Batch(WORLD, 4, threads=2, seed=5)
    part = batch[1:3]
    assert part.step(10).tolist() == [False, False] and [one.tick for one in batch] == [0, 10, 10, 0]
    assert part[0].state_hash == batch[1].state_hash and part.robots("car_*").pose.shape == (2, 16, 7)
    again, whole = copied((part, batch))
    again.step(10)
    assert [one.tick for one in whole] == [0, 20, 20, 0] and [one.tick for one in batch] == [0, 10, 10, 0]
    part[-1:].reset()
    assert [one.tick for one in batch] == [0, 10, 0, 0]
    with pytest.raises(roboss.ArgumentError) as error:
        batch[3:1]
    refused(error, "no-simulation", "4")


@pytest.mark.parametrize("mode", ["NextStep", "SameStep"])
@pytest.mark.parametrize("name", VECTORS)
def test_a_branch_that_gets_the_actions_of_a_vector_environment_has_its_bits(name, mode):
    env = begun(VECTORS[name], 10, autoreset_mode=mode)
    branches = env.branch(3)
    assert branches.state_hashes == 3 * env.state_hashes and branches.observation_space.shape[0] == 3 * env.num_envs
    rng, ended = np.random.default_rng(2), 0
    for _ in range(70):
        actions, others = fast(env, rng), rng.uniform(-1, 1, env.action_space.shape)
        result, of_all = env.step(actions), branches.step(np.concatenate([actions, others, actions]))
        ended += (result[2] | result[3]).sum()
        for number in (0, 2):
            mine = rows(of_all, number, env.num_envs)
            same(mine[:4], result[:4])
            same({key: values for key, values in mine[4].items() if key in result[4]}, result[4])
    count = len(env.state_hashes)
    hashes = branches.state_hashes
    assert hashes[:count] == hashes[2 * count:] == env.state_hashes and hashes[count] != hashes[0]
    assert ended > 0 or name == "warehouse"  # episodes that end draw random numbers


def test_a_branch_after_partial_resets_has_its_bits():
    env = begun(VECTORS["two_cities"], 0, autoreset_mode="Disabled")
    rng = np.random.default_rng(4)
    while env.task.present.all():
        env.step(fast(env, rng))
    out = ~env.task.present
    amid = env.branch(2)  # some are out
    env.reset(options={"reset_mask": out})
    amid.reset(options={"reset_mask": np.tile(out, 2)})
    late = env.branch(1)
    for _ in range(30):
        actions = fast(env, rng)
        result = env.step(actions)
        same(rows(amid.step(np.tile(actions, (2, 1))), 1, 6), result)
        same(late.step(actions), result)
    assert amid.state_hashes == 2 * env.state_hashes and late.state_hashes == env.state_hashes
    assert (env.reset()[0] == late.reset()[0]).all() and late.state_hashes == env.state_hashes  # same random numbers
    assert (amid.reset(seed=9)[0] == np.tile(env.reset(seed=9)[0], (2, 1))).all()


@COPIED
def test_branches_of_branches_and_their_copies_have_its_bits(copied):
    env = begun(VECTORS["two_cities"], 10)
    branches = env.branch(2)
    twigs = branches.branch(2).branch(1)
    assert twigs.num_envs == 24 and len(twigs.task.parts) == 4 and twigs.task.parts[3].worlds == 2
    again = copied(twigs)
    rng = np.random.default_rng(2)
    for _ in range(30):
        actions = fast(env, rng)
        result = env.step(actions)
        for one in (branches, twigs, again):
            copies = one.num_envs // env.num_envs
            same(rows(one.step(np.tile(actions, (copies, 1))), copies - 1, 6), result)
    assert twigs.state_hashes == again.state_hashes == 4 * env.state_hashes
    assert again.task.present.base is None and again.task.parts[1].present.base is again.task.present


@pytest.mark.parametrize("name", SINGLES)
def test_a_branch_of_a_single_agent_has_its_bits_to_the_end_of_the_episode(name):
    env, rng = SINGLES[name](), np.random.default_rng(5)
    env.reset(seed=5)
    for _ in range(5):
        env.step(rng.uniform(-1, 1, 2) * 0.3)
    branches = env.branch(3).branch(1)
    assert branches.num_envs == 3 and branches.single_observation_space == env.observation_space
    for _ in range(150):
        action = np.array([1.0, rng.uniform(-0.2, 0.2)])
        observation, reward, terminated, truncated, info = env.step(action)
        observations, rewards, over, cut, infos = branches.step(np.stack([action, -action, action]))
        for number in (0, 2):
            mine = observations[number], rewards[number], over[number], cut[number]
            same(mine, (observation, reward, terminated, truncated))
            assert all(infos[key][number] == value for key, value in info.items())
        assert branches.state_hashes[0] == branches.state_hashes[2]
        if terminated or truncated:
            break
        assert branches.state_hashes[0] == env.state_hash != branches.state_hashes[1]
    assert terminated or truncated
    with pytest.raises(roboss.StateError) as error:
        env.branch(2)
    refused(error, "not-reset", "reset()")
    _, rewards, over, *_ = branches.step(np.ones((3, 2)))
    assert rewards[0] == 0 and not over[0]  # it is out
    branches.reset(options={"reset_mask": np.array([True, False, False])})
    assert branches.step(np.ones((3, 2)))[4]["present"][0]
    same(branches.reset(seed=3)[0], np.tile(env.reset(seed=3)[0], (3, 1)))


def test_branches_of_a_parallel_environment_go_on_with_its_bits():
    env, rng = envs.CityParallelEnv(cars=6, threads=2), np.random.default_rng(1)
    env.reset(seed=2)
    branches = env.branch(2) + env.branch(1)[0].branch(1)
    assert len(branches) == 3 and len({id(one.task) for one in branches}) == 3
    for _ in range(60):
        actions = {agent: np.array([1, rng.uniform(-1, 1)], dtype=np.float32) for agent in env.agents}
        result = env.step(actions)
        for one in branches:
            same(one.step(actions), result)
        assert {one.state_hash for one in branches} == {env.state_hash}
    assert len(env.agents) < 6


def test_a_driver_with_a_memory_is_branched_along():
    class Swerve:
        """Drives in wider and wider turns."""

        steps = 0

        def __call__(self, observations):
            self.steps += 1
            return np.tile([0.5, 0.02 * self.steps], (len(observations), 1))

    driver = Swerve()
    env = envs.TaskEnv(envs.CityTask(4, threads=1), driver)
    env.reset(seed=1)
    env.step(np.zeros(2))
    branches = env.branch(2)
    for _ in range(10):
        branches.step(np.zeros((2, 2)))
    assert driver.steps == 1
    for _ in range(10):
        env.step(np.zeros(2))
    assert branches.state_hashes == 2 * (env.state_hash,)


def test_others_that_finish_start_again_in_all_branches():
    env = envs.TaskEnv(envs.CityTask(10, threads=2), lambda observations: np.tile([1.0, 0.3], (len(observations), 1)))
    env.reset(seed=1)
    branches, again = env.branch(2), 0
    for _ in range(60):
        before = env.task.age.copy()
        result = env.step(np.zeros(2))
        same(branches.step(np.zeros((2, 2)))[0][1], result[0])
        again += np.count_nonzero(env.task.age < before)
        assert env.task.present[1:].all()
        if result[2]:
            break
    assert again > 0 and branches.state_hashes[0] == branches.state_hashes[1]


def test_an_environment_that_shows_itself_has_copies():
    env = gymnasium.make("roboss/City-v0", traffic=1, render_mode="human").unwrapped
    env.reset(seed=1)
    env._picture._view = env.task.simulation.view()
    try:
        twin, branches = pickle.loads(pickle.dumps(env)), env.branch(2)
        assert twin.state_hash == env.state_hash and branches.render() is None
    finally:
        env.close()
    frames = begun(VECTORS["city"], 0, render_mode="rgb_array").branch(2).render()
    assert len(frames) == 12 and np.array_equal(frames[0], frames[6]) and frames[0].std() > 10


@pytest.mark.parametrize("make", [VECTORS["city"], SINGLES["city"], lambda: envs.CityParallelEnv(cars=2)],
                         ids=["vector", "single", "parallel"])
def test_branches_that_cannot_be_are_refused(make):
    env = make()
    with pytest.raises(roboss.StateError) as error:
        env.branch(2)
    refused(error, "not-reset", "reset()")
    env.reset(seed=1)
    before = env.task.state_hashes
    for count, code in ((0, "bad-value"), (-3, "bad-value"), (1.5, "bad-type"), (True, "bad-type")):
        with pytest.raises(roboss.ArgumentError) as error:
            env.branch(count)
        refused(error, code)
    assert env.task.state_hashes == before
    here, env.task.simulation = env.task.simulation, object.__new__(roboss.RemoteSimulation)
    if hasattr(env, "_agent"):
        env._agent.simulation = env.task.simulation
    with pytest.raises(roboss.StateError) as error:
        env.branch(2)
    refused(error, "remote", "RemoteSimulation", "this process")
    env.task.simulation = here
    if hasattr(env, "_agent"):
        env._agent.simulation = here
    env.task.log = open(__file__)  # has no copy
    with env.task.log, pytest.raises(roboss.StateError) as error:
        env.branch(2)
    refused(error, "no-copy", "__deepcopy__")
    del env.task.log
    env.close()
    with pytest.raises(roboss.StateError) as error:
        env.branch(2)
    refused(error, "closed", "close()")


def test_simulations_that_have_no_branches_say_so(sim):
    for count in (0, 2.0):
        with pytest.raises(roboss.ArgumentError):
            sim.branch(count)
    remote = object.__new__(roboss.RemoteSimulation)
    for call in (lambda: remote.branch(2), lambda: pickle.dumps(remote), lambda: copy.deepcopy(remote)):
        with pytest.raises(roboss.StateError) as error:
            call()
        refused(error, "remote")


def test_a_recording_that_goes_on_elsewhere_has_no_branches(branched):
    replay = roboss.Journal(branched).at(0.1, follow=False)
    assert len(replay.branch(2)) == 2
    with pytest.raises(roboss.StateError) as error:
        roboss.Journal(branched).at(0.1).branch(2)
    refused(error, "recording")


TRAINING = """
import os, pickle, sys
import numpy as np
import roboss.envs
file, end = sys.argv[1], int(sys.argv[2])
if os.path.exists(file):
    with open(file, "rb") as stream:
        env, rng, step = pickle.load(stream)
else:
    env = roboss.envs.CityVectorEnv(num_envs=8, worlds=2, autoreset_mode="SameStep", threads=2)
    rng, step = np.random.default_rng(7), 0
    env.reset(seed=1)
while step < end:
    observations, rewards, *_ = env.step(rng.uniform([0.9, -0.3], [1, 0.3], (8, 2)))
    step += 1
    print(step, *env.state_hashes, repr(observations.sum(dtype=float)), repr(rewards.sum()), flush=True)
    if step % 10 == 0:
        with open(file + ".new", "wb") as stream:
            pickle.dump((env, rng, step), stream)
        os.replace(file + ".new", file)
"""


def test_training_that_is_killed_goes_on_with_the_same_bits(tmp_path):
    def train(file, end, kill_after=None):
        command = [sys.executable, "-P", "-B", "-c", TRAINING, str(tmp_path / file), str(end)]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
            lines = []
            for line in process.stdout:
                lines.append(line)
                if len(lines) == kill_after:
                    process.kill()
                    break
        assert process.returncode == (0 if kill_after is None else -signal.SIGKILL)
        return lines

    whole = train("whole.pickle", 60)
    first = train("killed.pickle", 1000, kill_after=25)  # it runs to step 20, or to 30, where it was saved last
    second = train("killed.pickle", 1000, kill_after=17)
    last = train("killed.pickle", 60)
    assert len(whole) == 60 and first == whole[:25]
    for lines in (second, last):
        begin = int(lines[0].split()[0])
        assert begin % 10 == 1 and begin > 20 and lines == whole[begin - 1:begin - 1 + len(lines)]
    assert last[-1] == whole[-1] and int(last[0].split()[0]) > int(second[0].split()[0])
