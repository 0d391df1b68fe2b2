"""roboss.envs: the checkers of Gymnasium and PettingZoo, exact resets, autoreset modes, agents that come and go."""
import warnings

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode
from gymnasium.wrappers.vector import RecordEpisodeStatistics
from pettingzoo.test import parallel_api_test, parallel_seed_test

import roboss
from roboss import envs


@pytest.fixture
def quiet():
    """The checkers warn about what an environment may well do."""
    with warnings.catch_warnings():
        warnings.simplefilter("default")
        yield


def ahead(env):
    """All cars at full speed straight ahead."""
    return np.tile(np.array([1, 0], dtype=np.float32), (env.num_envs, 1))


def run_until_one_finishes(env, most=200):
    """Steps at full speed until an episode is over; what that step gave, and for which cars it was over."""
    for _ in range(most):
        result = env.step(ahead(env))
        finished = result[2] | result[3]
        if finished.any():
            return result, finished
    raise AssertionError("no car touched anything")


@pytest.mark.parametrize("name, others", [("City", {"traffic": 3}), ("City", {"traffic": 0}), ("Soccer", {"cars": 1}),
                                          ("Soccer", {"cars": 2}), ("Warehouse", {"others": 2}), ("Warehouse", {"others": 0})])
def test_gymnasium_accepts_the_environment(quiet, name, others):
    check_env(gymnasium.make(f"roboss/{name}-v0", **others).unwrapped, skip_render_check=True)


@pytest.mark.parametrize("name", ["City", "Soccer", "Warehouse"])
def test_a_single_agent_has_exact_resets(name):
    env = gymnasium.make(f"roboss/{name}-v0", threads=1).unwrapped
    ways = []
    for _ in range(2):
        way = [env.reset(seed=9)[0], env.state_hash]
        rng = np.random.default_rng(1)
        for _ in range(20):
            observation, _, terminated, truncated, _ = env.step(rng.uniform(-1, 1, 2).astype(np.float32))
            way += [observation, env.state_hash]
            if terminated or truncated:
                break
        ways.append(way)
    assert all(map(np.array_equal, *ways)) and len(ways[0]) == len(ways[1])


@pytest.mark.parametrize("make", [lambda **o: envs.CityVectorEnv(4, worlds=2, **o), lambda **o: envs.SoccerVectorEnv(2, cars=1, **o),
                                  lambda **o: envs.WarehouseVectorEnv(2, **o)])
def test_vector_environments_have_a_frame_of_each_agent(make):
    env = make(render_mode="rgb_array", threads=1)
    env.reset(seed=1)
    frames = env.render()
    assert len(frames) == env.num_envs and env.metadata["render_fps"] == 20
    for frame in frames:
        assert frame.shape == (160, 240, 3) and frame.dtype == np.uint8 and frame.std() > 10
    assert not np.array_equal(frames[0], frames[1])
    env.step(ahead(env))
    assert not np.array_equal(env.render()[0], frames[0])
    assert make(threads=1).render() is None
    with pytest.raises(roboss.UnknownNameError):
        make(render_mode="human")


@pytest.mark.parametrize("make", [lambda **o: envs.CityParallelEnv(3, **o), lambda **o: envs.SoccerParallelEnv(1, **o),
                                  lambda **o: envs.WarehouseParallelEnv(3, **o)])
def test_parallel_environments_have_frames(make):
    env = make(render_mode="rgb_array", threads=1)
    env.reset(seed=1)
    frame = env.render()
    assert frame.shape == (320, 480, 3) and frame.dtype == np.uint8 and frame.std() > 10
    assert make(threads=1).render() is None


@pytest.mark.filterwarnings("error")
def test_pettingzoo_accepts_the_environment():
    parallel_api_test(envs.CityParallelEnv(cars=6, threads=1), num_cycles=150)
    parallel_seed_test(lambda: envs.CityParallelEnv(cars=6, threads=1), num_cycles=20)


