"""roboss run --ros2 beside nodes of rclpy and Cyclone DDS: with_run.py says how it is started."""
import json
import os
import signal
import socket
import statistics
import subprocess
import time

from harness import BAD_DATAGRAM
from with_run import NAME, ROBOSS, WithRun, main

SCAN = "RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828"
ROBOTS = 20


class Face(WithRun):
    def wanderers(self, count=5):
        each = ROBOTS // count
        return [self.node("wanderer.py", f"wanderer_{n}", *(f"turtle_{n * each + k}" for k in range(each)))
                for n in range(count)]

    def test_a_node_lists_senses_and_drives(self):
        self.start()
        seen = self.report_of("visitor.py", "turtle_3")
        self.assertEqual(seen["missing"], [])
        self.assertEqual([n for n in seen["nodes"] if n != "/visitor"],
                         sorted(["/roboss", *(f"/turtle_{n}/robot" for n in range(ROBOTS))]))
        self.assertEqual(seen["topics"]["/turtle_3/cmd_vel"], ["geometry_msgs/msg/Twist"])
        self.assertEqual(seen["topics"]["/tf"], ["tf2_msgs/msg/TFMessage"])
        self.assertEqual((seen["node"], seen["hash"].lower()), ("robot", SCAN.lower()))
        self.assertEqual((seen["ranges"], seen["frame"]), (360, "turtle_3/base_link/lidar"))
        self.assertGreater(seen["moved"], 0.1, "m")
        self.assertIn('<robot name="turtle_3"', seen["description"])
        # The face looks every 20 ms; on a busy machine it misses some looks, and a scan comes with a later one.
        steps = seen["scan_steps"]
        self.assertTrue(all(abs(step - 0.02 * round(step / 0.02)) < 1e-3 and step > 0 for step in steps), steps)
        self.assertAlmostEqual(statistics.median(steps), 0.1, 3, steps)
        self.assertIs(seen["use_sim_time"], True)

    def test_lockstep_gives_the_same_hash_and_the_replay_needs_no_nodes(self):
        hashes = set()
        for name in ("first", "second"):
            journal = self.folder / f"{name}.journal"
            run = self.start("--ros2-lockstep", "/*/cmd_vel", "--ros2-period", "0.1", "--duration", "3", "--journal", journal,
                             *(["--simulators", "3"] if name == "second" else []), name=name)
            nodes = self.wanderers()
            summary, _ = self.end(run, name)
            hashes.add(summary["state_hash"])
            for node in nodes:
                node.process.kill()
                node.process.wait()
            replay = subprocess.run([ROBOSS, "replay", journal, "--json", "-"], capture_output=True, text=True, check=True)
            self.assertEqual(json.loads(replay.stdout)["state_hash"], summary["state_hash"])
        self.assertEqual(len(hashes), 1)

    def test_a_face_that_dies_is_started_again_and_the_world_goes_on(self):
        run = self.start("--duration", "30")
        first = self.report_of("visitor.py", "turtle_1")
        self.assertEqual(first["missing"], [])
        before = self.faces_of(run)
        for port in range(7400, 7420):  # the ports of its domain: on Fast DDS 2.9.1 this ends it
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
                sender.sendto(BAD_DATAGRAM, ("127.0.0.1", port))
        time.sleep(2)
        for face in self.faces_of(run):
            os.kill(face, signal.SIGKILL)
        time.sleep(2)
        self.assertNotEqual(self.faces_of(run), before)
        self.assertEqual(self.report_of("visitor.py", "turtle_2")["missing"], [])
        self.assertIsNone(run.poll())
        _, log = self.end(run)
        self.assertIn("it is started again [restarted]", log)


class Services(WithRun):
    def test_a_client_of_simulation_interfaces_operates_the_run(self):
        run = self.start("--duration", "1000")
        seen = json.loads(self.node("run_operator.py").wait_for("", 90) or "{}")
        done, failed = 1, 4
        self.assertEqual([seen[name] for name in ("first", "paused", "last")], [1, 2, 1])
        self.assertEqual({name: seen[name][0] for name in ("pause", "step", "spawn", "delete", "play")},
                         dict.fromkeys(("pause", "step", "spawn", "delete", "play"), done), seen)
        self.assertEqual(seen["step while it plays"][0], failed)
        self.assertEqual(seen["again"][0], 101, "NAME_NOT_UNIQUE")
        self.assertNotEqual(seen["unknown"][0], done)
        self.assertIsNone(run.poll())


if __name__ == "__main__":
    main(Services if NAME == "cyclone" else Face)
