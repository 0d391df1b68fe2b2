"""libroboss_fastdds.so beside nodes of ROS 2 that nobody here wrote, on a network of their own that has only this host.

Usage: transport_test.py PROBE CLIENTS NAME [unittest's words]    NAME: kilted, jazzy or cyclone; CLIENTS: the folder that
tools/ros2_clients.sh made. Exit code 77: it cannot be tried here, and why.
"""
import json
import signal
import socket
import sys
import time
import unittest
from pathlib import Path

from harness import BAD_DATAGRAM, CYCLONE_OF_HOST, PATIENCE, Process, enter_own_network, python_of

HERE = Path(__file__).resolve().parent
PROBE, CLIENTS, NAME = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3]
STRING = "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"
TWIST = "RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a"


def peer(*words, **more):
    """A process with the Python of the client's environment."""
    python, environment = python_of(CLIENTS / NAME)
    return Process([python, "-B", HERE / ("cyclone_peer.py" if NAME == "cyclone" else "rclpy_peer.py"), *words],
                   {**environment, **more})


class WithProbe(unittest.TestCase):
    def start(self, *words):
        probe = Process([PROBE, *words])
        self.addCleanup(probe.end)
        self.assertIsNotNone(probe.wait_for("ready"))
        return probe

    def start_peer(self, *words, **environment):
        started = peer(*words, **environment)
        self.addCleanup(started.end)
        return started

    def stats(self, probe):
        """Megabytes, the longest publish() in ms, messages, calls, subscribers of /chatter."""
        return [float(word) for word in probe.ask("stats").split()]


class Rclpy(WithProbe):
    def test_sees_and_gets_all_that_there_is(self):
        for reach in ("localhost", "subnet"):
            with self.subTest(reach):
                self.start(reach, "image").send("")
                seen = json.loads(self.start_peer("talk").wait_for("", 40))
                self.assertLessEqual({"/talker", "/car_3/driver", "/peer"}, set(seen["nodes"]))
                self.assertEqual(seen["topics"]["/chatter"], ["std_msgs/msg/String"])
                self.assertEqual(seen["topics"]["/car_3/image_raw"], ["sensor_msgs/msg/Image"])
                self.assertEqual(seen["services"]["/car_3/reset"], ["std_srvs/srv/Trigger"])
                self.assertEqual(seen["of_driver"], {"/car_3/cmd_vel": ["geometry_msgs/msg/Twist"]})
                self.assertEqual(seen["writers"]["/chatter"][0], {"node": "/talker", "type": "std_msgs/msg/String", "hash": STRING,
                                                                  "reliable": True, "latched": False})
                self.assertTrue(seen["writers"]["/car_3/robot_description"][0]["latched"])
                self.assertEqual([(info["node"], info["hash"]) for info in seen["readers"]], [("/car_3/driver", TWIST)])
                self.assertEqual(seen["latched"], ["<robot/>"])
                self.assertEqual(seen["echo"], [float(number) for number in range(1, 11)])
                self.assertEqual(len(seen["replies"]), 20)
                self.assertNotIn(None, seen["replies"])
                self.assertEqual(set(seen["images"]), {1_000_000})
                numbers = [int(text.split()[1]) for text in seen["chatter"]]
                self.assertEqual(numbers, list(range(numbers[0], numbers[0] + len(numbers))), "none is lost")
                self.assertGreater(len(seen["quick"]), 2, "a best-effort reader")
                self.doCleanups()

    def test_a_stopped_subscriber_holds_nobody_up_and_goes_on_later(self):
        probe = self.start("image")
        stopped, other = self.start_peer("watch"), self.start_peer("watch")
        self.assertIsNotNone(stopped.wait_for("got"))
        self.assertIsNotNone(other.wait_for("got"))
        stopped.process.send_signal(signal.SIGSTOP)
        self.stats(probe)
        memory = self.stats(probe)[0]
        other.forget()
        time.sleep(8)
        after, longest = self.stats(probe)[:2]
        self.assertLess(longest, 100, "ms of the longest publish()")
        self.assertLess(after - memory, 20, "MB")
        self.assertEqual(probe.ask("confirm 300"), "0")
        self.assertGreater(other.lines.qsize(), 50, "messages of another one in 8 s")
        stopped.process.send_signal(signal.SIGCONT)
        stopped.forget()
        self.assertIsNotNone(stopped.wait_for("got"))
        self.assertEqual(probe.ask("confirm 5000"), "1")

    def test_either_side_may_restart(self):
        probe, watcher = self.start(), self.start_peer("watch")
        self.assertIsNotNone(watcher.wait_for("got"))
        for kill in (False, True):
            if kill:
                probe.process.kill()
            self.assertEqual(probe.end(), -signal.SIGKILL if kill else 0)
            watcher.forget()
            probe = self.start()
            self.assertIsNotNone(watcher.wait_for("got"), "after a restart of ours")
            watcher.send("call")
            self.assertIn("call", watcher.wait_for("reply") or "none")
        watcher.process.kill()
        again = self.start_peer("watch")
        self.assertIsNotNone(again.wait_for("got"), "after a restart of theirs")
        again.send("call")
        self.assertIn("call", again.wait_for("reply") or "none")

    def test_garbage_harms_nobody(self):
        probe = self.start()
        echo = json.loads(self.start_peer("garbage").wait_for("", 40))
        self.assertIn(42.0, echo)
        self.assertEqual(self.stats(probe)[0] < 100, True)

    def test_a_topic_of_another_type_is_told_once(self):
        probe = self.start()
        other = self.start_peer("other_type")
        self.assertIsNotNone(other.wait_for("publishing"))
        notice = probe.wait_for("notice")
        for word in ("/chatter", "geometry_msgs/msg/Twist", TWIST, "std_msgs/msg/String", STRING):
            self.assertIn(word, notice)
        self.assertIsNone(probe.wait_for("notice", 1))
        self.assertEqual(probe.ask("retype"), "other-type")

    def test_nodes_that_come_and_go_leave_nothing_behind(self):
        probe = self.start()
        self.assertIsNotNone(self.start_peer("watch").wait_for("got"))
        probe.ask("churn 50")
        before = float(probe.ask("churn 50"))
        self.assertLess(float(probe.ask("churn 200")) - before, 10, "MB, by nodes of ours")

    def test_a_process_that_a_malformed_datagram_ends_can_be_started_again(self):
        probe, watcher = self.start(), self.start_peer("watch")
        self.assertIsNotNone(watcher.wait_for("got"))
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            for port in range(7400, 7420):
                sender.sendto(BAD_DATAGRAM, ("127.0.0.1", port))
        time.sleep(1)
        code = probe.process.poll()
        print(f"\n{NAME}: after the malformed datagram: " + ("it runs" if code is None else f"it ended with {code}"), file=sys.stderr)
        if code is not None:
            watcher.end()
            watcher = self.start_peer("watch")
            self.start()
        watcher.forget()
        self.assertIsNotNone(watcher.wait_for("got"))


