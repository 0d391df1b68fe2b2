"""Walks many spiders at once, each with a gait of its own, and measures how they walk."""
from dataclasses import dataclass

import numpy as np

import roboss

STAND, PERIOD = 0.2, 0.01              # s: before the first step; of control. As in spider_program.cpp
TURN_GAIN, MOST_TURN, TURN_CHANGE = 0.5, 0.25, 1.0   # likewise


@dataclass
class Walk:
    """What N spiders did, (N,) each; from `settled` to the end of the walk but for `way` and `fell`."""

    way: np.ndarray          # m, ahead, since the begin
    speed: np.ndarray        # m/s, ahead
    fell: np.ndarray         # leaned by more than 60 degrees
    lean: np.ndarray         # rad, largest angle of the trunk's vertical
    bounce: np.ndarray       # m, standard deviation of the trunk's height
    joint_speed: np.ndarray  # rad/s, exceeded by the fastest joint 1 % of the time
    torque: np.ndarray       # N m, likewise
    power: np.ndarray        # W, mean positive power of all joints


class Walker:
    """One world of spiders side by side on the ground.

    Args:
        world: text or file of a world of `roboss-world spiders`.
        gaits: a Gaits. spacing: m, between neighbours; 0: they stay where the world has them.
    """

    def __init__(self, world, gaits, spacing=2.0, threads=None):
        self.gaits = gaits
        self.simulation = roboss.Simulation(roboss.load(world), threads=threads)
        self.spiders = self.simulation.robots("spider_*")
        self.spacing, self.ticks = spacing, round(PERIOD / self.simulation.dt)

    def walk(self, rows, seconds=6.0, settled=3.0):
        """Walks for `seconds` with gaits (N, numbers), or one for all, and measures from `settled` on."""
        spiders, simulation = self.spiders, self.simulation
        simulation.reset()
        rows = np.broadcast_to(rows, (len(spiders), len(self.gaits.names)))
        if self.spacing:
            pose = spiders.pose.copy()
            pose[:, 0], pose[:, 1] = 0, self.spacing * np.arange(len(spiders))
            spiders.pose = pose
        turns, begin, samples, late = np.zeros(len(rows)), spiders.pose[:, :2].copy(), [], None
        orders = None
        for step in range(round(seconds / PERIOD)):
            pose = spiders.pose
            # Orders take effect a period after the observation, as those of the control program.
            wish = np.clip(-TURN_GAIN * _yaw(pose), -MOST_TURN, MOST_TURN)
            turns += np.clip(wish - turns, -TURN_CHANGE * PERIOD, TURN_CHANGE * PERIOD)
            following = self.gaits.targets(rows, (step + 1) * PERIOD - STAND, turns)
            if step > 0:
                spiders.set_joint_targets(orders, mode="position")
            simulation.step(self.ticks)
            orders = following
            if (step + 1) * PERIOD >= settled:
                late = spiders.pose[:, :2].copy() if late is None else late
                samples.append((_up(spiders.link_pose("trunk")), spiders.link_pose("trunk")[:, 2].copy(),
                                spiders.joint_velocity.copy(), spiders.joint_effort.copy()))
        return self._measured(begin, late, samples)

    def _measured(self, begin, late, samples):
        up, height, velocity, effort = (np.array(values) for values in zip(*samples))
        way = self.spiders.pose[:, :2]
        quantile = lambda values: np.quantile(np.abs(values), 0.99, axis=0).max(axis=-1)
        power = np.maximum(velocity * effort, 0).sum(axis=2).mean(axis=0)
        return Walk((way - begin)[:, 0], (way - late)[:, 0] / ((len(samples) - 1) * PERIOD), (up < 0.5).any(axis=0),
                    np.arccos(np.clip(up, -1, 1)).max(axis=0), height.std(axis=0), quantile(velocity), quantile(effort), power)


def _yaw(pose):
    x, y, z, w = pose[:, 3:].T
    return np.arctan2(2 * (x * y + w * z), 1 - 2 * (y * y + z * z))


def _up(pose):
    """z of the trunk's vertical axis in the world."""
    return 1 - 2 * (pose[:, 3]**2 + pose[:, 4]**2)
