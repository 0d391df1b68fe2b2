#!/usr/bin/env python3
"""Pictures of what was learned: the curve (learning_curve.svg), and cars in the city from above (learning_city.gif).

Usage: picture.py [--seconds 10] [--output FOLDER]; needs matplotlib.
"""
import argparse
import re
from pathlib import Path

import matplotlib
import numpy as np

import roboss
import roboss.envs
from city_features import load

matplotlib.use("svg")
from matplotlib import pyplot  # noqa: E402
from matplotlib.animation import FuncAnimation, PillowWriter  # noqa: E402
from matplotlib.patches import Circle, Rectangle  # noqa: E402

HERE = Path(__file__).parent
SOLID = re.compile(r"<collision name=\"part_\d+\"><pose>([^<]*)</pose><geometry>(.*?)</geometry>")
CAR_M = (0.7, 0.45)  # as drawn: larger than it is
WINDOW_M = (-14, 26, -14, 26)  # of the city that the film shows


def draw_curve(path, hand_written):
    """Speed and metres for each collision over agent-steps, means of ten updates; dashed: the hand-written driver."""
    curve = np.genfromtxt(HERE / "city_curve.csv", delimiter=",", names=True)
    per_update, ones = curve["agent_steps"][0], np.ones(10)
    metres, collisions = (np.convolve(curve[column], ones, "valid") for column in ("metres", "collisions"))
    columns = metres / (10 * per_update * 0.05), np.maximum(metres, 1) / np.maximum(collisions, 1)
    figure, axes = pyplot.subplots(1, 2, figsize=(9, 3.2))
    for axis, column, label, line in zip(axes, columns, ("speed towards the goal, m/s", "metres for each collision"),
                                         hand_written):
        axis.plot(curve["agent_steps"][9:] / 1e6, column, color="#c8501e", label="while learning")
        axis.axhline(line, color="#3a5a7a", linestyle="--", label="hand-written")
        axis.set_xlabel("agent-steps, millions")
        axis.set_title(label, fontsize=10)
    axes[1].set_yscale("log")
    axes[0].legend()
    figure.tight_layout()
    figure.savefig(path)


def solids():
    """Patches of all that stands in the city."""
    found = []
    for pose, shape in SOLID.findall(Path(roboss.example("city.sdf")).read_text(encoding="utf-8")):
        x, y, _, _, _, yaw = map(float, pose.split())
        size = [float(number) for number in re.findall(r"[\d.]+(?=[ <])", shape)]
        if "<cylinder>" in shape:
            found.append(Circle((x, y), size[0], color="#8c8c84"))
        else:
            found.append(Rectangle((x - size[0] / 2, y - size[1] / 2), size[0], size[1], angle=np.degrees(yaw),
                                   rotation_point="center", color="#8c8c84"))
    return found


class Film:
    """Cars from above, ten pictures a second, and the beams of one of them.

    Args:
        driver: gives actions from observations.
        seed: of the environment.
    """

    def __init__(self, driver, seed=7):
        self.driver, self.env = driver, roboss.envs.CityVectorEnv(num_envs=64, autoreset_mode="SameStep")
        self.observations, _ = self.env.reset(seed=seed)
        self.figure, axis = pyplot.subplots(figsize=(4.4, 4.4), dpi=80)
        self.figure.subplots_adjust(0, 0, 1, 1)
        axis.set(xlim=WINDOW_M[:2], ylim=WINDOW_M[2:], facecolor="#d8d8d4", xticks=[], yticks=[])
        for patch in solids():
            axis.add_patch(patch)
        self.cars = [axis.add_patch(Rectangle((0, 0), *CAR_M, rotation_point="center", color="#c8501e"))
                     for _ in range(self.env.num_envs)]
        self.beams, = axis.plot([], [], color="#3a5a7a", linewidth=0.6)
        middle = self.env.task.robots.pose[:, :2] - np.mean(np.reshape(WINDOW_M, (2, 2)), axis=1)
        self.watched = int(np.argmin(np.hypot(*middle.T)))

    def draw(self, _):
        """Drives for a tenth of a second and moves everything in the picture."""
        for _ in range(2):
            self.observations = self.env.step(self.driver(self.observations))[0]
        pose = self.env.task.robots.pose
        yaw = 2 * np.arctan2(pose[:, 5], pose[:, 6])
        for patch, place, angle in zip(self.cars, pose, yaw):
            patch.set_xy(place[:2] - np.divide(CAR_M, 2))
            patch.set_angle(np.degrees(angle))
        start = pose[self.watched, :2]
        angles = yaw[self.watched] + np.linspace(-np.pi / 2, np.pi / 2, 21)
        ranges = 6 * self.observations[self.watched, :21, None]
        ends = start + ranges * np.stack([np.cos(angles), np.sin(angles)], axis=1)
        self.beams.set_data(*np.stack([np.broadcast_to(start, ends.shape), ends], axis=1).reshape(-1, 2).T)
        return [*self.cars, self.beams]

    def save(self, path, seconds):
        """Writes a GIF."""
        FuncAnimation(self.figure, self.draw, frames=round(seconds * 10), init_func=lambda: []).save(path, PillowWriter(fps=10))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--hand-written", type=float, nargs=2, default=[1.32, 414],
                        help="what compare_city.py says of it: m/s, metres for each collision")
    parser.add_argument("--output", type=Path, default=HERE)
    given = parser.parse_args()
    draw_curve(given.output / "learning_curve.svg", given.hand_written)
    Film(load(HERE / "city_policy.npz")).save(given.output / "learning_city.gif", given.seconds)


if __name__ == "__main__":
    main()
