#!/usr/bin/env python3
"""The cars of one city learn with PPO of Stable-Baselines3.

Stable-Baselines3 has a vectorised environment of its own, `VecEnv`; AgentsVecEnv below shows any `VectorEnv` of
roboss.envs as one. The library's own `make_vec_env` would start a world for each car.

Usage: with_stable_baselines3.py [--steps 150000] [--cars 64] [--seed 1]
"""
from city_cars import arguments, needed, new_env, train_and_compare

with needed():
    import numpy as np
    import torch
    from stable_baselines3 import PPO
    from stable_baselines3.common.vec_env import VecEnv


class AgentsVecEnv(VecEnv):
    """A gymnasium.vector.VectorEnv with the autoreset mode "SameStep", for Stable-Baselines3."""

    def __init__(self, env):
        self.env, self._actions = env, None
        super().__init__(env.num_envs, env.single_observation_space, env.single_action_space)

    def reset(self):
        """Observations of all agents, (N, ...), of new episodes in the whole world."""
        return self.env.reset(seed=self._seeds[0])[0]

    def step_async(self, actions):
        """Keeps the actions; step_wait() takes the step."""
        self._actions = actions

    def step_wait(self):
        """Observations, rewards, dones, and infos with the terminal observations."""
        observations, rewards, terminated, truncated, infos = self.env.step(self._actions)
        last = [{} for _ in range(self.num_envs)]
        for agent in np.flatnonzero(terminated | truncated):
            last[agent] = {"terminal_observation": infos["final_obs"][agent], "TimeLimit.truncated": bool(truncated[agent])}
        return observations, rewards.astype(np.float32), terminated | truncated, last

    def close(self):
        """Ends the environment."""
        self.env.close()

    def get_attr(self, attr_name, indices=None):
        """The environment's attribute, once for each agent."""
        return [getattr(self.env, attr_name, None) for _ in self._get_indices(indices)]

    def set_attr(self, attr_name, value, indices=None):
        """Sets the attribute of the environment, which all agents share."""
        setattr(self.env, attr_name, value)

    def env_method(self, method_name, *args, indices=None, **kwargs):
        """Calls a method of the environment, once."""
        return [getattr(self.env, method_name)(*args, **kwargs)]

    def env_is_wrapped(self, wrapper_class, indices=None):
        """No agent has a wrapper of its own."""
        return [False for _ in self._get_indices(indices)]


def main():
    given = arguments(__doc__)
    torch.set_num_threads(1)  # the networks are small, and the other core steps the world
    env = AgentsVecEnv(new_env(given.cars, given.seed))
    model = PPO("MlpPolicy", env, n_steps=64, batch_size=min(1024, 64 * given.cars), n_epochs=6, learning_rate=1e-3, gamma=0.98,
                policy_kwargs={"log_std_init": -0.7}, seed=given.seed, device="cpu")
    train_and_compare(lambda: model.learn(given.steps), lambda seen: model.predict(seen, deterministic=True)[0])


if __name__ == "__main__":
    main()
