"""tools/table1_report: rows become tables between the marks and a well-formed plot; bad input gets a clear word."""
import json
import os
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

TOOL = Path(os.environ["ROBOSS_TOOLS"]) / "table1_report"
PAGE = "before\n<!-- table1: begin (tools/table1_report) -->\nold\n<!-- table1: end -->\nafter\n"


def row(world, robots, simulators, everything):
    return {"world": world, "robots": robots, "simulators": simulators, "ceiling": 1.0, "stepping": 0.97, "everything": everything, "dearer": 1.01, "speedup": 1.5,
            "step_us": 40.0, "window_ticks": 60.0, "repeated": 0.0, "islands": 50, "migrations": 0.1, "controller_us": 300.0, "frame_bytes": 60.0}


class Table1Report(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def report(self, rows, page=PAGE):
        data = {"send_us": 20, "way_us": 30, "lanes": 1, "rows": rows, "crowd": [{"robots": 1000, "simulators": 12, "window_us": 200, "bytes": 54}],
                "detach_s": 20, "detach": [[1, 40, 2], [2, 80, 1]]}
        wall = {"robots": 2000, "settle": 1, "seconds": 2, "cores": 2, "runs": [{"processes": 1, "wall_s": [10, 11, 9], "step_cpu_s": [9, 10, 8]},
                                                                       {"processes": 2, "wall_s": [5, 6, 5], "step_cpu_s": [9, 9, 9]}]}
        for name, content in {"rows.json": json.dumps(data), "wall.json": json.dumps(wall), "page.md": page}.items():
            (self.folder / name).write_text(content)
        return subprocess.run([sys.executable, "-B", TOOL, self.folder / "rows.json", "--wall", self.folder / "wall.json", "--page",
                               self.folder / "page.md", "--plot", self.folder / "plot.svg"], capture_output=True, text=True)

    def test_tables_stand_between_the_marks_with_the_papers_figures_beside_ours(self):
        ran = self.report([row("city", 50, 1, 0.98), row("city", 50, 12, 0.66), row("city, one island", 50, 12, 0.08)])
        self.assertEqual(ran.returncode, 0, ran.stderr)
        page = (self.folder / "page.md").read_text()
        self.assertTrue(page.startswith("before\n") and page.endswith("after\n"))
        self.assertNotIn("old", page)
        self.assertIn("| 12 | 0.65 | 1.000 | 0.970 | **0.660** | 1.010 |", page)
        self.assertIn("| city, one island | 50 | 12 | 1.500 |", page)
        self.assertIn("| 2 | 5.00 (5.00 to 6.00) | 2.00 | 9.00 |", page)

    def test_counted_and_equal_work_have_columns_where_they_were_measured(self):
        self.report([row("city", 50, 11, 0.71), {**row("city", 50, 12, 0.66), "counted": 0.936, "even": 0.901}, row("city", 2000, 12, 0.97)])
        page = (self.folder / "page.md").read_text()
        self.assertIn("| 12 | 0.65 | 1.000 | 0.970 | 0.936 | 0.901 | **0.660** |", page)
        self.assertIn("| 11 | 0.71 | 1.000 | 0.970 | | | **0.710** |", page)
        self.assertIn("| 12 | 1.000 | 0.970 | **0.970** |", page)
        lines = page.splitlines()
        heads = [i for i, line in enumerate(lines) if line.startswith("| Simulators | p")]
        self.assertEqual(len(heads), 2)
        for i in heads:
            self.assertEqual(len({line.count("|") for line in lines[i:i + 3]}), 1, "head, rule and rows have as many columns")

    def test_the_plot_is_well_formed_and_shows_every_size(self):
        self.report([row("city", 50, 1, 1), row("city", 50, 2, 0.9), row("city", 500, 1, 1), row("city", 500, 2, 0.95)])
        text = "".join(xml.etree.ElementTree.parse(self.folder / "plot.svg").getroot().itertext())
        self.assertIn("500 cars", text)
        self.assertIn("the paper", text)

    def test_a_page_without_marks_and_rows_without_a_city_are_refused(self):
        self.assertIn("lacks the marker lines", self.report([row("city", 50, 1, 1)], page="nothing").stderr)
        self.assertIn("holds no measured city", self.report([row("pile", 50, 1, 1)]).stderr)


if __name__ == "__main__":
    unittest.main()
