"""A node of rclpy beside transport_probe, for transport_test.py, which starts it with the Python of a client's environment.

rclpy_peer.py talk         uses all that the probe offers and prints what it saw as one line of JSON
rclpy_peer.py watch        prints "got TEXT" for each message of /chatter; of its input, "call" calls the service and
                           prints "reply TEXT", "quit" ends it
rclpy_peer.py garbage      sends bytes that are no Twist, then one that is; prints the echoes as JSON
rclpy_peer.py other_type   publishes /chatter as another type until its input ends
"""
import json
import select
import sys
import time

import rclpy
from geometry_msgs.msg import Twist
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Image
from std_msgs.msg import String
from std_srvs.srv import Trigger

PATIENCE = 15  # s
# Without those that rclpy itself refuses: larger than any Twist. A writer of rclpy that sends no bytes at all is not heard
# any more by readers of Fast DDS 2.9; others are.
GARBAGE = [b"\xff" * 4, b"\x00\x01\x00\x00", b"\x00\x01\x00\x00" + b"\xff" * 20, b"\x00\x03\x00\x00" + bytes(48), bytes(range(52))]


def say(*words):
    print(*words, flush=True)


def spin_until(node, condition, seconds=PATIENCE):
    end = time.monotonic() + seconds
    while not condition() and time.monotonic() < end:
        rclpy.spin_once(node, timeout_sec=0.02)
    return condition()


def endpoint(info):
    return {"node": info.node_namespace.rstrip("/") + "/" + info.node_name, "type": info.topic_type, "hash": str(info.topic_type_hash),
            "reliable": info.qos_profile.reliability == ReliabilityPolicy.RELIABLE,
            "latched": info.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL}


def talk(node):
    seen = {"chatter": [], "quick": [], "latched": [], "images": [], "echo": [], "replies": []}
    best_effort = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    node.create_subscription(String, "/chatter", lambda message: seen["chatter"].append(message.data), 10)
    node.create_subscription(String, "/chatter", lambda message: seen["quick"].append(message.data), best_effort)
    node.create_subscription(String, "/car_3/robot_description", lambda message: seen["latched"].append(message.data), latched)
    node.create_subscription(Image, "/car_3/image_raw", lambda message: seen["images"].append(len(message.data)), 2)
    node.create_subscription(Twist, "/car_3/echo", lambda message: seen["echo"].append(message.linear.x), 10)
    orders = node.create_publisher(Twist, "/car_3/cmd_vel", 10)
    client = node.create_client(Trigger, "/car_3/reset")
    client.wait_for_service(PATIENCE)
    spin_until(node, lambda: node.count_subscribers("/car_3/cmd_vel") and node.count_publishers("/car_3/echo"))
    for _ in range(20):
        start = time.monotonic()
        reply = client.call_async(Trigger.Request())
        spin_until(node, reply.done)
        seen["replies"].append(reply.result().message if reply.done() else None)
        seen["call_ms"] = (time.monotonic() - start) * 1e3
    # Matching takes both sides a moment; a first message may be early.
    spin_until(node, lambda: orders.publish(Twist()) or seen["echo"])
    seen["echo"].clear()
    spin_until(node, lambda: False, 0.3)
    seen["echo"].clear()
    for number in range(1, 11):
        order = Twist()
        order.linear.x = float(number)
        orders.publish(order)
    spin_until(node, lambda: len(seen["echo"]) >= 10 and len(seen["images"]) >= 3 and len(seen["quick"]) >= 3)
    seen["nodes"] = sorted(space.rstrip("/") + "/" + name for name, space in node.get_node_names_and_namespaces())
    seen["topics"] = dict(node.get_topic_names_and_types())
    seen["services"] = dict(node.get_service_names_and_types())
    seen["of_driver"] = dict(node.get_subscriber_names_and_types_by_node("driver", "/car_3"))
    seen["writers"] = {topic: [endpoint(info) for info in node.get_publishers_info_by_topic(topic)]
                       for topic in ("/chatter", "/car_3/robot_description")}
    seen["readers"] = [endpoint(info) for info in node.get_subscriptions_info_by_topic("/car_3/cmd_vel")]
    say(json.dumps(seen))


def watch(node):
    node.create_subscription(String, "/chatter", lambda message: say("got", message.data), 10)
    client = node.create_client(Trigger, "/car_3/reset")
    say("watching")
    while True:
        rclpy.spin_once(node, timeout_sec=0.05)
        if not select.select([sys.stdin], [], [], 0)[0]:
            continue
        if sys.stdin.readline().strip() != "call":
            return
        client.wait_for_service(PATIENCE)
        reply = client.call_async(Trigger.Request())
        say("reply", reply.result().message if spin_until(node, reply.done) else None)


def garbage(node):
    echo = []
    node.create_subscription(Twist, "/car_3/echo", lambda message: echo.append(message.linear.x), 100)
    orders = node.create_publisher(Twist, "/car_3/cmd_vel", 100)
    spin_until(node, lambda: orders.publish(Twist()) or echo)
    for bytes_ in GARBAGE:
        orders.publish(bytes_)
    order = Twist()
    order.linear.x = 42.0
    orders.publish(order)
    spin_until(node, lambda: 42.0 in echo)
    say(json.dumps(echo))


def other_type(node):
    publisher = node.create_publisher(Twist, "/chatter", 10)
    say("publishing")
    while not select.select([sys.stdin], [], [], 0)[0]:
        publisher.publish(Twist())
        time.sleep(0.1)


def main():
    what = sys.argv[1]
    rclpy.init()
    node = rclpy.create_node("peer")
    {"talk": talk, "watch": watch, "garbage": garbage, "other_type": other_type}[what](node)
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
