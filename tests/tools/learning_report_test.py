"""tools/learning_report: rows become a table between the marks, with MuJoCo's time against ours; bad input is named."""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL = Path(os.environ["ROBOSS_TOOLS"]) / "learning_report"
PAGE = "before\n<!-- learning: begin (tools/learning_report) -->\nold\n<!-- learning: end -->\nafter\n"


def row(engine, cpu_us, threads=1, camera="", cars=64):
    return {"commit": "c0ffee", "cpu": "a processor", "python": "3.11", "mujoco": "4.0", "engine": engine, "threads": threads,
            "cars": cars, "worlds": 2, "camera": camera, "cpu_us_per_agent_step": cpu_us, "spread": 0.05,
            "agent_steps_per_s": 1e6 / cpu_us, "real_time_factor_of_one_core": 3.21, "mean_speed_m_s": 1.3, "collisions": 0}


class LearningReport(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def report(self, rows, page=PAGE, options=()):
        (self.folder / "rows.json").write_text(json.dumps(rows))
        (self.folder / "page.md").write_text(page)
        return subprocess.run([sys.executable, "-B", TOOL, self.folder / "rows.json", "--page", self.folder / "page.md", *options],
                              capture_output=True, text=True)

    def test_the_table_has_both_engines_and_how_many_times_as_long_the_other_takes(self):
        ran = self.report([row("RoBOSS", 100.0), row("RoBOSS", 110.0, threads=2), row("MuJoCo", 250.0),
                           row("RoBOSS", 2000.0, camera="colours")])
        self.assertEqual(ran.returncode, 0, ran.stderr)
        page = (self.folder / "page.md").read_text()
        self.assertTrue(page.startswith("before\n") and page.endswith("after\n"))
        self.assertNotIn("old", page)
        self.assertIn("| 2 x 64 |  | RoBOSS | 100 | 10000 | 3.2 | 1.30 |\n|  |  | MuJoCo | 250 (2.5 times) | 4000 |", page)
        self.assertIn("| 2 x 64 | colours | RoBOSS | 2000 | 500 |", page)
        self.assertIn("| 2 x 64 |  | 10000 | 9091 | 0.91 | 4000 |  |  |", ran.stdout)  # rates by the clock are printed only
        self.assertNotIn("9091", page)

    def test_the_page_gets_rates_by_the_clock_on_request(self):
        rows = [row("RoBOSS", 100.0), row("RoBOSS", 55.0, threads=2), row("MuJoCo", 250.0), row("MuJoCo", 125.0, threads=2)]
        ran = self.report(rows, options=["--clock"])
        self.assertEqual(ran.returncode, 0, ran.stderr)
        self.assertIn("| 2 x 64 |  | 10000 | 18182 | 1.82 | 4000 | 8000 | 2.00 |", (self.folder / "page.md").read_text())

    def test_a_page_without_the_marks_is_refused_and_stays(self):
        ran = self.report([row("RoBOSS", 100.0)], page="no marks\n")
        self.assertNotEqual(ran.returncode, 0)
        self.assertIn("marker lines", ran.stderr)
        self.assertEqual((self.folder / "page.md").read_text(), "no marks\n")


if __name__ == "__main__":
    unittest.main()