def test_one_world_is_one_vector_environment():
    env = gymnasium.make_vec("roboss/City-v0", num_envs=12, threads=1)
    assert isinstance(env, envs.CityVectorEnv) and env.num_envs == 12
    assert env.metadata["autoreset_mode"] == AutoresetMode.NEXT_STEP
    observations, _ = env.reset(seed=3)
    assert env.observation_space.contains(observations)
    observations, rewards, terminated, truncated, infos = env.step(env.action_space.sample())
    assert env.observation_space.contains(observations)
    assert rewards.dtype == np.float64 and rewards.shape == terminated.shape == truncated.shape == (12,)
    assert infos["present"].all() and infos["_progress"].all()
    assert np.allclose(rewards, infos["progress"])


@pytest.mark.parametrize("mode", list(AutoresetMode))
@pytest.mark.parametrize("worlds", [1, 2])
def test_the_same_seed_gives_the_same_bits(mode, worlds):
    ways = []
    for threads in (1, 3):
        env = envs.CityVectorEnv(num_envs=16, worlds=worlds, threads=threads, autoreset_mode=mode)
        env.reset(seed=0)
        env.step(ahead(env))  # what happened before a reset does not count
        way = [env.reset(seed=11)[0]]
        for _ in range(100):
            observations, rewards, *_ = env.step(ahead(env))
            way += [observations, rewards]
        ways.append((way, env.state_hashes))
    assert ways[0][1] == ways[1][1] and len(set(ways[0][1])) == worlds
    assert all(np.array_equal(one, other) for one, other in zip(*(way for way, _ in ways)))
    assert not np.array_equal(env.reset(seed=12)[0], ways[0][0][0])


def test_a_car_that_touches_something_is_terminated():
    env = envs.CityVectorEnv(num_envs=12, threads=1)
    env.reset(seed=1)
    (_, rewards, terminated, truncated, infos), finished = run_until_one_finishes(env)
    assert np.array_equal(terminated, infos["collided"]) and not truncated.any()
    assert (rewards[finished] < -4).all() and (rewards[~finished] > -1).all()


def test_next_step_starts_a_finished_car_in_the_next_step():
    env = envs.CityVectorEnv(num_envs=12, threads=1)
    env.reset(seed=1)
    (observations, *_), finished = run_until_one_finishes(env)
    assert (observations[finished, :21].min(axis=1) < 0.2).all()  # what it ran into
    assert not env.task.present[finished].any()
    observations, rewards, terminated, truncated, infos = env.step(ahead(env))
    assert np.array_equal(infos["present"], ~finished) and (rewards[finished] == 0).all()
    assert not (terminated | truncated)[finished].any() and env.task.present.all()
    assert np.allclose(observations[finished, 21:23], 0, atol=1e-6)  # at rest
    assert (env.task.age[finished] == 0).all() and (env.task.age[~finished] > 1).all()


def test_same_step_starts_it_at_once_and_keeps_what_it_saw():
    env = envs.CityVectorEnv(num_envs=12, threads=1, autoreset_mode=AutoresetMode.SAME_STEP)
    env.reset(seed=1)
    (observations, *_, infos), finished = run_until_one_finishes(env)
    assert np.array_equal(infos["_final_obs"], finished) and np.array_equal(infos["_final_info"], finished)
    assert np.array_equal(infos["final_info"]["collided"] & infos["final_info"]["_collided"], finished)
    for car in range(12):
        last = infos["final_obs"][car]
        assert (last is not None) == finished[car]
        assert last is None or (env.single_observation_space.contains(last) and last[:21].min() < 0.2)
    assert np.allclose(observations[finished, 21:23], 0, atol=1e-6) and env.task.present.all()


