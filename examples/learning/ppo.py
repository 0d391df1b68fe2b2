"""Proximal policy optimisation (Schulman and others, 2017) in numpy, for a gymnasium.vector.VectorEnv that starts its
sub-environments again in the same step ("SameStep")."""
from dataclasses import dataclass

import numpy as np

from policy import Adam


@dataclass
class Settings:
    """Of the learning."""

    steps: int = 128           # of each sub-environment between two updates
    epochs: int = 5            # how often an update uses each sample
    minibatch: int = 1024      # samples of a step of Adam
    rate: float = 5e-4         # of Adam, at the beginning; it falls to 5 %
    discount: float = 0.99
    trace: float = 0.95        # lambda of generalised advantage estimation (Schulman and others, 2016)
    clip: float = 0.2
    spreads: tuple[float, float] = (0.3, 0.12)  # most of the actions that are tried, at the beginning and at the end


@dataclass
class Samples:
    """What all sub-environments lived through between two updates; arrays (steps, N, ...)."""

    inputs: np.ndarray
    actions: np.ndarray
    log_probabilities: np.ndarray
    values: np.ndarray
    rewards: np.ndarray
    ended: np.ndarray
    final_values: np.ndarray   # of what was seen last, where time was up; else 0
    last_values: np.ndarray    # (N,), after the last step


class Learner:
    """Learns a policy in an environment.

    Args:
        env: a VectorEnv with autoreset mode "SameStep".
        policy: a Policy, which changes.
        settings: of the learning.
        seed: of the environment and of the actions that are tried.
        features: makes the policy's inputs of observations.
    """

    def __init__(self, env, policy, settings, seed, features=lambda observations: observations):
        self.env, self.policy, self.settings, self.features = env, policy, settings, features
        self.rng = np.random.default_rng(seed)
        self.adam = Adam(policy.parameters)
        self.inputs = features(env.reset(seed=seed)[0])
        self.told = {}  # sums of infos since the last update

    def collect(self):
        """Drives for some steps; Samples."""
        steps, count = self.settings.steps, self.env.num_envs
        rows = {name: np.zeros((steps, count), dtype=np.float32)
                for name in ("log_probabilities", "values", "rewards", "final_values")}
        seen = np.zeros((steps, *self.inputs.shape), dtype=np.float32)
        actions = np.zeros((steps, count, self.env.single_action_space.shape[0]), dtype=np.float32)
        ended = np.zeros((steps, count), dtype=bool)
        self.told = dict.fromkeys(("progress", "collided", "arrived"), 0.0)
        for step in range(steps):
            seen[step] = self.inputs
            actions[step], rows["log_probabilities"][step], rows["values"][step] = self.policy.draw(self.inputs, self.rng)
            observations, rewards, terminated, truncated, infos = self.env.step(np.clip(actions[step], -1, 1))
            self.inputs = self.features(observations)
            rows["rewards"][step], ended[step] = rewards, terminated | truncated
            if truncated.any():
                last = self.features(np.stack(infos["final_obs"][truncated]))
                rows["final_values"][step, truncated] = self.policy.critic(last)[:, 0]
            for name in self.told:
                self.told[name] += float(infos[name].sum())
        return Samples(seen, actions, ended=ended, last_values=self.policy.critic(self.inputs)[:, 0], **rows)

    def update(self, samples, done):
        """Improves the policy by what it lived through; `done` is the part of the learning that is over, 0 to 1."""
        rate = self.settings.rate * max(0.05, 1 - done)
        advantages = advantages_of(samples, self.settings)
        returns = advantages + samples.values
        flat = [array.reshape(-1, *array.shape[2:]) for array in
                (samples.inputs, samples.actions, samples.log_probabilities, advantages, returns)]
        for _ in range(self.settings.epochs):
            order = self.rng.permutation(len(flat[0]))
            for first in range(0, len(order), self.settings.minibatch):
                rows = order[first:first + self.settings.minibatch]
                self.adam.step(self._gradients(*(array[rows] for array in flat)), rate)
        most = self.settings.spreads[0]**(1 - done) * self.settings.spreads[1]**done
        np.minimum(self.policy.log_spread, np.log(most), out=self.policy.log_spread)

    def _gradients(self, inputs, actions, old_log, advantages, returns):
        """Of the loss of PPO: clipped ratio, and squared error of the value."""
        policy, count = self.policy, len(inputs)
        advantages = (advantages - advantages.mean()) / (advantages.std() + 1e-8)
        actor_layers, critic_layers = policy.actor.layers(inputs), policy.critic.layers(inputs)
        spread = np.exp(policy.log_spread)
        noise = (actions - actor_layers[-1]) / spread
        ratio = np.exp(policy.log_probability(noise) - old_log)
        clip = self.settings.clip
        counts = np.where(advantages > 0, ratio < 1 + clip, ratio > 1 - clip)
        by_log = -(advantages * ratio * counts / count)[:, None]  # derivative of the loss by the log probability
        by_value = (critic_layers[-1][:, 0] - returns)[:, None] / count
        by_spread = (by_log * (noise**2 - 1)).sum(axis=0)
        return [*policy.actor.gradients(actor_layers, by_log * noise / spread),
                *policy.critic.gradients(critic_layers, by_value), by_spread]


def advantages_of(samples, settings):
    """Generalised advantage estimates, (steps, N)."""
    found = np.zeros_like(samples.rewards)
    following, running = samples.last_values, np.zeros_like(samples.last_values)
    for step in reversed(range(len(found))):
        goes_on = ~samples.ended[step]
        after = np.where(goes_on, following, samples.final_values[step])
        error = samples.rewards[step] + settings.discount * after - samples.values[step]
        running = error + settings.discount * settings.trace * goes_on * running
        found[step], following = running, samples.values[step]
    return found
