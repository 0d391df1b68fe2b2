#!/usr/bin/env python3
"""The cars of one city learn with PPO of skrl, which takes a `VectorEnv` of Gymnasium as it is.

Usage: with_skrl.py [--steps 150000] [--cars 64] [--seed 1]
"""
from city_cars import arguments, needed, new_env, train_and_compare

with needed():
    import torch
    from skrl.agents.torch.ppo import PPO, PPO_CFG
    from skrl.envs.wrappers.torch import wrap_env
    from skrl.memories.torch import RandomMemory
    from skrl.models.torch import DeterministicMixin, GaussianMixin, Model
    from skrl.trainers.torch import SequentialTrainer
    from skrl.utils import set_seed
    from torch import nn

STEPS = 64  # of an agent between two updates


def network(inputs, outputs):
    """Two hidden layers of tanh."""
    return nn.Sequential(nn.Linear(inputs, 64), nn.Tanh(), nn.Linear(64, 64), nn.Tanh(), nn.Linear(64, outputs))


class Actor(GaussianMixin, Model):
    """Actions: their mean by the network, their spread learned."""

    def __init__(self, env):
        Model.__init__(self, observation_space=env.observation_space, action_space=env.action_space, device=env.device)
        GaussianMixin.__init__(self, clip_actions=False)
        self.net = network(self.num_observations, self.num_actions)
        self.log_spread = nn.Parameter(torch.full((self.num_actions,), -0.7))
        with torch.no_grad():
            self.net[-1].weight *= 0.01

    def compute(self, inputs, role=""):
        """See skrl.models.torch.Model."""
        return self.net(inputs["observations"]), {"log_std": self.log_spread}


class Critic(DeterministicMixin, Model):
    """What is expected from here on."""

    def __init__(self, env):
        Model.__init__(self, observation_space=env.observation_space, action_space=env.action_space, device=env.device)
        DeterministicMixin.__init__(self)
        self.net = network(self.num_observations, 1)

    def compute(self, inputs, role=""):
        """See skrl.models.torch.Model."""
        return self.net(inputs["observations"]), {}


def main():
    given = arguments(__doc__)
    torch.set_num_threads(1)  # the networks are small, and the other core steps the world
    set_seed(given.seed)
    env = wrap_env(new_env(given.cars, given.seed), wrapper="gymnasium")
    models = {"policy": Actor(env), "value": Critic(env)}
    settings = PPO_CFG(rollouts=STEPS, learning_epochs=6, mini_batches=max(1, STEPS * given.cars // 1024), discount_factor=0.98,
                       learning_rate=1e-3, value_loss_scale=0.5, value_clip=0, time_limit_bootstrap=True)
    settings.experiment.write_interval = settings.experiment.checkpoint_interval = 0  # no files
    agent = PPO(models=models, memory=RandomMemory(memory_size=STEPS, num_envs=env.num_envs, device=env.device), cfg=settings,
                observation_space=env.observation_space, action_space=env.action_space, device=env.device)
    updates = max(1, given.steps // (STEPS * given.cars))
    trainer = SequentialTrainer(env=env, agents=agent, cfg={"timesteps": updates * STEPS, "headless": True,
                                                           "disable_progressbar": True})

    def act(seen):
        with torch.no_grad():
            return models["policy"].net(torch.from_numpy(seen)).numpy()

    train_and_compare(trainer.train, act)


if __name__ == "__main__":
    main()
