"""Radio over processes: the relays of worlds/radio.sdf hear the same, and leave the same hash, as in one process, with
Simulators that are killed and in a replay."""
import re
import subprocess
import unittest

from members import DRIVER, FOLDER, ROBOSS, WORLDS, Cluster, embedded

RADIO = [WORLDS / "radio.sdf", "--duration", 5.2, "--seed", 5]


def heard(text):
    """What rover_3 says that it hears."""
    return re.findall(r"^.*rover_3 hears.*$", text, re.MULTILINE)


class Radio(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with Cluster() as cluster:
            run = cluster.start_plain("run", *RADIO, "--client", DRIVER, "--speed", "max", "--headless",
                                      "--journal", FOLDER / "radio.journal")
            assert run.end() == 0, run.said()
            cls.lines = heard(run.said())
        cls.hash = embedded(*RADIO, "--client", DRIVER)["state_hash"]

    def test_the_last_rover_hears_what_was_passed_on_once_it_sees_round_the_wall(self):
        self.assertGreaterEqual(len(self.lines), 1)
        time_s = float(self.lines[0].split(" s:")[0])
        self.assertGreater(time_s, 3.9, "at 1 m/s it sees past the wall at y = 4 m")
        self.assertLess(time_s, 5.2)
        for line in self.lines:
            self.assertRegex(line, r"hears beacon_\d+ from rover_2, -7[456]\.\d dBm, sent 2 ms before")

    def test_processes_hear_the_same(self):
        with Cluster() as cluster:
            controller = cluster.controller(*RADIO, "--simulators", 2, "--await-client", "relay")
            cluster.simulator(), cluster.simulator()
            relay = cluster.start("client", DRIVER, "--name", "relay")
            self.assertEqual(cluster.summary(controller)["state_hash"], self.hash)
            self.assertEqual(relay.end(10), 0)
            self.assertEqual(heard(relay.said()), self.lines)

    def test_a_killed_simulator_changes_nothing(self):
        with Cluster() as cluster:
            controller = cluster.controller(*RADIO, "--speed", 1.5, "--simulators", 2, "--await-client", "relay")
            first, _ = cluster.simulator(), cluster.simulator()
            relay = cluster.start("client", DRIVER, "--name", "relay")
            controller.hears("joined", 3)
            first.process.kill()
            found = cluster.summary(controller)
            self.assertEqual(found["state_hash"], self.hash, controller.said())
            self.assertGreaterEqual(found["losses"], 1)
            self.assertEqual(relay.end(10), 0)
            self.assertEqual(heard(relay.said()), self.lines)

    def test_orders_of_a_file_send(self):
        orders = [WORLDS / "radio.sdf", "--orders", WORLDS / "radio.jsonl", "--duration", 1]
        self.assertEqual(embedded(*orders, "--processes", 2)["state_hash"], embedded(*orders)["state_hash"])

    def test_a_replay_agrees(self):
        done = subprocess.run([ROBOSS, "journal", "verify", FOLDER / "radio.journal"], capture_output=True, text=True,
                              timeout=120, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
