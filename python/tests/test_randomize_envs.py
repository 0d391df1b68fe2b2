"""`randomize=` of the environments: exact with a seed, in effect; single agents start again with draws of their own."""
import pickle

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from pettingzoo.test import parallel_api_test, parallel_seed_test

import roboss
from roboss import envs, randomize

TERMS = [
    randomize.joint("damping", randomize.uniform(0, 0.01)),
    randomize.joint("max_effort", randomize.uniform(0.8, 1.2), "scale", shared=True, when="start"),
    randomize.kick(randomize.uniform([-0.2, -0.2, 0, 0, 0, -1], [0.2, 0.2, 0, 0, 0, 1]), when=(0.5, 2)),
    randomize.noise(randomize.normal(0, 0.02)),
    randomize.latency(randomize.choice([0, 1, 2])),
]


def ahead(env):
    return np.tile(np.array([1, 0], dtype=np.float32), (env.num_envs, 1))


def run(env, steps=30):
    """Everything that a policy would see, and the hashes."""
    seen = []
    for step in range(steps):
        observations, rewards, *_ = env.step(ahead(env) * (step % 3) / 2)
        seen += [observations, rewards]
    return seen, env.state_hashes


@pytest.mark.parametrize("make", [lambda **o: envs.CityVectorEnv(6, worlds=2, **o),
                                  lambda **o: envs.SoccerVectorEnv(4, cars=1, **o),
                                  lambda **o: envs.WarehouseVectorEnv(4, **o)])
def test_a_seed_repeats_everything(make):
    found = []
    for seed, threads in ((7, 1), (7, 2), (8, 1)):
        env = make(randomize=TERMS, threads=threads)
        first, _ = env.reset(seed=seed)
        found.append(([first, *run(env)[0]], env.state_hashes, env.task.randomizer.drawn))
    assert all(map(np.array_equal, found[0][0], found[1][0])) and found[0][1] == found[1][1] != found[2][1]
    again, _ = env.reset(seed=7)                                                         # the same environment
    assert np.array_equal(again, found[0][0][0]) and run(env)[1] == found[0][1]
    assert all(env.observation_space.contains(seen) for seen in found[0][0][1::2])
    assert env.task.randomizer.drawn["kick"].shape == (*env.task.robots.pose.shape[:-1], 6)


def test_without_terms_nothing_changes():
    found = []
    for terms in ([], [randomize.joint("damping", randomize.uniform(0, 0.01))]):
        env = envs.CityVectorEnv(4, threads=1, randomize=terms)
        env.reset(seed=3)
        found.append((env.task.robots.pose.copy(), env.state_hashes))
        assert (env.task.randomizer is None) == (not terms)
    assert np.array_equal(found[0][0], found[1][0]) and found[0][1] != found[1][1]       # the same places


@pytest.mark.parametrize("mode", ["NextStep", "SameStep"])
def test_an_agent_that_starts_again_draws_again_alone(mode):
    env = envs.CityVectorEnv(12, threads=1, autoreset_mode=mode, randomize=TERMS[:2] + TERMS[3:])
    env.reset(seed=1)
    for _ in range(300):
        before = env.task.randomizer.drawn
        _, _, terminated, truncated, _ = env.step(ahead(env))
        finished = terminated | truncated
        if finished.any():
            break
    if mode == "NextStep":
        assert np.array_equal(env.task.randomizer.drawn["joint_damping"], before["joint_damping"])
        env.step(ahead(env))
    now = env.task.randomizer.drawn
    changed = (now["joint_damping"] != before["joint_damping"]).all(axis=1)
    assert np.array_equal(changed, finished) and finished.any() and not finished.all()
    assert np.array_equal(env.task.robots.parameters["damping"], now["joint_damping"])
    assert np.array_equal(now["joint_max_effort"], before["joint_max_effort"])


