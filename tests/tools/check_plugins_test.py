"""tools/check_plugins: counts fates by class, judges sensor systems by their sensors, and sees worlds that do not load."""
import json
import os
import stat
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL = Path(os.environ["ROBOSS_TOOLS"]) / "check_plugins"


def plugin(name, fate, count=1, reason=""):
    return {"class": f"gz::sim::systems::{name}", "in": "model", "model": "m", "owner": "", "file": "w.sdf", "line": 1,
            "count": count, "fate": fate, "reason": reason}


class CheckPlugins(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "worlds").mkdir()
        # Stands in for roboss: prints the JSON that lies beside the world.
        self.roboss = self.folder / "roboss"
        self.roboss.write_text('#!/bin/sh\ncat "$3.json"\n')
        self.roboss.chmod(self.roboss.stat().st_mode | stat.S_IXUSR)

    def world(self, name, report, text="<sdf/>"):
        (self.folder / "worlds" / name).write_text(text)
        (self.folder / "worlds" / (name + ".json")).write_text(json.dumps(report))

    def count(self, *arguments):
        ran = subprocess.run([sys.executable, "-B", TOOL, self.folder / "worlds", "--roboss", self.roboss, *arguments],
                             capture_output=True, text=True, check=False)
        rows = {line.split()[0]: line for line in ran.stdout.splitlines()}
        return ran, rows

    def test_copies_count_and_what_draws_does_not(self):
        self.world("a.sdf", {"plugins": [plugin("DiffDrive", "runs", 3), plugin("Physics", "not needed"),
                                         plugin("LiftDrag", "not run", 1, "names the link 'wing', which is not in this robot")]})
        ran, rows = self.count()
        self.assertEqual(ran.returncode, 0, ran.stderr)
        self.assertEqual(rows["DiffDrive"].split()[1:6], ["3", "3", "0", "0", "yes"])
        self.assertIn("1 x names the link '...', which is not in this robot", rows["LiftDrag"])
        self.assertIn("3 of 4 elements", ran.stdout)
        self.assertIn("75.0 %", ran.stdout)

    def test_a_sensor_system_acts_if_its_sensors_give_readings(self):
        self.world("a.sdf", {"plugins": [plugin("Imu", "not needed")], "sensors_without_readings": {"altimeter": 1}})
        self.assertIn("1 of 1 elements", self.count()[0].stdout)
        self.world("b.sdf", {"plugins": [plugin("Altimeter", "not needed")], "sensors_without_readings": {"altimeter": 1}})
        ran, rows = self.count()
        self.assertIn("1 of 2 elements", ran.stdout)
        self.assertIn("sensors of type altimeter give no readings", rows["Altimeter"])

    def test_custom_sensors_count_by_their_kind(self):
        self.world("a.sdf", {"plugins": [plugin("EnvironmentalSystem", "runs")],
                             "sensors_without_readings": {"environmental_sensor/humidity": 1}})
        self.assertIn("0 of 1 elements", self.count()[0].stdout)

    def test_a_world_that_cannot_be_read_counts_against_the_share(self):
        self.world("a.sdf", {"diagnostics": [{"severity": "error", "message": "no 'x'"}]},
                   "<sdf><world><plugin name='gz::sim::systems::Thruster'/><gui><plugin name='Shapes'/></gui></world></sdf>")
        ran, rows = self.count()
        self.assertIn("0 of 1 elements", ran.stdout)
        self.assertIn("its world cannot be read: no '...'", rows["Thruster"])

    def test_messages_between_programs_have_a_line_of_their_own(self):
        self.world("a.sdf", {"plugins": [plugin("AcousticComms", "not run", 1, "none"), plugin("Thruster", "runs")]})
        ran, _ = self.count()
        self.assertIn("1 of 1 elements that move", ran.stdout)
        self.assertIn("1 of 2 with messages", ran.stdout)

    def test_a_share_below_the_least_fails(self):
        self.world("a.sdf", {"plugins": [plugin("DiffDrive", "runs"), plugin("Thruster", "not run", 1, "none")]})
        self.assertEqual(self.count("--least", "0.6")[0].returncode, 1)
        self.assertEqual(self.count("--least", "0.5")[0].returncode, 0)

    def test_a_folder_without_worlds_is_wrong_usage(self):
        self.assertEqual(self.count()[0].returncode, 2)

    def test_every_element_goes_to_the_json_file(self):
        self.world("a.sdf", {"plugins": [plugin("DiffDrive", "runs")]})
        self.count("--json", self.folder / "all.json")
        self.assertEqual(json.loads((self.folder / "all.json").read_text())[0]["fate"], "runs")


if __name__ == "__main__":
    unittest.main()
