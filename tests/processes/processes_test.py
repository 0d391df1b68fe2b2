"""One world, one hash, for any number of Simulator processes, whoever is killed, hangs, joins or leaves; runs side by side do
not mix; who cannot take part is told why."""
import os
import signal
import time
import unittest
from pathlib import Path

from members import DRIVER, FOLDER, WORLDS, Cluster, embedded

CROSSROADS = [WORLDS / "crossroads.sdf", "--orders", WORLDS / "crossroads.jsonl", "--duration", 1.2]
PILE = [WORLDS / "pile.sdf", "--duration", 1.2]
CITY = [WORLDS / "city.sdf", "--duration", 1.2, "--seed", 7]


def running(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


class Processes(unittest.TestCase):
    def test_one_two_and_four_simulator_processes_give_the_hash_of_one_process(self):
        for world in (CROSSROADS, PILE):
            expected = embedded(*world)
            for count in (1, 2, 4):
                with self.subTest(world=world[0].name, processes=count):
                    found = embedded(*world, "--processes", count)
                    self.assertEqual(found["state_hash"], expected["state_hash"])
                    self.assertEqual(found["model_hash"], expected["model_hash"])
                    self.assertEqual(found["simulators"], count)

    def test_processes_that_take_over_from_late_ones_give_the_hash_of_one_process(self):
        driven = [WORLDS / "city.sdf", "--duration", 4, "--seed", 7, "--client", DRIVER]
        expected = embedded(*driven)
        found = embedded(*driven, "--processes", 3, "--threads", 1)  # only Simulators of one thread are cut short
        self.assertEqual(found["state_hash"], expected["state_hash"])
        self.assertEqual(expected["cuts"], 0, "nobody helps in one process")
        self.assertGreater(found["cuts"], 0, "of some eighty windows in half somebody is cut short")

    def test_a_control_program_in_a_process_of_its_own_drives_as_in_one_process(self):
        expected = embedded(*CITY, "--client", DRIVER)
        with Cluster() as cluster:
            controller = cluster.controller(*CITY, "--simulators", 2, "--await-client", "driver")
            others = [cluster.simulator(), cluster.start("client", DRIVER, "--name", "driver"), cluster.simulator("--threads", 2)]
            self.assertEqual(cluster.summary(controller)["state_hash"], expected["state_hash"])
            self.assertEqual([other.end(10) for other in others], [0, 0, 0], "all end with the run")

    def test_one_killed_one_hanging_one_leaving_and_others_joining_leave_no_trace(self):
        expected = embedded(*CROSSROADS)
        with Cluster() as cluster:
            controller = cluster.controller(*CROSSROADS, "--speed", 0.25, "--simulators", 3)
            first, second, third = (cluster.simulator() for _ in range(3))
            controller.hears("joined", 3)
            second.process.send_signal(signal.SIGSTOP)
            print(f"    measured: a stopped Simulator is missed after {controller.hears('given up'):.3f} s")
            second.process.send_signal(signal.SIGCONT)
            print(f"    measured: and is back after {controller.hears('joined', 4):.3f} s")
            first.process.kill()
            print(f"    measured: a killed one is missed after {controller.hears('given up', 2):.3f} s")
            cluster.simulator()
            controller.hears("joined", 5)
            third.process.send_signal(signal.SIGTERM)
            controller.hears("left at tick")
            self.assertEqual(third.end(10), 0)
            found = cluster.summary(controller)
            self.assertEqual(found["state_hash"], expected["state_hash"], controller.said())
            self.assertGreaterEqual(found["losses"], 2)
            self.assertEqual(found["simulators"], 2)

    def test_runs_side_by_side_never_mix(self):
        expected = [embedded(*world)["state_hash"] for world in (CROSSROADS, PILE)]
        with Cluster() as one, Cluster() as other:
            members = [one.simulator(), other.simulator()]
            controllers = [one.controller(*CROSSROADS), other.controller(*PILE)]
            self.assertEqual([one.summary(controllers[0])["state_hash"], other.summary(controllers[1])["state_hash"]], expected)
            self.assertEqual([member.end(10) for member in members], [0, 0])

    def test_a_controller_killed_and_started_again_finds_its_simulators_waiting(self):
        expected = embedded(*PILE)
        with Cluster() as cluster:
            simulator = cluster.simulator()
            killed = cluster.controller(*PILE, "--speed", 0.2)
            killed.hears("joined")
            killed.kill()
            again = cluster.controller(*PILE)
            self.assertEqual(cluster.summary(again)["state_hash"], expected["state_hash"])
            self.assertEqual(simulator.end(10), 0)

    def test_a_member_that_cannot_join_reports_why(self):
        with Cluster() as cluster:
            waiting = cluster.controller(*PILE)
            waiting.hears("[waiting]")
            second = cluster.controller(*PILE)
            self.assertEqual(second.end(), 1)
            self.assertIn("[controller-exists]", second.said())
            waiting.process.send_signal(signal.SIGINT)
            self.assertEqual(waiting.end(), 130, "Ctrl-C ends one that waits for Simulators")
            alone = cluster.start("simulator", "--patience", 0.3)
            self.assertEqual(alone.end(), 1)
            self.assertIn("[no-controller]", alone.said())
            lost = cluster.start("client", FOLDER / "no_such.so")
            self.assertEqual(lost.end(), 1)
            self.assertIn("no_such.so", lost.said())
            nowhere = cluster.start("simulator", "--keys", "nowhere")
            self.assertEqual(nowhere.end(), 1)
            self.assertIn("nowhere/authority.crt", nowhere.said())

    def test_simulator_processes_die_with_the_process_that_started_them(self):
        before = set(os.listdir("/dev/shm"))
        with Cluster() as cluster:
            run = cluster.start_plain("run", *PILE, "--processes", 2, "--speed", 0.2)
            run.hears("joined", 2)
            pid = run.process.pid
            children = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
            self.assertEqual(len(children), 2)
            run.kill()
            for child in children:
                for _ in range(300):
                    if not running(child):
                        break
                    time.sleep(0.01)
                else:
                    self.fail(f"process {child} outlives the run")
        self.assertEqual([name for name in set(os.listdir("/dev/shm")) - before if "fast" in name.lower()], [], "left in shared memory")


if __name__ == "__main__":
    unittest.main()
