"""roboss run --ros2 beside a node of ros2-client (Rust): with_run.py says how it is started, with the name rust."""
import json

from harness import Process
from with_run import CLIENTS, WithRun, main

ROBOTS = 20
PLAYING, OK, SUCCEEDED, CANCELED = 1, 1, 4, 5


class Rust(WithRun):
    def visit(self, robot):
        """What the node saw; it drives this robot, and pauses and steps the run."""
        node = Process([CLIENTS / "rust/release/roboss_rust_client", robot])
        self.addCleanup(lambda: node.process.poll() is None and (node.process.kill(), node.process.wait()))
        seen = node.wait_for("", 90)
        self.assertIsNotNone(seen, f"the node said nothing; the run: {self.said()}")
        return json.loads(seen)

    def test_a_node_lists_senses_drives_and_operates(self):
        run = self.start()
        seen = self.visit("turtle_3")
        self.assertEqual([n for n in seen["nodes"] if n != "/rust_visitor"],
                         sorted(["/roboss", *(f"/turtle_{n}/robot" for n in range(ROBOTS))]))
        self.assertEqual(seen["topics"]["rt/turtle_3/cmd_vel"], "geometry_msgs::msg::dds_::Twist_")
        self.assertEqual(seen["topics"]["rt/tf"], "tf2_msgs::msg::dds_::TFMessage_")
        self.assertEqual((seen["ranges"], seen["frame"]), (360, "turtle_3/base_link/lidar"))
        self.assertGreater(seen["moved"], 0.1, "m")
        self.assertEqual(len(seen["clock"]), 20)
        self.assertEqual(seen["clock"], sorted(set(seen["clock"])))
        self.assertIs(seen["use_sim_time"], True)
        done = seen["operated"]
        self.assertIsNotNone(done, self.said())
        self.assertEqual((done["state"], done["pause"], done["play"]), (PLAYING, OK, OK))
        self.assertEqual(done["steps"], {"accepted": True, "status": SUCCEEDED, "result": OK, "sums": [500]})
        self.assertEqual(done["cancel"], {"accepted": True, "code": 0, "status": CANCELED})
        self.assertIsNone(run.poll())


if __name__ == "__main__":
    main(Rust)
