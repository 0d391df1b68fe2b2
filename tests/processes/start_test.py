"""Many processes start and end with the usual hash; processes that end at the start or never join end the run soon, with
an error code and their own exit code; the run recovers from later losses."""
import os
import re
import signal
import time
import unittest
from pathlib import Path

from members import WORLDS, Cluster, embedded

CROSSROADS = [WORLDS / "crossroads.sdf", "--orders", WORLDS / "crossroads.jsonl", "--duration", 1.2]
ENDLESS = ["run", WORLDS / "pile.sdf", "--headless", "--speed", 0.5, "--log", "-", "--log-every", 0.1]
MANY = 32
MANY_START_S = 60  # on a machine that does much else; 3 s on two idle cores
PROCESSES_FAILED = 4
SOON_S = 15


def children_of(pid):
    try:
        return [int(child) for child in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    except FileNotFoundError:
        return []


def wait_for_children(run, count=1):
    end = time.monotonic() + 20
    while time.monotonic() < end:
        children = children_of(run.process.pid)
        if len(children) >= count:
            return children
        time.sleep(0.002)
    raise AssertionError(f"there are no {count} processes:\n{run.said()}")


def wait_until_it_steps(run):
    end = time.monotonic() + 20
    while not re.search(r"event=state time_s=[0-9.]*[1-9]", run.said()):
        if time.monotonic() > end:
            raise AssertionError(f"it does not step:\n{run.said()}")
        time.sleep(0.01)


class Start(unittest.TestCase):
    def fails_soon(self, run):
        """What it has said when it has ended, soon, by its own exit code."""
        began = time.monotonic()
        self.assertEqual(run.end(SOON_S + 30), PROCESSES_FAILED, run.said())
        took = time.monotonic() - began
        print(f"    measured: it ends after {took:.1f} s")
        self.assertLess(took, SOON_S)
        return run.said()

    def test_many_processes_start_and_end_with_the_hash_of_one(self):
        expected = embedded(*CROSSROADS)
        began = time.monotonic()
        found = embedded(*CROSSROADS, "--processes", MANY)
        took = time.monotonic() - began
        print(f"    measured: {MANY} processes start, run and end in {took:.1f} s")
        self.assertEqual(found["state_hash"], expected["state_hash"])
        self.assertEqual((found["simulators"], found["losses"]), (MANY, 0))
        self.assertLess(took, MANY_START_S)

    def test_one_that_is_killed_at_the_start_is_named(self):
        with Cluster() as cluster:
            run = cluster.start_plain(*ENDLESS, "--processes", 4)
            victim = wait_for_children(run, 3)[2]
            os.kill(victim, signal.SIGKILL)
            said = self.fails_soon(run)
            self.assertRegex(said, rf"process 3 of 4 \(pid {victim}\).*SIGKILL")
            self.assertIn("[process-ended]", said)

    def test_one_that_never_joins_is_named(self):
        with Cluster() as cluster:
            run = cluster.start_plain(*ENDLESS, "--processes", 4)
            victim = wait_for_children(run)[0]
            os.kill(victim, signal.SIGSTOP)
            said = self.fails_soon(run)
            self.assertRegex(said, rf"process 1 of 4 \(pid {victim}\).*SIGSTOP")
            self.assertIn("[not-joined]", said)
            self.assertNotRegex(said, r"process [234] of 4")

    def test_one_that_ends_by_itself_at_the_start_is_shown_with_its_exit_code(self):
        with Cluster() as cluster:
            run = cluster.start_plain(*ENDLESS, "--processes", 2)
            first = wait_for_children(run)[0]
            os.kill(first, signal.SIGTERM)  # it leaves in an orderly way, or is killed if its handler is not installed yet
            self.assertRegex(self.fails_soon(run), rf"process 1 of 2 \(pid {first}\).*( 0|SIGTERM)")

    def test_one_that_dies_later_is_named_and_done_without(self):
        with Cluster() as cluster:
            run = cluster.start_plain(*ENDLESS, "--processes", 3, "--duration", 2)
            run.hears("joined", 3)
            wait_until_it_steps(run)
            victim = children_of(run.process.pid)[1]
            os.kill(victim, signal.SIGKILL)
            self.assertEqual(run.end(), 0, run.said())
            self.assertRegex(run.said(), rf"process \d of 3 \(pid {victim}\).*SIGKILL")

    def test_processes_that_die_again_and_again_end_the_run(self):
        with Cluster() as cluster:
            run = cluster.start_plain(*ENDLESS, "--processes", 2)
            run.hears("joined", 2)
            wait_until_it_steps(run)
            while run.process.poll() is None:
                for child in children_of(run.process.pid):
                    os.kill(child, signal.SIGKILL)
                time.sleep(0.05)
            self.assertEqual(run.end(), PROCESSES_FAILED, run.said())
            self.assertIn("[processes-ended]", run.said())
            self.assertEqual(len(re.findall(r"\[process-restarted\]", run.said())), 3)


if __name__ == "__main__":
    unittest.main()
