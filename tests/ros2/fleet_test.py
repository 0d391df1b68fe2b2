"""Driving twenty robots from rclpy: all in one message, and by both types of velocities. with_run.py says how it is started."""
from with_run import WithRun, main

ROBOTS = 20


class Fleet(WithRun):
    def test_all_robots_in_one_message_are_those_of_their_own_topics(self):
        self.start("--ros2-fleet", "--ros2-ground-truth")
        seen = self.report_of("fleet_driver.py", "turtle_3")
        self.assertEqual(sorted(seen["names"]), sorted(f"turtle_{n}" for n in range(ROBOTS)))
        self.assertEqual(seen["states"], [["robot", ROBOTS, ROBOTS * 13], ["state", 13, 13]])
        self.assertEqual(seen["scans"], [["robot", ROBOTS, ROBOTS * 360], ["beam", 360, 360]])
        self.assertEqual(seen["poses"], ["world", ROBOTS])
        self.assertEqual(seen["joints"], 2 * ROBOTS)
        for name in ("state_agrees", "pose_agrees", "scan_agrees"):
            self.assertTrue(seen[name], f"{name}: {seen}")
        # Each robot has its own speed; the last gets NaN, which is no order.
        for n, speed in enumerate(seen["speeds"]):
            self.assertAlmostEqual(speed, 0.05 + 0.01 * n if n < ROBOTS - 1 else 0, delta=0.01, msg=seen["names"][n])


class VelocityTypes(WithRun):
    def test_a_topic_takes_the_type_that_its_node_publishes(self):
        self.start()
        for kind in ("Twist", "TwistStamped", "Twist"):
            with self.subTest(kind):
                seen = self.report_of("driver.py", "/turtle_2/cmd_vel", kind, "/turtle_2/odom", "--stop")
                self.assertIsNotNone(seen["stopped"], f"{seen}; the run: {self.said()}")
                print(f"\n{kind}: it moves {seen['seconds']} s after the first message")
                self.assertLess(seen["seconds"], 5, "s")
        self.assertIn("geometry_msgs/msg/TwistStamped", self.said())


if __name__ == "__main__":
    main(Fleet, VelocityTypes)
