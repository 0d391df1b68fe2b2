#!/usr/bin/env python3
"""The cars of one city learn with PPO of rsl_rl, the library that Isaac Lab and mjlab train legged robots with.

rsl_rl has a vectorised environment of its own; TensorEnv below shows any `VectorEnv` of roboss.envs as one, on the CPU.

Usage: with_rsl_rl.py [--steps 150000] [--cars 64] [--seed 1]
"""
import contextlib
import io

from city_cars import arguments, needed, new_env, train_and_compare

with needed():
    import torch
    from rsl_rl.env import VecEnv
    from rsl_rl.runners import OnPolicyRunner
    from tensordict import TensorDict

STEPS = 64  # of an agent between two updates


class TensorEnv(VecEnv):
    """A gymnasium.vector.VectorEnv with the autoreset mode "SameStep", for rsl_rl. Tensors share memory with its arrays."""

    def __init__(self, env, seed):
        self.env, self.cfg, self.device = env, {}, "cpu"
        self.num_envs, self.num_actions = env.num_envs, env.single_action_space.shape[0]
        self.max_episode_length = env.task.episode_steps
        self.episode_length_buf = torch.from_numpy(env.task.age)
        self._seen = self._dict(env.reset(seed=seed)[0])

    def get_observations(self):
        """The present observations of all agents."""
        return self._seen

    def step(self, actions):
        """Observations, rewards, dones, and extras with the mask of time-outs."""
        observations, rewards, terminated, truncated, _ = self.env.step(actions.clamp(-1, 1).numpy())
        self._seen = self._dict(observations)
        extras = {"time_outs": torch.from_numpy(truncated)}
        return self._seen, torch.from_numpy(rewards).float(), torch.from_numpy(terminated | truncated), extras

    def _dict(self, observations):
        return TensorDict({"policy": torch.from_numpy(observations)}, batch_size=[self.num_envs])


def settings_of(cars):
    """The configuration of the runner."""
    model = {"class_name": "MLPModel", "hidden_dims": [64, 64], "activation": "tanh"}
    return {"num_steps_per_env": STEPS, "save_interval": 10**9, "obs_groups": {"actor": ["policy"], "critic": ["policy"]},
            "actor": {**model, "distribution_cfg": {"class_name": "GaussianDistribution", "init_std": 0.5, "std_type": "log"}},
            "critic": model,
            "algorithm": {"class_name": "PPO", "num_learning_epochs": 6, "num_mini_batches": max(1, STEPS * cars // 1024),
                          "gamma": 0.98, "learning_rate": 1e-3, "schedule": "fixed", "entropy_coef": 0.0, "max_grad_norm": 0.5}}


def main():
    given = arguments(__doc__)
    torch.set_num_threads(1)  # the networks are small, and the other core steps the world
    torch.manual_seed(given.seed)
    with contextlib.redirect_stdout(io.StringIO()):  # it prints its networks
        runner = OnPolicyRunner(TensorEnv(new_env(given.cars, given.seed), given.seed), settings_of(given.cars))

    def train():
        with contextlib.redirect_stdout(io.StringIO()):  # and a page for each update
            runner.learn(max(1, given.steps // (STEPS * given.cars)))

    def act(seen):
        with torch.no_grad():
            return runner.alg.get_policy()(TensorDict({"policy": torch.from_numpy(seen)}, batch_size=[len(seen)])).numpy()

    train_and_compare(train, act)


if __name__ == "__main__":
    main()
