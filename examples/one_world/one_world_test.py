"""Cells, spiders and a match in one world: the same bits for one Simulator, for four, and for four processes.

Arguments: ROBOSS ROBOSS_WORLD, then the six libraries of control programs.
"""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROBOSS, ROBOSS_WORLD, *LIBRARIES = sys.argv[1:9]
del sys.argv[1:9]
CLIENTS = [word for library in LIBRARIES for word in ("--client", library)]


class OneWorld(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.world = self.folder / "one_world.sdf"
        subprocess.run([sys.executable, "-B", Path(__file__).with_name("one_world.py"), "--roboss-world", ROBOSS_WORLD,
                        "--cells", "2", "--spiders", "6", "-o", self.world], check=True, capture_output=True, timeout=120)

    def hash_of(self, *options):
        summary = self.folder / "summary.json"
        subprocess.run([ROBOSS, "run", self.world, *CLIENTS, "--duration", "1.5", "--headless", "--quiet", "--json", summary, *options],
                       check=True, capture_output=True, timeout=300)
        return json.loads(summary.read_text())["state_hash"]

    def test_is_a_world_without_findings(self):
        done = subprocess.run([ROBOSS, "check", self.world], capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0)
        self.assertIn("0 errors, 0 warnings, 0 notes", done.stdout)

    def test_has_the_same_bits_for_any_number_of_simulators(self):
        one = self.hash_of("--simulators", "1", "--threads", "1")
        self.assertEqual(self.hash_of("--simulators", "4", "--threads", "1"), one)
        self.assertEqual(self.hash_of("--processes", "4"), one)


if __name__ == "__main__":
    unittest.main()
