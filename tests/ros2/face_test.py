"""roboss run --ros2 beside nodes of rclpy and Cyclone DDS, on a network of their own that has only this host.

Usage: face_test.py ROBOSS WORLD CLIENTS NAME [unittest's words]    NAME: kilted, jazzy or cyclone; CLIENTS: the folder that
tools/ros2_clients.sh made. Exit code 77: it cannot be tried here, and why.
"""
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from harness import BAD_DATAGRAM, CYCLONE_OF_HOST, Process, enter_own_network, python_of

HERE = Path(__file__).resolve().parent
ROBOSS, WORLD, CLIENTS, NAME = Path(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3]), sys.argv[4]
SCAN = "RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828"
ROBOTS = 20


class WithRun(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def start(self, *words, name="run"):
        """A run with a face, whose words on standard error are in a file."""
        log = open(self.folder / f"{name}.log", "w")
        self.addCleanup(log.close)
        run = subprocess.Popen([ROBOSS, "run", WORLD, "--ros2", "--headless", "--json", self.folder / f"{name}.json", *words],
                               stdout=subprocess.DEVNULL, stderr=log)
        self.addCleanup(lambda: run.poll() is None and (run.kill(), run.wait()))
        return run

    def end(self, run, name="run", seconds=120):
        """The summary of a run that ends by itself, and what it said."""
        self.assertEqual(run.wait(timeout=seconds), 0, (self.folder / f"{name}.log").read_text())
        return json.loads((self.folder / f"{name}.json").read_text()), (self.folder / f"{name}.log").read_text()

    def node(self, program, *words):
        python, environment = python_of(CLIENTS / NAME)
        node = Process([python, "-B", HERE / "nodes" / program, *words], {**environment, "CYCLONEDDS_URI": CYCLONE_OF_HOST})
        self.addCleanup(lambda: node.process.poll() is None and (node.process.kill(), node.process.wait()))
        return node

    def wanderers(self, count=5):
        each = ROBOTS // count
        return [self.node("wanderer.py", f"wanderer_{n}", *(f"turtle_{n * each + k}" for k in range(each)))
                for n in range(count)]

    def faces_of(self, run):
        """Ids of the processes that the run started."""
        return [int(pid) for pid in Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text().split()]

    def visit(self, robot):
        seen = self.node("visitor.py", robot).wait_for("", 60)
        self.assertIsNotNone(seen, "the visitor said nothing")
        return json.loads(seen)


class Face(WithRun):
    def test_a_node_lists_senses_and_drives(self):
        self.start()
        seen = self.visit("turtle_3")
        self.assertEqual(seen["missing"], [])
        self.assertEqual([n for n in seen["nodes"] if n != "/visitor"],
                         sorted(["/roboss", *(f"/turtle_{n}/robot" for n in range(ROBOTS))]))
        self.assertEqual(seen["topics"]["/turtle_3/cmd_vel"], ["geometry_msgs/msg/Twist"])
        self.assertEqual(seen["topics"]["/tf"], ["tf2_msgs/msg/TFMessage"])
        self.assertEqual((seen["node"], seen["hash"].lower()), ("robot", SCAN.lower()))
        self.assertEqual((seen["ranges"], seen["frame"]), (360, "turtle_3/base_link/lidar"))
        self.assertGreater(seen["moved"], 0.1, "m")
        self.assertIn('<robot name="turtle_3"', seen["description"])
        steps = seen["scan_steps"]
        self.assertTrue(all(abs(step - 0.1 * round(step / 0.1)) < 1e-3 and step > 0 for step in steps), steps)
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
        first = self.visit("turtle_1")
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
        self.assertEqual(self.visit("turtle_2")["missing"], [])
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
        self.assertNotEqual(seen["nobody"][0], done)
        self.assertIsNone(run.poll())


def main():
    enter_own_network(CLIENTS / NAME)
    tests = unittest.defaultTestLoader.loadTestsFromTestCase(Services if NAME == "cyclone" else Face)
    if len(sys.argv) > 5:
        tests = unittest.TestSuite(test for test in tests if any(word in test.id() for word in sys.argv[5:]))
    sys.exit(not unittest.TextTestRunner(verbosity=2).run(tests).wasSuccessful())


if __name__ == "__main__":
    main()
