"""Members that are lost: a Client that dies gets a successor, two of one name are refused; a member that was stopped across the
end of a run, and one without memory or room, end with the reason; no exit code 0 after a failed run."""
import os
import re
import resource
import signal
import time
import unittest
from pathlib import Path

from members import DRIVER, FOLDER, WORLDS, Cluster, embedded

CITY = [WORLDS / "city.sdf", "--duration", 1.2, "--seed", 7]
PILE = [WORLDS / "pile.sdf", "--duration", 1.2]
SOON_S = 10  # every wait is reported within this time
BAD_INPUT, RUN_FAILED = 1, 3


def tick_of(controller):
    """The last tick in the log of a Controller with --log - --log-every 0.1."""
    ticks = re.findall(r"tick=(\d+) event=state", controller.said())
    return int(ticks[-1]) if ticks else 0


def wait_for_tick(controller, tick):
    end = time.monotonic() + 30
    while tick_of(controller) < tick:
        if time.monotonic() > end or controller.process.poll() is not None:
            raise AssertionError(f"it does not get to tick {tick}:\n{controller.said()}")
        time.sleep(0.01)


class Clients(unittest.TestCase):
    LOGGED = ["--log", "-", "--log-every", 0.1]

    def test_a_successor_takes_the_place_of_a_client_that_died(self):
        expected = embedded(*CITY, "--client", DRIVER)  # a program that remembers nothing
        with Cluster() as cluster:
            controller = cluster.controller(*CITY, "--speed", 0.25, "--simulators", 1, "--await-client", "driver", *self.LOGGED)
            cluster.simulator()
            for i in range(3):
                driver = cluster.start("client", DRIVER, "--name", "driver")
                controller.hears("client 'driver' joined", i + 1)
                wait_for_tick(controller, tick_of(controller) + 20)
                if i < 2:
                    driver.kill_only()
                    controller.hears("[client-vanished]", i + 1, SOON_S)
            self.assertEqual(cluster.summary(controller)["state_hash"], expected["state_hash"], controller.said())
            self.assertEqual(driver.end(SOON_S), 0, driver.said())

    def test_two_of_one_name_are_refused(self):
        with Cluster() as cluster:
            controller = cluster.controller(*CITY, "--speed", 0.5, "--simulators", 1, "--await-client", "driver")
            cluster.simulator()
            first = cluster.start("client", DRIVER, "--name", "driver")
            controller.hears("client 'driver' joined")
            second = cluster.start("client", DRIVER, "--name", "driver")
            self.assertEqual(second.end(SOON_S), BAD_INPUT, second.said())
            self.assertIn("[name-taken]", second.said())
            self.assertIn("[name-taken]", controller.said())
            other = cluster.start("client", DRIVER, "--name", "another")
            controller.hears("client 'another' joined")
            cluster.summary(controller)
            self.assertEqual([first.end(SOON_S), other.end(SOON_S)], [0, 0])

    def test_a_failed_run_whose_simulators_are_gone_ends_without_its_save(self):
        file = FOLDER / f"gone-{os.getpid()}.roboss"
        with Cluster() as cluster:
            controller = cluster.controller(*CITY, "--speed", 0.25, "--simulators", 1, "--await-client", "driver", "--save", file, *self.LOGGED)
            simulator = cluster.simulator()
            driver = cluster.start("client", DRIVER, "--name", "driver")
            wait_for_tick(controller, 20)
            driver.kill_only()
            simulator.kill_only()
            self.assertEqual(controller.end(40), RUN_FAILED, controller.said())
            self.assertIn("[no-states]", controller.said())
            self.assertFalse(file.exists())

    def test_one_that_died_without_a_successor_ends_the_run_and_the_same_command_continues_it(self):
        expected = embedded(*CITY, "--client", DRIVER)
        journal = FOLDER / f"lost-{os.getpid()}.journal"
        command = [WORLDS / "city.sdf", "--until", 1.2, "--seed", 7, "--simulators", 1, "--await-client", "driver", "--journal", journal]
        with Cluster() as cluster:
            controller = cluster.controller(*command, "--speed", 0.5, *self.LOGGED)
            simulator = cluster.simulator()
            driver = cluster.start("client", DRIVER, "--name", "driver")
            wait_for_tick(controller, 100)
            driver.kill_only()
            controller.hears("[client-vanished]", 1, SOON_S)
            self.assertEqual(controller.end(20), RUN_FAILED, controller.said())
            self.assertIn("[client-lost]", controller.said())
            self.assertEqual(simulator.end(SOON_S), RUN_FAILED, "no exit code 0 after a failed run")
            self.assertIn("[client-lost]", simulator.said())
        with Cluster() as cluster:
            controller = cluster.controller(*command)
            cluster.simulator()
            cluster.start("client", DRIVER, "--name", "driver")
            self.assertEqual(cluster.summary(controller)["state_hash"], expected["state_hash"], controller.said())

    def test_the_log_says_whom_the_run_waits_for(self):
        with Cluster() as cluster:
            controller = cluster.controller(*CITY, "--simulators", 2, "--await-client", "driver")
            cluster.simulator()
            took = controller.hears("[standstill]", 1, SOON_S + 2)
            self.assertRegex(controller.said(), r"waits for 1 Simulators to join, client 'driver' \[standstill\]")
            self.assertLess(took, SOON_S)