def test_disabled_leaves_it_out_until_a_mask_starts_it():
    env = envs.CityVectorEnv(num_envs=12, threads=1, autoreset_mode="Disabled")
    env.reset(seed=1)
    _, finished = run_until_one_finishes(env)
    away = env.task.robots.pose[finished]
    for _ in range(5):
        _, rewards, terminated, _, infos = env.step(ahead(env))
        assert not infos["present"][finished].any() and (rewards[finished] == 0).all()
        assert not terminated[finished].any()
    assert np.allclose(env.task.robots.pose[finished], away, atol=0.01)
    out = ~env.task.present
    observations, _ = env.reset(options={"reset_mask": out})
    assert env.task.present.all() and (env.task.age[out] == 0).all() and (env.task.age[~out] > 5).all()
    assert np.allclose(observations[out, 21:23], 0, atol=1e-6)


def test_time_that_is_up_truncates():
    env = envs.CityVectorEnv(num_envs=4, threads=1, episode_s=0.5)
    env.reset(seed=1)
    still = np.zeros((4, 2))
    for step in range(1, 11):
        _, _, terminated, truncated, _ = env.step(still)
        assert not terminated.any() and truncated.all() == (step == 10)


def test_wrappers_of_gymnasium_take_it():
    env = RecordEpisodeStatistics(envs.CityVectorEnv(num_envs=6, threads=1, episode_s=0.5))
    env.reset(seed=1)
    for _ in range(10):
        *_, infos = env.step(ahead(env))
    assert (infos["episode"]["l"] == 10).all() and infos["_episode"].all()


def test_agents_of_the_parallel_environment_leave_one_by_one():
    env = envs.CityParallelEnv(cars=8, threads=1)
    env.reset(seed=2)
    assert env.state().shape == (8, 13)
    action, left = np.array([1, 0], dtype=np.float32), 8
    while env.agents:
        acting = list(env.agents)
        observations, rewards, terminated, truncated, infos = env.step({agent: action for agent in acting})
        assert list(observations) == list(rewards) == list(infos) == acting
        assert env.agents == [agent for agent in acting if not terminated[agent] and not truncated[agent]]
        assert all(infos[agent]["collided"] == terminated[agent] for agent in acting)
        assert len(env.agents) <= left
        left = len(env.agents)
    with pytest.raises(roboss.StateError):
        env.step({})


def test_the_hand_written_driver_drives():
    env = envs.CityVectorEnv(num_envs=8, threads=1)
    observations, _ = env.reset(seed=4)
    progress = collisions = 0
    for _ in range(200):
        observations, _, _, _, infos = env.step(envs.follow_the_gap(observations))
        progress += infos["progress"].sum()
        collisions += infos["collided"].sum()
    assert progress > 8 * 200 * 0.05 * 0.8 and collisions <= 2  # 0.8 m/s


def test_errors_tell_what_to_do():
    for make in (lambda: envs.CityVectorEnv(num_envs=0), lambda: envs.CityVectorEnv(num_envs=5, worlds=2),
                 lambda: envs.CityVectorEnv(num_envs=251), lambda: envs.CityEnv(traffic=-1),
                 lambda: envs.CityVectorEnv(num_envs=3, world=roboss.example("city.sdf")),
                 lambda: envs.CityVectorEnv(num_envs=16, world=roboss.example("crossroads.sdf"))):
        with pytest.raises(roboss.ArgumentError) as error:
            make()
        assert error.value.remedy
    env = envs.CityVectorEnv(num_envs=3, threads=1)
    with pytest.raises(roboss.StateError):
        env.step(ahead(env))
    env.reset(seed=1)
    for mask in ([True, False, True], np.zeros(3, dtype=bool), np.ones(2, dtype=bool), np.ones(3)):
        with pytest.raises(roboss.ArgumentError):
            env.reset(options={"reset_mask": mask})


def test_a_city_of_your_own():
    env = envs.CityVectorEnv(num_envs=50, world=roboss.example("city.sdf"), threads=1)
    env.reset(seed=1)
    assert env.task.names[49] == "car_49" and env.step(ahead(env))[1].shape == (50,)
