"""A node of rclpy that drives robots around obstacles by their scans: one Twist for each scan, by that scan alone.

Usage: wanderer.py NODE ROBOT [ROBOT ...]   ends when the simulated time is over or on SIGTERM; prints its answers
"""
import signal
import sys

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from sensor_msgs.msg import LaserScan


class Wanderer(Node):
    def __init__(self, name, robots):
        super().__init__(name)
        self.answers = 0
        for robot in robots:
            commands = self.create_publisher(Twist, f"/{robot}/cmd_vel", 10)
            self.create_subscription(LaserScan, f"/{robot}/scan", lambda scan, to=commands: self.drive(scan, to), 10)

    def drive(self, scan, commands):
        beams = len(scan.ranges)
        near = [min(scan.range_max, r) for r in scan.ranges]
        ahead = min(near[beams * 5 // 12: beams * 7 // 12])
        left, right = sum(near[beams // 2:]), sum(near[: beams // 2])
        order = Twist()
        order.linear.x = min(0.3, 0.5 * (ahead - 0.25))
        order.angular.z = (1.5 if left > right else -1.5) * max(0.0, 1.0 - ahead)
        commands.publish(order)
        self.answers += 1


def main():
    rclpy.init()
    node = Wanderer(sys.argv[1], sys.argv[2:])
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    try:
        rclpy.spin(node)
    finally:
        print(f"{sys.argv[1]}: {node.answers} answers", flush=True)


main()
