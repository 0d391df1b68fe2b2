"""The robot of the README drives the circle that its wheel speeds give.

Arguments: ROBOSS FIRST_ROBOT_LIBRARY WORLD.
"""
import csv
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROBOSS, LIBRARY, WORLD = sys.argv[1:4]
del sys.argv[1:4]

RADIUS, TRACK = 0.1, 0.4  # m, of a wheel and between the wheels
LEFT, RIGHT = 8.0, 10.0  # rad/s
SPEED = RADIUS * (LEFT + RIGHT) / 2
YAW_RATE = RADIUS * (RIGHT - LEFT) / TRACK


def chassis_rows():
    """The trace of the chassis, one row for each 0.5 s, after the start-up."""
    with tempfile.TemporaryDirectory() as folder:
        trace = Path(folder) / "trace.csv"
        subprocess.run([ROBOSS, "run", WORLD, "--client", LIBRARY, "--until", "5", "--headless", "--quiet", "--trace",
                        trace, "--trace-every", "0.5"], check=True, capture_output=True, timeout=300)
        rows = list(csv.DictReader(trace.read_text().splitlines()))
    return [{key: float(value) for key, value in row.items() if key not in ("robot", "link")}
            for row in rows if row["link"] == "chassis" and float(row["time_s"]) > 0.9]


class FirstRobot(unittest.TestCase):
    def test_drives_a_circle(self):
        rows = chassis_rows()
        self.assertGreaterEqual(len(rows), 8)
        for row in rows:
            self.assertAlmostEqual(math.hypot(row["vx"], row["vy"]), SPEED, delta=0.02 * SPEED)
            self.assertAlmostEqual(row["wz"], YAW_RATE, delta=0.02 * YAW_RATE)
            self.assertAlmostEqual(row["z"], RADIUS, delta=1e-3)


if __name__ == "__main__":
    unittest.main()
