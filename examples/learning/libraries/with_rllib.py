#!/usr/bin/env python3
"""The cars of one city learn one policy with PPO of RLlib, as several agents of one environment.

RLlib's wrapper for PettingZoo takes roboss.envs.CityParallelEnv as it is: agents have names, and one that collides
leaves until the episode of all is over.

Usage: with_rllib.py [--steps 150000] [--cars 64] [--seed 1]
"""
from city_cars import TICK_S, arguments, needed, train_and_compare

with needed():
    import logging
    import os

    os.environ.setdefault("RAY_raylet_start_wait_time_s", "300")  # a busy computer is slow to start it
    import ray
    import torch
    from ray.rllib.algorithms.ppo import PPOConfig
    from ray.rllib.core.rl_module import RLModuleSpec
    from ray.rllib.core.rl_module.default_model_config import DefaultModelConfig
    from ray.rllib.env.wrappers.pettingzoo_env import ParallelPettingZooEnv
    from ray.tune.registry import register_env

    import roboss.envs

STEPS, EPISODE_S = 128, 10.0  # of an agent between two updates; after which all cars start again


def algorithm_of(cars, seed):
    """PPO of one policy that all cars share, in this process."""
    register_env("city", lambda _: ParallelPettingZooEnv(roboss.envs.CityParallelEnv(cars=cars, episode_s=EPISODE_S, dt=TICK_S)))
    model = DefaultModelConfig(fcnet_hiddens=[64, 64], fcnet_activation="tanh", vf_share_layers=False)
    config = (PPOConfig().environment("city", clip_actions=True).env_runners(num_env_runners=0)
              .learners(num_learners=0).debugging(seed=seed, log_level="ERROR")
              .multi_agent(policies={"driver"}, policy_mapping_fn=lambda agent, *_, **__: "driver")
              .rl_module(rl_module_spec=RLModuleSpec(model_config=model))
              .training(train_batch_size_per_learner=STEPS, minibatch_size=STEPS, num_epochs=4, lr=5e-4,  # counted in steps of all
                        gamma=0.98, lambda_=0.95, vf_clip_param=100.0, grad_clip=0.5))
    return config.build_algo()


def main():
    given = arguments(__doc__)
    torch.set_num_threads(1)  # the networks are small, and the other core steps the world
    ray.init(num_cpus=1, include_dashboard=False, log_to_driver=False, logging_level=logging.ERROR)
    algorithm = algorithm_of(given.cars, given.seed)
    policy = algorithm.get_module("driver")

    def act(seen):
        with torch.no_grad():
            return policy.forward_inference({"obs": torch.from_numpy(seen)})["action_dist_inputs"][:, :2].numpy()

    def train():
        for _ in range(max(1, given.steps // (STEPS * given.cars))):
            algorithm.train()

    train_and_compare(train, act)
    algorithm.stop()
    ray.shutdown()


if __name__ == "__main__":
    main()