class Cyclone(WithProbe):
    def test_topics_and_its_dialect_of_services(self):
        for reach in ("localhost", "subnet"):
            with self.subTest(reach):
                probe = self.start(reach)
                configuration = {"CYCLONEDDS_URI": CYCLONE_OF_HOST} if reach == "localhost" else {}
                seen = json.loads(self.start_peer("talk", **configuration).wait_for("", 40))
                self.assertEqual(seen["replies"][:6], [[77, number, True, f"call {number}"] for number in range(1, 7)])
                self.assertEqual(seen["latched"], ["<robot/>"])
                self.assertEqual(seen["echo"], [[1, 2]])
                self.assertGreater(len(seen["chatter"]), 0)
                self.stats(probe)
                notices = [line for line in probe.seen if line.startswith("notice")]
                self.assertEqual(len([line for line in notices if "/car_3/cmd_vel" in line and "0" * 64 in line]), 1, notices)
                self.doCleanups()

    def test_participants_that_come_and_go_leave_nothing_behind(self):
        probe = self.start("subnet")
        self.assertIsNotNone(self.start_peer("join", "50").wait_for("", 60))
        before = self.stats(probe)[0]
        self.assertGreaterEqual(int(self.start_peer("join", "200").wait_for("", 90)), 25, "of 200 that met the probe")
        end = time.monotonic() + PATIENCE  # they leave without a word: after 10 s they count as lost
        while self.stats(probe)[4] > 0 and time.monotonic() < end:
            time.sleep(0.5)
        memory, _, _, _, subscribers = self.stats(probe)
        self.assertLess(memory - before, 10, "MB")
        self.assertEqual(subscribers, 0)


def main():
    enter_own_network(CLIENTS / NAME)
    tests = unittest.defaultTestLoader.loadTestsFromTestCase(Cyclone if NAME == "cyclone" else Rclpy)
    if len(sys.argv) > 4:
        tests = unittest.TestSuite(test for test in tests if any(word in test.id() for word in sys.argv[4:]))
    sys.exit(not unittest.TextTestRunner(verbosity=2).run(tests).wasSuccessful())


if __name__ == "__main__":
    main()
