"""Walks many spiders at once, each with a gait of its own, and measures how they walk."""
from dataclasses import dataclass

import numpy as np

import roboss

STAND, PERIOD = 0.2, 0.01              # s: before the first step; of control. As in spider_program.cpp
TURN_GAIN, MOST_TURN, TURN_CHANGE = 0.5, 0.25, 1.0   # likewise


@dataclass
class Walk:
    """What N spiders did, (N,) each; from `settled` to the end of the walk but for `fell`."""

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
        gaits: a Gaits. spacing: m, between neighbours, who stand on the y axis; None: they stay where the world has them.
        stagger: m, that each stands further back than the one before.
    """

    def __init__(self, world, gaits, spacing=2.0, stagger=0.0, threads=None):
        self.gaits = gaits
        self.simulation = roboss.Simulation(roboss.load(world), threads=threads)
        self.spiders = self.simulation.robots("spider_*")
        self.spacing, self.stagger, self.ticks = spacing, stagger, round(PERIOD / self.simulation.dt)

    def steps(self, rows, seconds, each_tick_from=np.inf):
        """Walks for `seconds` with gaits (N, numbers), or one for all. Yields the time after each control period; from a
        time on after each tick: torques peak when new targets come, so samples of periods would miss what they cost."""
        spiders, simulation = self.spiders, self.simulation
        simulation.reset()
        rows = np.broadcast_to(rows, (len(spiders), len(self.gaits.names)))
        pose, numbers = spiders.pose.copy(), np.arange(len(spiders))
        if self.spacing is not None:
            pose[:, 0], pose[:, 1] = 0, self.spacing * numbers
        pose[:, 0] -= self.stagger * numbers
        spiders.pose = pose
        turns, orders = np.zeros(len(rows)), None
        for step in range(round(seconds / PERIOD)):
            # Orders take effect a period after the observation, as those of the control program.
            wish = np.clip(-TURN_GAIN * yaw_of(spiders.pose), -MOST_TURN, MOST_TURN)
            turns += np.clip(wish - turns, -TURN_CHANGE * PERIOD, TURN_CHANGE * PERIOD)
            following = self.gaits.targets(rows, (step + 1) * PERIOD - STAND, turns)
            if step > 0:
                spiders.set_joint_targets(orders, mode="position")
            orders = following
            for _ in range(self.ticks if step * PERIOD >= each_tick_from else 1):
                simulation.step(1 if step * PERIOD >= each_tick_from else self.ticks)
                yield simulation.time

    def walk(self, rows, seconds=6.0, settled=3.0):
        """Walks and measures from `settled` on."""
        samples, late, spiders = [], None, self.spiders
        for time in self.steps(rows, seconds, settled):
            if time > settled + 1e-9:
                late = spiders.pose[:, 0].copy() if late is None else late
                samples.append((upright(spiders.pose), spiders.link_pose("trunk")[:, 2].copy(), spiders.joint_velocity.copy(),
                                spiders.joint_effort.copy()))
        up, height, velocity, effort = (np.array(values) for values in zip(*samples))
        quantile = lambda values: np.quantile(np.abs(values), 0.99, axis=0).max(axis=-1)
        power = np.maximum(velocity * effort, 0).sum(axis=2).mean(axis=0)
        return Walk((spiders.pose[:, 0] - late) / ((len(samples) - 1) * self.simulation.dt), (up < 0.5).any(axis=0),
                    np.arccos(np.clip(up, -1, 1)).max(axis=0), height.std(axis=0), quantile(velocity), quantile(effort), power)


def yaw_of(pose):
    x, y, z, w = pose[:, 3:].T
    return np.arctan2(2 * (x * y + w * z), 1 - 2 * (y * y + z * z))


def upright(pose):
    """z of the trunk's vertical axis in the world: 1 upright, 0 on its side."""
    return 1 - 2 * (pose[:, 3]**2 + pose[:, 4]**2)
