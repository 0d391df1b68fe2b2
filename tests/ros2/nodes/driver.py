"""A node of rclpy that drives one robot until its odometry shows it. Prints what it saw as JSON, and leaves.

Usage: driver.py CMD_VEL Twist|TwistStamped ODOM [--scan SCAN] [--stop]      seconds: from its first message until it moves, and
with --stop until it stands again
"""
import argparse
import json
import time

import rclpy
from geometry_msgs.msg import Twist, TwistStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

SPEED = 0.2  # m/s
PATIENCE = 20  # s


class Driver(Node):
    def __init__(self, o):
        super().__init__("driver")
        self.scans, self.odometry = [], []
        self.is_stamped = o.kind == "TwistStamped"
        self.create_subscription(Odometry, o.odom, self.odometry.append, 10)
        if o.scan:
            self.create_subscription(LaserScan, o.scan, self.scans.append, qos_profile_sensor_data)
        self.commands = self.create_publisher(TwistStamped if self.is_stamped else Twist, o.cmd_vel, 10)

    def speed(self):
        return self.odometry[-1].twist.twist.linear.x

    def drive(self, speed):
        """Publishes until the robot has this speed; the seconds that it took, or nothing."""
        order = TwistStamped() if self.is_stamped else Twist()
        (order.twist if self.is_stamped else order).linear.x = speed
        begin, due = time.monotonic(), 0.0
        while (now := time.monotonic()) < begin + PATIENCE:
            if now >= due:
                self.commands.publish(order)
                due = now + 0.1
            rclpy.spin_once(self, timeout_sec=0.05)
            if abs(self.speed() - speed) < 0.1 * SPEED:
                return round(time.monotonic() - begin, 2)
        return None

    def wait_for(self, messages):
        end = time.monotonic() + PATIENCE
        while not messages and time.monotonic() < end:
            rclpy.spin_once(self, timeout_sec=0.1)
        return bool(messages)


def main():
    arguments = argparse.ArgumentParser()
    for name in ("cmd_vel", "kind", "odom", "--scan"):
        arguments.add_argument(name)
    arguments.add_argument("--stop", action="store_true")
    o = arguments.parse_args()
    rclpy.init()
    node = Driver(o)
    seen = {"odometry": node.wait_for(node.odometry), "seconds": None, "stopped": None}
    if seen["odometry"]:
        seen["seconds"] = node.drive(SPEED)
        if o.stop:
            seen["stopped"] = node.drive(0.0)
    if o.scan and node.wait_for(node.scans):
        seen.update(ranges=len(node.scans[-1].ranges), frame=node.scans[-1].header.frame_id)
    print(json.dumps(seen), flush=True)
    node.destroy_node()
    rclpy.shutdown()


main()
