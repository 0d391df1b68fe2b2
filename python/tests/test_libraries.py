"""examples/learning/libraries: each learns where its library is installed, and what its adapter tells is right without it."""
import importlib
import re
import subprocess
import sys
import types

import numpy as np
import pytest

from conftest import REPOSITORY

EXAMPLE = REPOSITORY / "examples" / "learning" / "libraries"
#: The libraries that each script needs, by its name.
NEEDED = {"with_stable_baselines3": ["torch", "stable_baselines3"], "with_torch": ["torch"], "with_skrl": ["torch", "skrl"],
          "with_rsl_rl": ["torch", "rsl_rl"], "with_torchrl": ["torch", "torchrl"], "with_rllib": ["torch", "ray"]}


def run(script, *arguments):
    """Exit code, output and errors of a script of the example."""
    done = subprocess.run([sys.executable, "-B", EXAMPLE / f"{script}.py", *map(str, arguments)], capture_output=True, text=True,
                          check=False, timeout=900)
    return done.returncode, done.stdout, done.stderr


def missing(libraries):
    """Those that are not installed."""
    return [name for name in libraries if importlib.util.find_spec(name) is None]


def test_every_script_is_tested():
    assert {file.stem for file in EXAMPLE.glob("with_*.py")} == set(NEEDED)


@pytest.mark.parametrize("script", NEEDED)
def test_learns_to_drive(script):
    if lacking := missing(NEEDED[script]):
        pytest.skip(f"not installed: {', '.join(lacking)}")
    code, out, errors = run(script, "--steps", 30_000, "--cars", 32)
    assert code == 0, errors
    before, after = (float(speed) for speed in re.findall(r"^(?:before|after): +(-?[0-9.]+) m/s", out, re.MULTILINE))
    assert before < 0.2 and after > before + 0.2, out


@pytest.mark.parametrize("script", NEEDED)
def test_a_missing_library_and_wrong_numbers_are_told(script):
    if lacking := missing(NEEDED[script]):
        code, _, errors = run(script)
        assert code == 2 and "pip install" in errors
        assert any(f"the Python package {name} is missing" in errors for name in lacking), errors
        return
    code, _, errors = run(script, "--steps", 0)
    assert code == 2 and "--steps 0: give 1 or more" in errors


@pytest.fixture
def adapter(monkeypatch):
    """The module with_stable_baselines3, with the library's classes as they are, or bare ones where it is missing."""
    monkeypatch.syspath_prepend(EXAMPLE)
    if missing(NEEDED["with_stable_baselines3"]):
        class VecEnv:
            """What the adapter uses of the library's class."""

            def __init__(self, num_envs, observation_space, action_space):
                self.num_envs, self.observation_space, self.action_space = num_envs, observation_space, action_space
                self._seeds = [None] * num_envs

            def seed(self, seed):
                """Of the next reset()."""
                self._seeds = [seed + number for number in range(self.num_envs)]

            def step(self, actions):
                """One step of all."""
                self.step_async(actions)
                return self.step_wait()

        for name in ("torch", "stable_baselines3", "stable_baselines3.common", "stable_baselines3.common.vec_env"):
            monkeypatch.setitem(sys.modules, name, types.ModuleType(name))
        sys.modules["stable_baselines3"].PPO = None
        sys.modules["stable_baselines3.common.vec_env"].VecEnv = VecEnv
    yield importlib.import_module("with_stable_baselines3")
    sys.modules.pop("with_stable_baselines3", None)


def test_the_adapter_tells_what_was_seen_last(adapter):
    env, again = (adapter.AgentsVecEnv(adapter.new_env(8, seed=3)) for _ in range(2))
    plain = adapter.new_env(8, seed=3)
    for one in (env, again):
        one.seed(3)
    seen = env.reset()
    assert seen.shape == (8, 29) and np.array_equal(seen, again.reset()) and np.array_equal(seen, plain.reset(seed=3)[0])
    ahead, ended = np.tile(np.float32([1, 0]), (8, 1)), 0
    for _ in range(200):
        seen, rewards, done, infos = env.step(ahead)
        other, _, terminated, truncated, told = plain.step(ahead)
        assert np.array_equal(seen, other) and np.array_equal(done, terminated | truncated) and rewards.dtype == np.float32
        for agent in np.flatnonzero(done):
            assert np.array_equal(infos[agent]["terminal_observation"], told["final_obs"][agent])
            assert infos[agent]["TimeLimit.truncated"] == truncated[agent]
            assert not np.array_equal(infos[agent]["terminal_observation"], seen[agent])
        assert all(bool(infos[agent]) == done[agent] for agent in range(8))
        ended += done.sum()
    assert ended > 0


def test_the_measure_is_the_same_each_time(monkeypatch):
    monkeypatch.syspath_prepend(EXAMPLE)
    city_cars = importlib.import_module("city_cars")
    import roboss.envs
    still, driven = city_cars.drive(lambda seen: np.zeros((len(seen), 2)), cars=8), city_cars.drive(roboss.envs.follow_the_gap, cars=8)
    assert abs(still.speed) < 0.2 and driven.speed > 1
    assert driven == city_cars.drive(roboss.envs.follow_the_gap, cars=8)
