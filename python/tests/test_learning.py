"""examples/learning: gradients, learning on a small problem, and the programs from end to end."""
import subprocess
import sys
from types import SimpleNamespace

import numpy as np

from conftest import REPOSITORY

EXAMPLE = REPOSITORY / "examples" / "learning"
sys.path.insert(0, str(EXAMPLE))
from policy import Network, Policy  # noqa: E402
from ppo import Learner, Samples, Settings, advantages_of  # noqa: E402


def run(program, *arguments):
    """Output of a program of the example."""
    done = subprocess.run([sys.executable, "-B", EXAMPLE / program, *map(str, arguments)], capture_output=True, text=True,
                          check=False, timeout=120)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_gradients_are_those_of_differences():
    rng = np.random.default_rng(1)
    network = Network((5, 7, 6, 2), 1.0, rng)
    network.parameters = [parameter.astype(np.float64) for parameter in network.parameters]
    inputs, slope = rng.normal(size=(9, 5)), rng.normal(size=(9, 2))
    found = network.gradients(network.layers(inputs), slope)
    for parameter, gradient in zip(network.parameters, found):
        for place in [tuple(rng.integers(size) for size in parameter.shape) for _ in range(4)]:
            before, sides = parameter[place], []
            for step in (1e-6, -1e-6):
                parameter[place] = before + step
                sides.append((network(inputs) * slope).sum())
            parameter[place] = before
            assert np.isclose(gradient[place], (sides[0] - sides[1]) / 2e-6, rtol=1e-6, atol=1e-8)


def test_advantages_end_with_an_episode():
    rewards = np.array([[1.0], [2.0], [4.0]], dtype=np.float32)
    ended = np.array([[False], [True], [False]])
    samples = Samples(None, None, None, np.zeros((3, 1)), rewards, ended, np.array([[0.0], [10.0], [0.0]]), np.array([8.0]))
    found = advantages_of(samples, Settings(discount=0.5, trace=1.0))
    assert found[:, 0].tolist() == [1 + 0.5 * (2 + 0.5 * 10), 2 + 0.5 * 10, 4 + 0.5 * 8]


class Target:
    """Sub-environments in which the best action is minus what is seen."""

    num_envs = 32
    single_action_space = SimpleNamespace(shape=(1,))

    def reset(self, seed):
        self.rng = np.random.default_rng(seed)
        return self.look(), {}

    def look(self):
        self.seen = self.rng.uniform(-0.5, 0.5, (32, 2)).astype(np.float32)
        return self.seen

    def step(self, actions):
        rewards, false = -np.abs(actions[:, 0] + self.seen[:, 0]), np.zeros(32, dtype=bool)
        return self.look(), rewards, ~false, false, dict.fromkeys(("progress", "collided", "arrived"), rewards)


def test_learns_what_is_rewarded():
    policy = Policy(2, 1, np.random.default_rng(1), hidden=16)
    learner = Learner(Target(), policy, Settings(steps=64, minibatch=256, rate=3e-3), seed=1)
    for update in range(25):
        learner.update(learner.collect(), update / 25)
    seen = np.random.default_rng(2).uniform(-0.5, 0.5, (100, 2)).astype(np.float32)
    assert np.abs(policy(seen)[:, 0] + seen[:, 0]).mean() < 0.08


def test_trains_and_compares_a_driver(tmp_path):
    run("train_city.py", "--steps", 12 * 8 * 128, "--cars", 8, "--threads", 1, "--output", tmp_path)
    curve = np.genfromtxt(tmp_path / "city_curve.csv", delimiter=",", names=True)
    assert len(curve) == 12 and curve["agent_steps"][-1] == 12 * 8 * 128
    table = run("compare_city.py", "--policy", tmp_path / "city_policy.npz", "--cars", 8, "--minutes", 0.1, "--seeds", 1)
    assert len(table.splitlines()) == 4


def test_the_driver_that_comes_with_the_example_drives():
    lines = run("compare_city.py", "--cars", 16, "--minutes", 0.5, "--seeds", 3).splitlines()
    speed = {line.split("|")[1].strip(): float(line.split("|")[2]) for line in lines[2:]}
    assert speed["learned"] > 1 and speed["hand-written"] > 1  # m/s
