"""Frames of roboss run --ros2 as a reader of Cyclone DDS with types of its own sees them: with_run.py says how it is started.

The node of rclpy that drives a robot without a namespace is of Kilted.
"""
import math
import unittest

from with_run import WithRun, main

ROBOTS = 20
LINKS = ("left_wheel", "right_wheel")


def rotated(q, v):
    """v in the axes of a frame, of which q (x y z w) turns them into those of the parent."""
    u, w = q[:3], q[3]

    def cross(a, b):
        return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    t = [2 * c for c in cross(u, v)]
    return [a + w * b + c for a, b, c in zip(v, t, cross(u, t))]


def product(a, b):
    """The product of two quaternions, x y z w."""
    turned = [a[3] * b[i] + b[3] * a[i] for i in range(3)]
    cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    return [*(t + c for t, c in zip(turned, cross)), a[3] * b[3] - sum(a[i] * b[i] for i in range(3))]


class Tree:
    """Frames by child, as tf2 has them."""

    def __init__(self, test, rows):
        self.rows = {}
        for parent, child, *numbers in rows:
            test.assertNotIn(child, self.rows, "it has two parents")
            test.assertAlmostEqual(math.hypot(*numbers[3:]), 1, 9, f"the quaternion of {child}")
            self.rows[child] = (parent, numbers[:3], numbers[3:])

    def chain(self, frame):
        """From a frame to its root."""
        frames = [frame]
        while frames[-1] in self.rows:
            frames.append(self.rows[frames[-1]][0])
            assert len(frames) <= len(self.rows) + 1, f"{frame} is in a circle"
        return frames

    def pose(self, frame):
        """In its root: position and quaternion."""
        at, turn = [0, 0, 0], [0, 0, 0, 1]
        for one in self.chain(frame)[:-1]:
            _, p, q = self.rows[one]
            at, turn = [a + b for a, b in zip(rotated(q, at), p)], product(q, turn)
        return at, turn


class Frames(WithRun):
    def watch(self, tf, cmd_vel, truths):
        seen = self.report_of("tf_watcher.py", tf, tf + "_static", cmd_vel, *truths, client="cyclone")
        self.assertTrue(seen["moving"], f"no time of which there are frames and truths: {self.said()}")
        return seen, Tree(self, seen["fixed"] + seen["moving"])

    def assert_near(self, pose, expected):
        for a, b in zip([*pose[0], *pose[1]], expected):
            self.assertAlmostEqual(a, b, 9)

    def test_the_world_is_one_tree_and_agrees_with_the_ground_truth(self):
        self.start("--ros2-ground-truth")
        names = [f"turtle_{n}" for n in range(ROBOTS)]
        seen, tree = self.watch("/tf", "/turtle_1/cmd_vel", [f"/{name}/ground_truth" for name in ("turtle_1", "turtle_2", "turtle_19")])
        for frame in tree.rows:
            self.assertEqual(tree.chain(frame)[-1], "world")
        for name in names:
            self.assertEqual(tree.chain(f"{name}/base_link/lidar"), [f"{name}/base_link/lidar", f"{name}/base_link", "world"])
            self.assertEqual(tree.chain(f"{name}/odom"), [f"{name}/odom", "world"])
            for link in LINKS:
                self.assertEqual(tree.chain(f"{name}/{link}"), [f"{name}/{link}", f"{name}/base_link", "world"])
        self.assertEqual({child for _, child, *_ in seen["moving"]},
                         {f"{name}/{link}" for name in names for link in ("base_link", *LINKS)})
        for frame, child, *numbers in seen["truths"].values():
            self.assertEqual(frame, "world")
            self.assert_near(tree.pose(child), numbers)

    def test_plain_frames_are_those_of_one_robot_in_its_own_topics(self):
        self.start("--ros2-plain-frames")
        seen, tree = self.watch("/turtle_1/tf", "/turtle_1/cmd_vel", ["/turtle_1/odom"])
        self.assertEqual(set(tree.rows), {"base_link", *LINKS, *(f"base_link/{sensor}" for sensor in ("lidar", "imu"))})
        self.assertEqual(tree.chain("base_link/lidar"), ["base_link/lidar", "base_link", "odom"])
        frame, child, *numbers = seen["truths"]["/turtle_1/odom"]
        self.assertEqual((frame, child), ("odom", "base_link"))
        self.assert_near(tree.pose(child), numbers)

    def test_a_robot_without_a_namespace_is_found_under_the_usual_names(self):
        self.start("--ros2-root", "turtle_1", "--ros2-ground-truth")
        driven = self.report_of("driver.py", "/cmd_vel", "Twist", "/odom", "--scan", "/scan", client="kilted")
        self.assertIsNotNone(driven["seconds"], driven)
        self.assertEqual(driven["ranges"], 360)
        _, tree = self.watch("/tf", "/cmd_vel", ["/ground_truth"])
        self.assertEqual(tree.chain(driven["frame"]), ["base_link/lidar", "base_link", "odom"])
        # The others keep their names, and the root of theirs is the world.
        self.assertEqual(tree.chain("turtle_2/base_link/lidar")[-1], "world")


if __name__ == "__main__":
    main(Frames)
