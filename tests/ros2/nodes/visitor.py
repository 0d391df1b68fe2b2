"""A node of rclpy that looks at a world of RoBOSS and drives one of its robots. Prints what it saw as JSON.

Usage: visitor.py ROBOT      the robot has a drive, a lidar, an IMU and odometry
"""
import json
import sys
import time

import rclpy
import rclpy.node
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rcl_interfaces.srv import GetParameters
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu, JointState, LaserScan
from std_msgs.msg import String


def stamp(message):
    return message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec


class Visitor(rclpy.node.Node):
    def __init__(self, robot):
        super().__init__("visitor")
        self.robot = robot
        self.got = {}
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        for topic, kind, qos in (("/clock", Clock, 10),
                                 (f"/{robot}/scan", LaserScan, qos_profile_sensor_data), (f"/{robot}/imu", Imu, 10),
                                 (f"/{robot}/odom", Odometry, 10), (f"/{robot}/joint_states", JointState, 10),
                                 (f"/{robot}/robot_description", String, latched)):
            self.got[topic] = []
            self.create_subscription(kind, topic, self.got[topic].append, qos)
        self.drive = self.create_publisher(Twist, f"/{robot}/cmd_vel", 10)

    def spin_until(self, done, seconds=20.0):
        end = time.monotonic() + seconds
        while not done() and time.monotonic() < end:
            rclpy.spin_once(self, timeout_sec=0.1)
        return done()

    def parameter(self, name):
        """The value of a parameter of the world's node."""
        client = self.create_client(GetParameters, "/roboss/get_parameters")
        if not client.wait_for_service(timeout_sec=5.0):
            return None
        answer = client.call_async(GetParameters.Request(names=[name]))
        self.spin_until(answer.done, 5.0)
        return answer.result().values[0].bool_value if answer.done() else None

    def report(self):
        scan, odometry = (self.got[f"/{self.robot}/{name}"] for name in ("scan", "odom"))
        began = time.monotonic()
        first = self.spin_until(lambda: all(self.got.values()))
        seen_after = time.monotonic() - began
        order = Twist()
        order.linear.x = 0.2
        self.drive.publish(order)
        start = odometry[-1].pose.pose.position if odometry else None
        self.spin_until(lambda: odometry and odometry[-1].twist.twist.linear.x > 0.15, 5.0)
        end = time.monotonic() + 2.0
        self.spin_until(lambda: time.monotonic() > end, 3.0)
        here = odometry[-1].pose.pose.position if odometry else None
        times = [stamp(m) for m in scan]
        info = self.get_publishers_info_by_topic(f"/{self.robot}/scan")
        return {
            "all": first, "missing": [t for t, m in self.got.items() if not m], "seconds": round(seen_after, 2),
            "nodes": sorted(f"{space.rstrip('/')}/{name}" for name, space in self.get_node_names_and_namespaces()),
            "topics": {name: types for name, types in self.get_topic_names_and_types()},
            "moved": 0 if start is None else ((here.x - start.x) ** 2 + (here.y - start.y) ** 2) ** 0.5,
            "scan_steps": [round(b - a, 4) for a, b in zip(times, times[1:])],
            "ranges": len(scan[0].ranges) if scan else 0,
            "frame": scan[0].header.frame_id if scan else "",
            "use_sim_time": self.parameter("use_sim_time"),
            "hash": str(info[0].topic_type_hash) if info else "", "node": info[0].node_name if info else "",
            "description": self.got[f"/{self.robot}/robot_description"][0].data[:300] if first else ""}


def main():
    rclpy.init()
    print(json.dumps(Visitor(sys.argv[1]).report()), flush=True)


main()