class Simulators(unittest.TestCase):
    def test_one_that_was_stopped_across_the_end_of_the_run_ends_with_the_reason(self):
        expected = embedded(*PILE)
        with Cluster() as cluster:
            controller = cluster.controller(*PILE, "--speed", 0.25, "--simulators", 2)
            first, second = cluster.start("simulator"), cluster.start("simulator")
            controller.hears("joined", 2)
            second.process.send_signal(signal.SIGSTOP)
            controller.hears("given up")
            self.assertEqual(cluster.summary(controller)["state_hash"], expected["state_hash"])
            self.assertEqual(first.end(SOON_S), 0)
            time.sleep(1.5)
            second.process.send_signal(signal.SIGCONT)
            self.assertEqual(second.end(SOON_S), 0, second.said())
            self.assertIn("the run is over: its duration was over", second.said())

    def test_one_without_memory_leaves_with_the_reason(self):
        with Cluster() as cluster:
            controller = cluster.controller(WORLDS / "pile.sdf", "--duration", 60, "--speed", 1, "--simulators", 2)
            first, second = cluster.simulator(), cluster.simulator()
            controller.hears("joined", 2)
            pages = int(Path(f"/proc/{second.process.pid}/statm").read_text().split()[0])
            limit = pages * resource.getpagesize()
            resource.prlimit(second.process.pid, resource.RLIMIT_AS, (limit, limit))
            rover = WORLDS.parent / "examples" / "first_robot" / "rover.urdf"
            cluster.start("control", "add", rover, "--name", "cart", "--count", 400, "--grid", "2 2 20", "--pose", "100 0 0.5 0 0 0").end(60)
            self.assertEqual(second.end(30), RUN_FAILED, second.said() + controller.said())
            self.assertIn("[out-of-memory]", second.said())
            quit = cluster.start("control", "quit", "--yes")
            self.assertEqual(quit.end(20), 0, quit.said())
            controller.end(20)
            self.assertEqual(first.end(SOON_S), 0, first.said())

    def test_those_who_die_while_their_states_are_fetched_hold_up_nothing(self):
        world = [WORLDS / "pile.sdf", "--until", 8]
        expected, dt_s, least = embedded(*world)["state_hash"], 0.002, 4
        with Cluster() as cluster:
            controller = cluster.controller(*world, "--simulators", 2, "--trace", os.devnull, "--trace-every", dt_s)
            simulators = [cluster.simulator(), cluster.simulator()]
            controller.hears("joined", 2)
            killed = 0
            while controller.process.poll() is None and killed < 12:
                time.sleep(0.05)
                simulators.append(cluster.simulator())
                try:
                    controller.hears("joined", 3 + killed, SOON_S)
                except AssertionError:
                    if controller.process.poll() is None:
                        raise
                    break  # the run was over first
                simulators.pop(0).kill_only()
                killed += 1
            self.assertEqual(cluster.summary(controller)["state_hash"], expected, controller.said())
            self.assertGreaterEqual(killed, least)

    def test_a_request_for_states_that_died_is_refused_and_granted_later(self):
        file, at_end = f"later-{os.getpid()}.roboss", FOLDER / f"end-{os.getpid()}.roboss"
        with Cluster() as cluster:
            controller = cluster.controller(*PILE, "--speed", 0.2, "--simulators", 1, "--save", at_end, "--save-folder", FOLDER, *Clients.LOGGED)
            simulator = cluster.simulator()
            wait_for_tick(controller, 20)
            self.assertEqual(cluster.start("control", "pause").end(20), 0)
            simulator.kill_only()
            refused = cluster.start("control", "save", file)
            self.assertNotEqual(refused.end(2 * SOON_S), 0)
            self.assertIn("[no-states]", refused.said())
            self.assertIn("1 Simulators to join [standstill]", controller.said())
            simulator = cluster.simulator()
            controller.hears("joined", 2)
            granted = cluster.start("control", "save", file)
            self.assertEqual(granted.end(SOON_S), 0, granted.said())
            self.assertTrue((FOLDER / file).exists())
            beyond = tick_of(controller) + 5
            self.assertEqual(cluster.start("control", "step", 5).end(SOON_S), 0)
            wait_for_tick(controller, beyond)
            simulator.kill_only()
            controller.process.send_signal(signal.SIGINT)
            self.assertEqual(controller.end(2 * SOON_S), RUN_FAILED, controller.said())
            self.assertIn("[no-states]", controller.said())

    def test_one_that_finds_no_room_is_told_so(self):
        with Cluster() as cluster:
            few = lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (32, 32))
            controller = cluster.controller(*PILE, "--simulators", 64, "--headless", preexec_fn=few)
            controller.hears("[waiting]")
            began, members = time.monotonic(), [cluster.start("simulator", "--threads", 1) for _ in range(30)]
            refused = []
            while len(refused) < 3 and time.monotonic() < began + 40:
                refused = [member for member in members if member.process.poll() is not None]
                time.sleep(0.05)
            print(f"    measured: {len(refused)} of 30 refused after {time.monotonic() - began:.1f} s")
            self.assertGreaterEqual(len(refused), 3, controller.said())
            for member in refused:
                self.assertEqual(member.process.poll(), BAD_INPUT)
                self.assertIn("[no-room]", member.said())
            self.assertIn("[no-room]", controller.said())


if __name__ == "__main__":
    unittest.main()
