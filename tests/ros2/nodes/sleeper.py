"""A node of rclpy that subscribes to the scans of robots and sleeps in each callback. Prints how many it has heard, now and then.

Usage: sleeper.py SECONDS ROBOT [ROBOT ...]
"""
import sys
import time

import rclpy
from sensor_msgs.msg import LaserScan


def main():
    rclpy.init()
    node = rclpy.create_node("sleeper")
    heard = [0]

    def sleep(_):
        time.sleep(float(sys.argv[1]))
        heard[0] += 1
        if heard[0] % 10 == 1:
            print(f"heard {heard[0]}", flush=True)
    for robot in sys.argv[2:]:
        node.create_subscription(LaserScan, f"/{robot}/scan", sleep, 10)
    print("subscribed", flush=True)
    rclpy.spin(node)


main()
