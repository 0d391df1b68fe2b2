"""examples/learning/plan_spider.py: what a branch promises then happens, and plans are faster than the plain gait."""
import os
import pickle
import subprocess
import sys

import numpy as np
import pytest

import roboss.envs
from conftest import REPOSITORY

PROGRAM = REPOSITORY / "examples" / "learning" / "plan_spider.py"
sys.path.insert(0, str(PROGRAM.parent))
from plan_spider import HORIZON_S, PERIOD, RANGES, Gaits, Planner, SpiderTask, walk  # noqa: E402


@pytest.fixture
def env():
    return roboss.envs.TaskEnv(SpiderTask(Gaits(), threads=2))


def test_an_action_of_zeros_is_the_plain_gait(env):
    task = env.task
    rows = task.gaits_of(np.array([np.zeros(len(RANGES)), np.ones(len(RANGES)), -2 * np.ones(len(RANGES))]))
    assert np.array_equal(rows[0], task.plain)
    np.testing.assert_allclose(rows[1:, task.columns].T, [[high, low] for low, high in RANGES.values()])


def test_what_a_branch_promises_is_what_then_happens(env):
    env.reset(seed=0)
    for _ in range(50):
        env.step(np.zeros(len(RANGES)))
    before, planner = env.state_hash, Planner(4, seed=1)
    action = planner.plan(env)
    assert env.state_hash == before and np.abs(action).max() > 0.1
    promised = planner.walk(env.branch(1), action[None])[0]
    twin = pickle.loads(pickle.dumps(env))
    kept = [0.0, 0.0]
    for _ in range(round(HORIZON_S / PERIOD)):
        for number, one in enumerate((env, twin)):
            kept[number] += one.step(action)[1]
    assert kept == [promised, promised] and env.state_hash == twin.state_hash != before


def test_plans_make_the_spider_faster(env):
    plain, _ = walk(env, 1.0)
    told = []
    planned, lean = walk(env, 1.0, Planner(8, seed=1), lambda *words: told.append(words))
    assert [time for time, *_ in told] == [0, 0.25, 0.5, 0.75]
    assert 0.1 < plain < 0.5 and 2 * plain < planned < 3 and lean < 0.3  # m/s, rad


def test_the_program_tells_both_speeds_and_what_it_cannot_do():
    def run(*words, **variables):
        return subprocess.run([sys.executable, "-P", "-B", PROGRAM, *words], capture_output=True, text=True,
                              check=False, env={**os.environ, **variables}, timeout=120)
    done = run("--seconds", "0.3", "--branches", "4", "--threads", "1")
    assert done.returncode == 0 and len(done.stdout.splitlines()) == 4 and "with plans" in done.stdout.splitlines()[2]
    assert run("--branches", "2").returncode == 2
    done = run(ROBOSS_SPIDER_LIBRARY="missing.so")
    assert done.returncode == 2 and "remedy: tools/build.sh release roboss_spider_gait" in done.stderr
