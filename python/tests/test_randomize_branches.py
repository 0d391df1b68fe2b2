"""Branches of environments with `randomize=`: they continue the original's draws, each with a randomizer of its own."""
import dataclasses
import pickle

import numpy as np
import pytest

from roboss import envs, randomize
from test_branches import VECTORS, begun, fast, rows, same

TERMS = [
    randomize.joint("damping", randomize.uniform(0, 0.01)),
    randomize.joint("friction", randomize.uniform(0, 0.01), when=(0.1, 0.4)),
    randomize.joint("max_effort", randomize.uniform(0.8, 1.2), "scale", shared=True, when="start"),
    randomize.link("mass", randomize.uniform(0.9, 1.1), "scale", links="chassis"),
    randomize.kick(randomize.uniform([-0.2, -0.2, 0, 0, 0, -1], [0.2, 0.2, 0, 0, 0, 1]), when=(0.2, 0.8)),
    randomize.noise(randomize.normal(0, 0.02)),
    randomize.noise(randomize.normal(0, 0.01), when="reset", name="bias"),
    randomize.latency(randomize.choice([0, 1, 2])),
    randomize.latency(randomize.choice([0, 1]), when="step", name="jitter"),
]
KICK = [term.name for term in TERMS].index("kick")


def state(task):
    """All that the randomizer of a task has: counts of draws, times, late actions, and what was drawn last."""
    return {**dataclasses.asdict(task.randomizer.save()), "drawn": task.randomizer.drawn}


def agree(branches, numbers, env):
    """Checks that the randomizers of these copies are in the state of the original's."""
    for number in numbers:
        np.testing.assert_equal(state(branches.task.parts[number]), state(env.task))


@pytest.mark.parametrize("mode", ["NextStep", "SameStep", "Disabled"])
@pytest.mark.parametrize("name", ["two_cities", "soccer"])
def test_a_branch_of_a_vector_environment_goes_on_with_its_draws(name, mode):
    env = begun(VECTORS[name], 20, autoreset_mode=mode, randomize=TERMS)
    branches, count = env.branch(3), env.num_envs
    agree(branches, range(3), env)
    rng, ended = np.random.default_rng(2), 0
    for step in range(70):
        out = ~env.task.present
        if mode == "Disabled" and step % 10 == 0 and out.any():
            seen = env.reset(options={"reset_mask": out})[0]
            of_all = branches.reset(options={"reset_mask": np.tile(out, 3)})[0]
            same((of_all[:count], of_all[2 * count:]), (seen, seen))
        actions, others = fast(env, rng), rng.uniform(-1, 1, env.action_space.shape)
        result, of_all = env.step(actions), branches.step(np.concatenate([actions, others, actions]))
        ended += (result[2] | result[3]).sum()
        for number in (0, 2):
            same(rows(of_all, number, count)[:4], result[:4])
        agree(branches, (0, 2), env)
    hashes, worlds = branches.state_hashes, len(env.state_hashes)
    assert hashes[:worlds] == hashes[2 * worlds:] == env.state_hashes and hashes[worlds] != hashes[0]
    draws = env.task.randomizer.save().draws
    assert ended > 0 and draws[0].max() > 0 and draws[KICK].max() > 0 and draws.max() > 70  # all kinds of draws happened
    same(rows(branches.reset()[:1], 2, count), env.reset()[:1])  # further draws of both
    agree(branches, (0, 2), env)
    same(branches.reset(seed=9)[0], np.tile(env.reset(seed=9)[0], (3, 1)))
    agree(branches, range(3), env)
    assert branches.state_hashes == 3 * env.state_hashes


