"""What the driver that learns makes of its observations, and the driver as a function."""
import numpy as np

from policy import Policy
from roboss.envs import city_view

NEAR_M = 0.5


def features(observations):
    """Inputs of the policy, (N, 50): the observations, and how near each beam ends, in finer steps for what is nearer."""
    ranges = observations[:, :city_view.BEAMS] * np.float32(city_view.RANGE_M / NEAR_M)
    return np.concatenate([observations, np.exp(-ranges)], axis=1)


def new_policy(seed):
    """A policy that has learned nothing."""
    return Policy(city_view.COLUMNS + city_view.BEAMS, 2, np.random.default_rng(seed))


def load(path):
    """The driver that train_city.py saved: actions, (N, 2), from observations, (N, 29)."""
    policy = new_policy(0).load(path)
    return lambda observations: policy(features(observations))
