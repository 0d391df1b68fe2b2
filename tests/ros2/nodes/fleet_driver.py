"""A node of rclpy that reads and drives all robots by one message, and compares one of them with its own topics. Prints JSON.

Usage: fleet_driver.py ROBOT      of a run with --ros2-fleet and --ros2-ground-truth
"""
import json
import math
import sys
import time

import rclpy
from geometry_msgs.msg import PoseArray
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import JointState, LaserScan
from std_msgs.msg import Float32MultiArray, Float64MultiArray, String

STATE = 13
KEPT = 50  # messages of a topic


def speed_of(index):
    return 0.05 + 0.01 * index


def ahead(row):
    """The speed of a robot in the direction in which it looks, by its row of 13 numbers."""
    qx, qy, qz, qw, vx, vy = *row[3:7], *row[7:9]
    yaw = math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))
    return vx * math.cos(yaw) + vy * math.sin(yaw)


class FleetDriver(Node):
    def __init__(self, robot):
        super().__init__("fleet_driver")
        self.robot = robot
        self.got = {}
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        for topic, kind, qos in (("/fleet/names", String, latched), ("/fleet/states", Float64MultiArray, 10),
                                 ("/fleet/scans", Float32MultiArray, 10), ("/fleet/poses", PoseArray, 10),
                                 ("/fleet/joint_states", JointState, 10), (f"/{robot}/scan", LaserScan, qos_profile_sensor_data),
                                 (f"/{robot}/ground_truth", Odometry, 10)):
            self.got[topic] = []
            self.create_subscription(kind, topic, lambda message, of=topic: self.keep(of, message), qos)
        self.commands = self.create_publisher(Float64MultiArray, "/fleet/cmd_vel", 10)

    def keep(self, topic, message):
        self.got[topic] = self.got[topic][-KEPT:] + [message]

    def spin_until(self, done, seconds=15.0):
        end = time.monotonic() + seconds
        while not done() and time.monotonic() < end:
            rclpy.spin_once(self, timeout_sec=0.1)
        return bool(done())

    def drive(self, count):
        rows = [[speed_of(n), 0.0] if n < count - 1 else [math.nan, math.nan] for n in range(count)]
        self.commands.publish(Float64MultiArray(data=[number for row in rows for number in row]))

    def rows(self, topic, index, width):
        return [list(message.data[index * width:(index + 1) * width]) for message in self.got[topic]]

    def moving(self, index):
        """Rows of one robot that moves."""
        return [row for row in self.rows("/fleet/states", index, STATE) if ahead(row) > 0.8 * speed_of(index)]

    def report(self):
        self.spin_until(lambda: all(self.got.values()) and self.commands.get_subscription_count() > 0)
        missing = [topic for topic, messages in self.got.items() if not messages]
        if missing:
            return {"missing": missing}
        names = self.got["/fleet/names"][0].data.split("\n")
        index = names.index(self.robot)
        self.drive(len(names))

        def same_pose():
            truths = [[*(getattr(m.pose.pose.position, a) for a in "xyz"), *(getattr(m.pose.pose.orientation, a) for a in "xyzw")]
                      for m in self.got[f"/{self.robot}/ground_truth"]]
            return any(row[:7] in truths for row in self.moving(index))

        def pose_in_array():
            poses = [[*(getattr(m.poses[index].position, a) for a in "xyz")] for m in self.got["/fleet/poses"]]
            return any(row[:3] in poses for row in self.moving(index))

        def same_scan():
            scans = [list(message.ranges) for message in self.got[f"/{self.robot}/scan"]]
            return any(row in scans for row in self.rows("/fleet/scans", index, 360))

        def speeds():
            data = self.got["/fleet/states"][-1].data
            return [ahead(data[n * STATE:(n + 1) * STATE]) for n in range(len(names))]

        def layout(topic):
            return [[d.label, d.size, d.stride] for d in self.got[topic][-1].layout.dim]
        agree = {"state_agrees": self.spin_until(same_pose), "pose_agrees": self.spin_until(pose_in_array),
                 "scan_agrees": self.spin_until(same_scan)}
        self.spin_until(lambda: all(abs(speed - speed_of(n)) < 0.01 for n, speed in enumerate(speeds()[:-1])))
        poses = self.got["/fleet/poses"][-1]
        return {**agree, "missing": [], "names": names, "states": layout("/fleet/states"), "scans": layout("/fleet/scans"),
                "poses": [poses.header.frame_id, len(poses.poses)], "joints": len(self.got["/fleet/joint_states"][-1].name),
                "speeds": speeds()}


def main():
    rclpy.init()
    print(json.dumps(FleetDriver(sys.argv[1]).report()), flush=True)


main()
