"""Tests of roboss run --ros2 beside nodes of rclpy and Cyclone DDS, on a network of their own that has only this host.

Usage of such a test: TEST ROBOSS WORLD CLIENTS NAME [unittest's words]    NAME: kilted, jazzy or cyclone; CLIENTS: the folder
that tools/ros2_clients.sh made. Exit code 77: it cannot be tried here, and why.
"""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from harness import CYCLONE_OF_HOST, Process, children_of, enter_own_network, python_of

HERE = Path(__file__).resolve().parent
ROBOSS, WORLD, CLIENTS, NAME = Path(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3]), sys.argv[4]


class WithRun(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def start(self, *words, name="run", world=WORLD):
        """A run with a face, whose words on standard error are in a file."""
        log = open(self.folder / f"{name}.log", "w")
        self.addCleanup(log.close)
        run = subprocess.Popen([ROBOSS, "run", world, "--ros2", "--headless", "--json", self.folder / f"{name}.json", *words],
                               stdout=subprocess.DEVNULL, stderr=log)
        self.addCleanup(lambda: run.poll() is None and (run.kill(), run.wait()))
        return run

    def said(self, name="run"):
        return (self.folder / f"{name}.log").read_text()

    def end(self, run, name="run", seconds=120):
        """The summary of a run that ends by itself, and what it said."""
        self.assertEqual(run.wait(timeout=seconds), 0, self.said(name))
        return json.loads((self.folder / f"{name}.json").read_text()), self.said(name)

    def node(self, program, *words, client=NAME):
        python, environment = python_of(CLIENTS / client)
        node = Process([python, "-B", HERE / "nodes" / program, *words], {**environment, "CYCLONEDDS_URI": CYCLONE_OF_HOST})
        self.addCleanup(lambda: node.process.poll() is None and (node.process.kill(), node.process.wait()))
        return node

    def report_of(self, program, *words, client=NAME, seconds=60):
        """The one line of JSON that a node prints."""
        seen = self.node(program, *words, client=client).wait_for("", seconds)
        self.assertIsNotNone(seen, f"{program} said nothing; the run: {self.said()}")
        return json.loads(seen)

    def faces_of(self, run):
        """Ids of the processes that the run started."""
        return children_of(run.pid)


def main(*cases):
    """Runs the tests of these classes whose names have one of the words of the command line."""
    enter_own_network(CLIENTS / NAME)
    tests = [test for case in cases for test in unittest.defaultTestLoader.loadTestsFromTestCase(case)]
    if len(sys.argv) > 5:
        tests = [test for test in tests if any(word in test.id() for word in sys.argv[5:])]
    sys.exit(not unittest.TextTestRunner(verbosity=2).run(unittest.TestSuite(tests)).wasSuccessful())
