"""tools/peers_report: rows become a table between the marks and a well-formed plot; bad input gets a clear word."""
import json
import os
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

TOOL = Path(os.environ["ROBOSS_TOOLS"]) / "peers_report"


def row(engine, **changes):
    values = {"scene": "cars", "robots": 50, "engine": engine, "settings": "", "skipped": "", "steps": 1000, "us_median": 10.0,
              "us_least": 9.0, "us_most": 11.0, "ratio": 1.0, "real_time_factor": 2.5, "build_s": 0.1, "bytes_per_robot": 4000, "right": True,
              "verdict": "fine"}
    return values | changes


class PeersReport(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def report(self, rows, page="before\n<!-- peers: begin (tools/peers_report) -->\nold\n<!-- peers: end -->\nafter\n"):
        data = {"commit": "abc", "compiler": "GNU", "cpu": "one", "rows": rows}
        (self.folder / "rows.json").write_text(json.dumps(data))
        (self.folder / "page.md").write_text(page)
        return subprocess.run([sys.executable, "-B", TOOL, self.folder / "rows.json", "--page", self.folder / "page.md", "--plot",
                               self.folder / "plot.svg"], capture_output=True, text=True)

    def test_the_table_replaces_only_what_stands_between_the_marks(self):
        ran = self.report([row("RoBOSS"), row("ODE 0.16.2", us_median=35.0, ratio=3.5)])
        self.assertEqual(ran.returncode, 0, ran.stderr)
        page = (self.folder / "page.md").read_text()
        self.assertTrue(page.startswith("before\n") and page.endswith("after\n"))
        self.assertNotIn("old", page)
        self.assertIn("| 35.00 (9.00 to 11.00) | 3.50 | 2.5 | 1000 | 4.0 kB | fine |", page)

    def test_engines_left_out_and_wrong_results_are_shown_as_such(self):
        self.report([row("RoBOSS"), row("Bullet 3", skipped="too slow"), row("DART 6", right=False)])
        page = (self.folder / "page.md").read_text()
        self.assertIn("left out: too slow", page)
        self.assertIn("**wrong**: fine", page)
        self.assertIn("wrong result", (self.folder / "plot.svg").read_text())

    def test_a_second_table_compares_with_the_fastest_peer_that_is_right(self):
        self.report([row("RoBOSS", us_median=2.0), row("RoBOSS-float", us_median=1.0), row("ODE 0.16.2", us_median=35.0),
                     row("Bullet 3", us_median=40.0), row("DART 6", us_median=5.0, right=False)])
        self.assertIn("| cars | 50 | ODE 0.16.2, 35.00 | 17.5 |  |  |  | 35.0 |  |", (self.folder / "page.md").read_text())

    def test_the_plot_is_well_formed(self):
        self.report([row("RoBOSS"), row("ODE <odd>", us_median=200.0)])
        self.assertTrue(xml.etree.ElementTree.parse(self.folder / "plot.svg").getroot().tag.endswith("svg"))

    def test_a_page_without_marks_is_left_alone_and_named(self):
        ran = self.report([row("RoBOSS")], page="no marks\n")
        self.assertNotEqual(ran.returncode, 0)
        self.assertIn("page.md", ran.stderr)
        self.assertEqual((self.folder / "page.md").read_text(), "no marks\n")


if __name__ == "__main__":
    unittest.main()
