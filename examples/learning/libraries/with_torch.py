#!/usr/bin/env python3
"""The cars of one city learn with PPO in one file of torch, in the manner of CleanRL: nothing stands between the
environment and the loop.

Arrays of the environment become tensors without a copy (torch.from_numpy).

Usage: with_torch.py [--steps 150000] [--cars 64] [--seed 1]
"""
from city_cars import arguments, needed, new_env, train_and_compare

with needed():
    import numpy as np
    import torch
    from torch import nn
    from torch.distributions import Normal

STEPS, EPOCHS, MINIBATCH = 64, 6, 1024  # of an agent between two updates; passes over them; samples of a step of Adam
DISCOUNT, TRACE, CLIP, RATE = 0.98, 0.95, 0.2, 1e-3


def network(inputs, outputs, last_gain):
    """Two hidden layers of tanh; the last layer's weights are of this size."""
    layers = [nn.Linear(inputs, 64), nn.Tanh(), nn.Linear(64, 64), nn.Tanh(), nn.Linear(64, outputs)]
    for layer in layers[::2]:
        nn.init.orthogonal_(layer.weight, last_gain if layer is layers[-1] else np.sqrt(2))
        nn.init.zeros_(layer.bias)
    return nn.Sequential(*layers)


class Agent(nn.Module):
    """Actor, critic, and the spread of the actions that are tried."""

    def __init__(self, env):
        super().__init__()
        seen, actions = env.single_observation_space.shape[0], env.single_action_space.shape[0]
        self.actor, self.critic = network(seen, actions, 0.01), network(seen, 1, 1.0)
        self.log_spread = nn.Parameter(torch.full((actions,), -0.7))

    def actions_of(self, seen):
        """The distribution of actions for each observation."""
        return Normal(self.actor(seen), self.log_spread.exp())

    def value(self, seen):
        """What is expected from here on, (N,)."""
        return self.critic(seen).squeeze(-1)

    def act(self, observations):
        """Actions of an agent that tries nothing out, as numpy arrays."""
        with torch.no_grad():
            return self.actor(torch.from_numpy(observations)).numpy()


class Rollout:
    """What all agents lived through between two updates: tensors (steps, N, ...)."""

    def __init__(self, env, agent, seen):
        count, seen = env.num_envs, torch.from_numpy(seen)
        self.seen = torch.zeros((STEPS, *seen.shape))
        self.actions = torch.zeros((STEPS, *env.action_space.shape))
        self.log_probabilities, self.values, self.rewards, self.ended, self.final = torch.zeros((5, STEPS, count))
        for step in range(STEPS):
            self.seen[step] = seen
            drawn = agent.actions_of(seen)
            self.actions[step] = drawn.sample()
            self.log_probabilities[step] = drawn.log_prob(self.actions[step]).sum(-1)
            self.values[step] = agent.value(seen)
            observations, rewards, terminated, truncated, infos = env.step(self.actions[step].clamp(-1, 1).numpy())
            self.rewards[step] = torch.from_numpy(rewards)
            self.ended[step] = torch.from_numpy(terminated | truncated)
            if truncated.any():  # the episode would have gone on
                last = torch.from_numpy(np.stack(infos["final_obs"][truncated]))
                self.final[step, torch.from_numpy(truncated)] = agent.value(last)
            seen = torch.from_numpy(observations)
        self.next = observations
        self.last_value = agent.value(seen)

    def advantages(self):
        """Generalised advantage estimates (Schulman and others, 2016), (steps, N)."""
        found, running, following = torch.zeros_like(self.rewards), torch.zeros_like(self.last_value), self.last_value
        for step in reversed(range(STEPS)):
            goes_on = 1 - self.ended[step]
            error = self.rewards[step] + DISCOUNT * (goes_on * following + self.final[step]) - self.values[step]
            running = error + DISCOUNT * TRACE * goes_on * running
            found[step], following = running, self.values[step]
        return found


def update(agent, adam, rollout):
    """Proximal policy optimisation (Schulman and others, 2017) on one rollout."""
    advantages = rollout.advantages()
    rows = [array.flatten(0, 1) for array in (rollout.seen, rollout.actions, rollout.log_probabilities, advantages,
                                              advantages + rollout.values)]
    for _ in range(EPOCHS):
        for chosen in torch.randperm(len(rows[0])).split(MINIBATCH):
            seen, actions, old_log, advantage, returns = (row[chosen] for row in rows)
            advantage = (advantage - advantage.mean()) / (advantage.std() + 1e-8)
            ratio = (agent.actions_of(seen).log_prob(actions).sum(-1) - old_log).exp()
            gained = torch.minimum(ratio * advantage, ratio.clamp(1 - CLIP, 1 + CLIP) * advantage).mean()
            loss = 0.5 * (agent.value(seen) - returns).square().mean() - gained
            adam.zero_grad()
            loss.backward()
            nn.utils.clip_grad_norm_(agent.parameters(), 0.5)
            adam.step()


def train(env, agent, steps, seed):
    """Trains the agent for this number of agent-steps."""
    adam = torch.optim.Adam(agent.parameters(), RATE, eps=1e-5)
    seen, _ = env.reset(seed=seed)
    for _ in range(max(1, steps // (STEPS * env.num_envs))):
        with torch.no_grad():
            rollout = Rollout(env, agent, seen)
        seen = rollout.next
        update(agent, adam, rollout)


def main():
    given = arguments(__doc__)
    torch.set_num_threads(1)  # the networks are small, and the other core steps the world
    torch.manual_seed(given.seed)
    env = new_env(given.cars, given.seed)
    agent = Agent(env)
    train_and_compare(lambda: train(env, agent, given.steps, given.seed), agent.act)


if __name__ == "__main__":
    main()