def test_a_mask_starts_some_and_a_reset_without_a_seed_goes_on():
    env = envs.CityVectorEnv(6, worlds=2, threads=1, autoreset_mode="Disabled", randomize=TERMS)
    env.reset(seed=1)
    first = env.task.randomizer.drawn
    mask = np.array([False, True, False, False, False, True])
    env.reset(options={"reset_mask": mask})
    now = env.task.randomizer.drawn
    assert np.array_equal((now["joint_damping"] != first["joint_damping"]).all(axis=-1).ravel(), mask)
    env.reset()
    last = env.task.randomizer.drawn
    assert not (last["joint_damping"] == now["joint_damping"]).any()
    assert np.array_equal(last["joint_max_effort"], first["joint_max_effort"])           # once, for all episodes
    of_file = env.task.robots.parameters.of_file("max_effort")
    assert np.array_equal(env.task.robots.parameters["max_effort"], of_file * last["joint_max_effort"])


def test_a_latency_delays_what_the_cars_do():
    env = envs.CityVectorEnv(8, threads=1, randomize=[randomize.latency(randomize.choice([0, 3]))])
    env.reset(seed=2)
    steps = env.task.randomizer.drawn["latency"][:, 0]
    assert set(steps) == {0, 3}
    for step in range(4):
        assert np.abs(env.task.robots.joint_velocity[steps == 3]).max() < 0.5
        env.step(ahead(env))
        speeds = np.abs(env.task.robots.joint_velocity).max(axis=1)
        assert (speeds[steps == 0] > 1).all() and (speeds[steps == 3] > 1).all() == (step == 3)


def test_agents_that_are_out_are_not_kicked():
    env = envs.CityVectorEnv(12, threads=1, autoreset_mode="Disabled",
                             randomize=[randomize.kick(randomize.uniform(0, [1, 1, 0, 0, 0, 1]), when=0.1)])
    env.reset(seed=1)
    while env.task.present.all():
        env.step(ahead(env))
    out, draws = ~env.task.present, env.task.randomizer.save().draws[0]
    places = env.task.robots.pose[out]
    for _ in range(6):
        env.step(0 * ahead(env))
    more = env.task.randomizer.save().draws[0] - draws
    assert (more[out] == 0).all() and (more[env.task.present] == 3).all()
    assert np.allclose(env.task.robots.pose[out], places, atol=0.01)


def test_noise_is_in_the_observation_and_not_in_the_world():
    found = []
    for terms in ([], [randomize.noise(randomize.normal(0, 0.05), columns=[21, 22])]):
        env = envs.CityVectorEnv(8, threads=1, randomize=terms)
        env.reset(seed=2)
        found.append(run(env, 20))
    assert found[0][1] == found[1][1]
    noise = np.array(found[1][0][::2]) - np.array(found[0][0][::2])
    assert np.abs(np.delete(noise, [21, 22], axis=2)).max() == 0
    assert abs(noise[:, :, 22].std() / 0.05 - 1) < 0.25


def test_a_pickled_environment_continues_exactly():
    env = envs.CityVectorEnv(6, worlds=2, threads=1, randomize=TERMS)
    env.reset(seed=5)
    run(env, 10)
    twin = pickle.loads(pickle.dumps(env))
    seen, hashes = run(env)
    of_twin, hashes_of_twin = run(twin)
    assert hashes == hashes_of_twin and all(map(np.array_equal, seen, of_twin))


def test_checkers_of_gymnasium_and_pettingzoo_accept_it():
    check_env(gymnasium.make("roboss/City-v0", traffic=2, randomize=TERMS).unwrapped, skip_render_check=True)
    parallel_api_test(envs.CityParallelEnv(cars=4, threads=1, randomize=TERMS), num_cycles=60)
    parallel_seed_test(lambda: envs.CityParallelEnv(cars=4, threads=1, randomize=TERMS), num_cycles=20)
    cars = gymnasium.make_vec("roboss/City-v0", num_envs=4, threads=1, randomize=TERMS)
    cars.reset(seed=1)
    assert cars.step(cars.action_space.sample())[0].shape == (4, 29)


def test_terms_that_do_not_fit_are_refused_when_it_is_made():
    for terms in ([randomize.joint("dampin", randomize.uniform(0, 1))],
                  [randomize.noise(randomize.normal(0, 1), columns=[29])], "damping", [1]):
        with pytest.raises((roboss.ArgumentError, roboss.UnknownNameError)) as refused:
            envs.CityVectorEnv(2, threads=1, randomize=terms)
        assert refused.value.remedy
