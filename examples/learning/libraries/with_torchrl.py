#!/usr/bin/env python3
"""The cars of one city learn with PPO of TorchRL, whose GymWrapper takes a `VectorEnv` of Gymnasium as it is.

Usage: with_torchrl.py [--steps 150000] [--cars 64] [--seed 1]
"""
from city_cars import arguments, needed, new_env, train_and_compare

with needed():
    import torch
    from tensordict.nn import NormalParamExtractor, TensorDictModule
    from torch import nn
    from torchrl.collectors import Collector
    from torchrl.envs import GymWrapper, set_gym_backend
    from torchrl.modules import IndependentNormal, MLP, ProbabilisticActor, ValueOperator
    from torchrl.objectives import ClipPPOLoss
    from torchrl.objectives.value import GAE

STEPS, EPOCHS, MINIBATCH = 64, 6, 1024  # of an agent between two updates; passes over them; samples of a step of Adam


def networks(seen, actions):
    """Actor and critic, for observations and actions with these numbers of columns."""
    mean = MLP(seen, 2 * actions, num_cells=[64, 64], activation_class=nn.Tanh)
    with torch.no_grad():
        mean[-1].weight *= 0.01
        mean[-1].bias[actions:] = -0.5  # of the spread
    module = TensorDictModule(nn.Sequential(mean, NormalParamExtractor()), in_keys=["observation"], out_keys=["loc", "scale"])
    actor = ProbabilisticActor(module, in_keys=["loc", "scale"], distribution_class=IndependentNormal, return_log_prob=True)
    critic = ValueOperator(MLP(seen, 1, num_cells=[64, 64], activation_class=nn.Tanh), in_keys=["observation"])
    return actor, critic


def train(env, actor, critic, steps):
    """Trains actor and critic for this number of agent-steps."""
    frames = STEPS * env.batch_size[0]
    collector = Collector(env, actor, frames_per_batch=frames, total_frames=max(1, steps // frames) * frames,
                          auto_register_policy_transforms=False)
    loss = ClipPPOLoss(actor, critic, clip_epsilon=0.2, entropy_bonus=False, critic_coeff=0.5, normalize_advantage=True,
                       loss_critic_type="l2")
    advantage = GAE(gamma=0.98, lmbda=0.95, value_network=critic)
    adam = torch.optim.Adam(loss.parameters(), 1e-3)
    for rollout in collector:
        with torch.no_grad():
            advantage(rollout)
        rows = rollout.reshape(-1)
        for _ in range(EPOCHS):
            for chosen in torch.randperm(len(rows)).split(MINIBATCH):
                found = loss(rows[chosen])
                adam.zero_grad()
                (found["loss_objective"] + found["loss_critic"]).backward()
                nn.utils.clip_grad_norm_(loss.parameters(), 0.5)
                adam.step()
    collector.shutdown(close_env=False)


def main():
    given = arguments(__doc__)
    torch.set_num_threads(1)  # the networks are small, and the other core steps the world
    torch.manual_seed(given.seed)
    with set_gym_backend("gymnasium"):
        env = GymWrapper(new_env(given.cars, given.seed))
    seen, actions = env.observation_spec["observation"].shape[-1], env.action_spec.shape[-1]
    actor, critic = networks(seen, actions)

    def act(observations):
        with torch.no_grad():
            return actor.module[0](torch.from_numpy(observations))[0].numpy()

    train_and_compare(lambda: train(env, actor, critic, given.steps), act)


if __name__ == "__main__":
    main()