def test_a_branch_of_a_single_agent_goes_on_with_its_draws_and_its_next_episode():
    env, rng = envs.CityEnv(traffic=3, threads=2, episode_s=2.5, randomize=TERMS), np.random.default_rng(5)
    seen = env.reset(seed=5)[0]
    assert (seen == env.task.observations()[0]).all() and (seen != env.task.observe()[0]).any()  # with noise
    for _ in range(5):
        env.step(rng.uniform(-0.3, 0.3, 2))
    branches, ended = env.branch(2).branch(2), 0
    for _ in range(120):
        action = np.array([1.0, rng.uniform(-0.2, 0.2)])
        result, of_all = env.step(action), branches.step(np.stack([action, -action, action, action]))
        for number in (0, 2, 3):
            same(tuple(values[number] for values in of_all[:4]), result[:4])
            np.testing.assert_equal(state(branches.task.parts[number].task), state(env.task))
        if result[2] or result[3]:
            ended += 1
            seen = env.reset()[0]
            of_all = branches.reset(options={"reset_mask": np.array([True, False, True, True])})[0]
            same(of_all[[0, 2, 3]], np.tile(seen, (3, 1)))
        assert {branches.state_hashes[number] for number in (0, 2, 3)} == {env.state_hash}
    assert ended > 0 and env.task.randomizer.save().draws[KICK].max() > 0
    assert branches.state_hashes[1] != env.state_hash
    same(branches.reset(seed=3)[0], np.tile(env.reset(seed=3)[0], (4, 1)))


def test_branches_of_a_parallel_environment_go_on_with_its_draws():
    env, rng = envs.CityParallelEnv(cars=6, threads=2, randomize=TERMS), np.random.default_rng(1)
    env.reset(seed=2)
    for _ in range(5):
        env.step({agent: np.array([1, 0], dtype=np.float32) for agent in env.agents})
    branches = env.branch(2) + env.branch(1)[0].branch(1)
    for _ in range(60):
        actions = {agent: np.array([1, rng.uniform(-1, 1)], dtype=np.float32) for agent in env.agents}
        result = env.step(actions)
        for one in branches:
            same(one.step(actions), result)
            np.testing.assert_equal(state(one.task), state(env.task))
        assert {one.state_hash for one in branches} == {env.state_hash}
    assert len(env.agents) < 6 and env.task.randomizer.save().draws[KICK].max() > 0
    seen = env.reset()[0]
    for one in branches:
        same(one.reset()[0], seen)
        assert one.state_hash == env.state_hash


@pytest.mark.parametrize("name", ["city", "two_cities"])
def test_a_randomizer_of_a_branch_is_about_its_own_robots(name):
    env = begun(VECTORS[name], 10, randomize=TERMS)
    before, hashes = state(env.task), env.state_hashes
    branches = env.branch(2)
    first, second = branches.task.parts
    for part in (first, second):
        assert part.randomizer.robots is part.robots and part.robots.simulation is part.simulation
    first.randomizer.reset()
    worlds = len(hashes)
    assert branches.state_hashes[:worlds] != hashes == branches.state_hashes[worlds:] == env.state_hashes
    for task in (first, second, env.task):
        assert np.array_equal(task.robots.parameters["damping"], task.randomizer.drawn["joint_damping"])
    branches.step(np.ones(branches.action_space.shape))
    for _ in range(3):
        second.randomizer.update()
    np.testing.assert_equal(state(env.task), before)
    assert env.state_hashes == hashes and branches.task.randomizer is None


def test_branches_of_branches_and_a_pickle_go_on_with_the_draws():
    env = begun(VECTORS["two_cities"], 10, randomize=TERMS)
    twigs = env.branch(2).branch(2)
    again, rng = pickle.loads(pickle.dumps(twigs)), np.random.default_rng(3)
    for _ in range(30):
        actions = fast(env, rng)
        result = env.step(actions)
        for one in (twigs, again):
            same(rows(one.step(np.tile(actions, (4, 1))), 3, env.num_envs), result)
            agree(one, range(4), env)
    assert twigs.state_hashes == again.state_hashes == 4 * env.state_hashes


def test_branches_that_act_differently_meet_the_same_draws():
    env = begun(VECTORS["city"], 0, randomize=TERMS)
    branches, count = env.branch(2), env.num_envs
    actions = np.repeat([0.3, -0.3], count)[:, None] * np.ones(2)
    for _ in range(20):
        branches.step(actions)
    one, other = branches.task.parts
    assert (branches.task.age == 20).all() and branches.state_hashes[0] != branches.state_hashes[1]  # no episode began again
    assert one.randomizer.save().draws[KICK].min() >= 0
    same(one.randomizer.drawn, other.randomizer.drawn)
