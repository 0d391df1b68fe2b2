"""Journals with branches: whatever a run went through, all of it can be replayed, compared, exported and continued."""
import csv
import json
import sqlite3
import shutil
import subprocess
import time
import unittest

from running import FOLDER, ROBOSS, RobossTest, roboss

YARD = FOLDER / "yard.sdf"
CRATE = FOLDER / "crate.sdf"
BOX = """<model name="{name}"><pose>{x} 0 0.5 0 0 0</pose><link name="body"><inertial><mass>1</mass>
  <inertia><ixx>.1</ixx><iyy>.1</iyy><izz>.1</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>.4 .4 .4</size></box></geometry></collision></link></model>"""
GROUND = """<model name="ground"><static>true</static><link name="l"><collision name="c"><geometry><plane/></geometry>
  </collision></link></model>"""
SDF = """<?xml version="1.0"?><sdf version="1.9">{}</sdf>"""
YARD.write_text(SDF.format("<world name='yard'><physics name='p' type='x'><max_step_size>.002</max_step_size></physics>"
                           + GROUND + BOX.format(name="old", x=0) + BOX.format(name="gone", x=2) + "</world>"))
CRATE.write_text(SDF.format(BOX.format(name="crate", x=0)))


def seconds(tick):
    return tick * 0.002


class Recorded:
    """A run that was controlled: 0.5 s, three crates, 0.25 s, 'gone' goes, 0.25 s; back to 0.6 s, 0.2 s; from the
    beginning, 0.1 s."""

    def __init__(self):
        self.journal = FOLDER / "branches.journal"
        self.saved = FOLDER / "with_crates.roboss"
        self.name = f"branches_{time.time_ns()}"
        process = subprocess.Popen([ROBOSS, "run", YARD, "--simulation", self.name, "--paused", "--headless", "--quiet",
                                    "--journal", self.journal, "--journal-every", "0.1", "--save-folder", FOLDER],
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.step(250)
        self.ask("add", CRATE, "--name", "crate", "--count", 3, "--grid", "1 1 3", "--pose", "0 2 0 0 0 0")
        self.step(125)
        self.ask("remove", "gone")
        self.ask("save", self.saved)
        self.step(125)
        self.ask("rewind", 0.6)
        self.step(100)
        self.ask("reset")
        self.step(50)
        self.ask("quit")
        out, _ = process.communicate(timeout=120)
        assert process.returncode == 0, out

    def ask(self, *words):
        done = roboss("control", "--simulation", self.name, "--patience", 30, "--json", *words)
        assert done.returncode == 0, f"{words}: {done.stdout}{done.stderr}"
        return json.loads(done.stdout)

    def step(self, ticks):
        tick = self.ask("status")["tick"]
        self.ask("step", ticks)
        give_up = time.monotonic() + 60
        while self.ask("status")["tick"] < tick + ticks:
            assert time.monotonic() < give_up
            time.sleep(0.01)


class Branches(RobossTest):
    @classmethod
    def setUpClass(cls):
        cls.run_ = Recorded()
        cls.journal = cls.run_.journal

    def replayed(self, place, *options):
        """Summary, notices, and the times at which each robot is in the trace."""
        trace, summary = FOLDER / "replay.csv", FOLDER / "replay.json"
        done = roboss("replay", place, "--trace", trace, "--json", summary, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        times = {}
        for row in csv.DictReader(trace.read_text().splitlines()):
            times.setdefault(row["robot"], []).append(float(row["time_s"]))
        return json.loads(summary.read_text()), done, {name: (min(t), max(t)) for name, t in times.items()}

    def test_a_replay_goes_through_all_branches_that_led_there(self):
        summary, done, spans = self.replayed(f"{self.journal}#3")
        self.assertEqual(summary["ticks"], 500)
        self.assertIn("goes through branch 1 to 0.5 s, branch 2 to 0.75 s, branch 3 to 1 s", done.stderr)
        self.assertEqual({name: (round(first, 6), round(last, 6)) for name, (first, last) in spans.items()},
                         {"old": (0, 1), "gone": (0, 0.748), "crate_0": (0.5, 1), "crate_1": (0.5, 1), "crate_2": (0.5, 1)})

    def test_a_replay_says_how_many_checkpoints_were_equal(self):
        summary, done, _ = self.replayed(f"{self.journal}#3")
        self.assertGreater(summary["checkpoints"]["equal"], 3)
        self.assertEqual(summary["checkpoints"]["equal"], summary["checkpoints"]["compared"])
        self.assertIn(f"{summary['checkpoints']['equal']} compared, all equal", done.stdout)

    def test_after_a_rewind_the_abandoned_future_is_not_played(self):
        summary, done, spans = self.replayed(f"{self.journal}#4@0.1")
        self.assertEqual(summary["ticks"], 350)
        self.assertIn("branch 1 to 0.5 s, branch 2 to 0.6 s, branch 4 to 0.8 s", done.stderr)
        self.assertEqual(round(spans["gone"][1], 6), 0.8, "the robot was removed in the future that was left")
        alone, _, _ = self.replayed(f"{self.journal}#1@0.1")
        self.assertEqual(alone["ticks"], 200)

    def test_a_reset_begins_anew(self):
        summary, _, _ = self.replayed(self.journal)
        self.assertEqual((summary["ticks"], summary["sim_time_s"]), (50, 0.1))

    def test_a_time_that_is_elsewhere_is_refused_with_the_branch_that_has_it(self):
        done = self.refused(["replay", f"{self.journal}@0.9"], 1, "[no-such-time]")
        self.assertIn(f"branch 3 has it: {self.journal}#3@0.9", done.stderr)
        self.refused(["replay", f"{self.journal}#3@1.2"], 1, "[no-such-time]")

    def test_all_of_it_is_verified_and_where_a_branch_follows_another(self):
        done = roboss("journal", "verify", self.journal, "--json")
        found = json.loads(done.stdout)
        self.assertTrue(found["good"], done.stdout)
        self.assertEqual([(s["branch"], s["until_tick"], s["next"]) for s in found["stretches"] if s["next"]], [(2, 300, 4)])

    def test_lineages_are_compared(self):
        equal = roboss("diff", f"{self.journal}#2", f"{self.journal}#4")
        self.assertEqual(equal.returncode, 0, equal.stdout + equal.stderr)
        self.assertIn("(ticks 0 to 375)", equal.stdout)
        other = json.loads(roboss("diff", f"{self.journal}#3", f"{self.journal}#4", "--json").stdout)
        self.assertFalse(other["equal"])
        self.assertEqual(other["tick"], 375, "one has 'gone' from there on, the other not")

    def test_an_export_has_the_checkpoints_of_all_branches(self):
        lines = [json.loads(line) for line in roboss("journal", "export", f"{self.journal}#3").stdout.splitlines()]
        self.assertEqual([line["branch"] for line in lines if "parent" in line], [1, 2, 3])
        ticks = [line["checkpoint"] for line in lines if "checkpoint" in line]
        self.assertEqual(ticks, sorted(set(ticks)))
        self.assertIn(0, ticks)

    def test_a_state_saved_after_robots_came_and_went_is_continued(self):
        out = FOLDER / "continued.json"
        done = roboss("run", YARD, "--from", self.run_.saved, "--duration", 0.25, "--headless", "--quiet", "--json", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(json.loads(out.read_text())["state_hash"], roboss("replay", f"{self.journal}#3", "--quiet").stdout)
        from_journal = FOLDER / "from_journal.roboss"
        self.assertEqual(roboss("save", from_journal, "--from", f"{self.journal}#3@0.9").returncode, 0)
        self.assertEqual(roboss("run", YARD, "--from", from_journal, "--duration", 0.1, "--headless", "--quiet").returncode, 0)
        self.refused(["run", CRATE, "--from", self.run_.saved, "--headless"], 1, "[another-world]")

    def test_a_changed_row_is_named(self):
        file = FOLDER / "changed.journal"
        shutil.copy(self.journal, file)
        with sqlite3.connect(file) as db:
            db.execute("UPDATE batches SET planned = planned + 1000000 WHERE rowid = (SELECT max(rowid) FROM batches WHERE branch = 2 AND high < 0)")
        db.close()
        for command in (["journal", "verify", file], ["replay", f"{file}#3"],
                        ["run", YARD, "--journal", file, "--duration", 1, "--headless"]):
            self.refused(command, 1, "[journal-damaged]", "of the log of branch 2 was changed")

    def changed_copy(self, name, *changes):
        file = FOLDER / name
        shutil.copy(self.journal, file)
        with sqlite3.connect(file) as db:
            for change in changes:
                db.execute(change)
        db.close()
        return file

    def test_a_missing_end_is_noticed(self):
        for branch in (1, 5):
            last = f"SELECT max(serial) FROM batches WHERE branch = {branch}"
            file = self.changed_copy("short.journal", f"DELETE FROM checkpoints WHERE branch = {branch} AND serial = ({last}) AND serial > 1",
                                     f"DELETE FROM batches WHERE branch = {branch} AND serial = ({last})")
            for command in (["journal", "verify", file], ["replay", f"{file}#{branch}"]):
                self.refused(command, 1, "[journal-damaged]", f"of the log of branch {branch} is missing")

    def test_an_open_end_is_said(self):
        whole = json.loads(roboss("journal", "verify", self.journal, "--json").stdout)
        self.assertEqual(whole["open_ends"], [])
        file = self.changed_copy("open.journal", "DELETE FROM ends WHERE branch = 5")
        done = roboss("journal", "verify", file)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("branch 5  its end is open", done.stdout)
        self.assertEqual(json.loads(roboss("journal", "verify", file, "--json").stdout)["open_ends"], [5])

    def test_damage_that_a_replay_meets_late_is_wrong_input_too(self):
        file = self.changed_copy("late.journal", "UPDATE states SET bytes = zeroblob(length(bytes)) WHERE hash = "
                                 "(SELECT states FROM checkpoints WHERE branch = 3 ORDER BY tick LIMIT 1)")
        done = self.refused(["replay", f"{file}#3"], 1, "[journal-damaged]", "the checkpoint at tick 375 of branch 3 was changed")
        self.assertIn("375 steps", done.stdout, "the summary of what was played")

    def test_a_replay_without_checkpoints_does_not_say_that_they_were_equal(self):
        done = roboss("replay", self.run_.saved, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("checkpoints       none to compare", done.stdout)
        self.assertNotIn("all equal", done.stdout)


class Guarded(RobossTest):
    """No output replaces an input or a file of another kind."""

    def test_inputs_are_never_replaced(self):
        world = FOLDER / "copy.sdf"
        shutil.copy(YARD, world)
        hard, soft = FOLDER / "hard.csv", FOLDER / "soft.csv"
        for link, make in ((hard, lambda: hard.hardlink_to(world)), (soft, lambda: soft.symlink_to(world))):
            link.unlink(missing_ok=True)
            make()
        for option in ("--save", "--trace", "--contacts", "--json", "--log", "--picture"):
            for name in (world, hard, soft):
                self.refused(["run", world, option, name, "--duration", 0.01, "--headless"], 1, "[output-is-input]")
        self.assertEqual(world.read_text(), YARD.read_text())

    def test_files_of_another_kind_are_never_replaced(self):
        notes = FOLDER / "notes.txt"
        notes.write_text("remember")
        other = FOLDER / "other.sdf"
        shutil.copy(YARD, other)
        self.refused(["run", YARD, "--log", other, "--duration", 0.01, "--headless"], 1, "[other-kind]")
        for option in ("--trace", "--contacts", "--json", "--log", "--picture", "--save"):
            self.refused(["run", YARD, option, notes, "--duration", 0.01, "--headless"], 1, "nothing else is overwritten")
        self.refused(["sense", YARD, "--robot", "old", "--sensor", "x", "-o", YARD], 1)
        self.assertEqual(notes.read_text(), "remember")
        journal = FOLDER / "kept.journal"
        self.assertEqual(roboss("run", YARD, "--journal", journal, "--duration", 0.1, "--headless", "--quiet").returncode, 0)
        self.refused(["run", YARD, "--save", journal, "--duration", 0.01, "--headless"], 1, "[not-a-saved-run]")
        self.refused(["save", journal, "--from", f"{journal}@0.1"], 1, "[output-is-input]")
        self.refused(["replay", journal, "--trace", journal], 1, "[output-is-input]")
        self.assertEqual(roboss("journal", "verify", journal).returncode, 0)

    def test_a_log_is_not_added_to_a_mesh_of_the_world(self):
        mesh, world = FOLDER / "tet.obj", FOLDER / "mesh.sdf"
        mesh.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
        before = mesh.read_text()
        world.write_text(SDF.format("<world name='w'>" + BOX.format(name="tet", x=0).replace(
            "<box><size>.4 .4 .4</size></box>", "<mesh><uri>tet.obj</uri></mesh>") + "</world>"))
        for option in ("--log", "--trace", "--json"):
            self.refused(["run", world, option, mesh, "--duration", 0.01, "--headless"], 1, "[other-kind]")
        self.assertEqual(mesh.read_text(), before)

    def test_older_outputs_of_the_same_kind_are_replaced(self):
        options = ["--trace", FOLDER / "t.csv", "--contacts", FOLDER / "c.csv", "--json", FOLDER / "s.json",
                   "--log", FOLDER / "l.log", "--picture", FOLDER / "p.svg", "--save", FOLDER / "s.roboss"]
        for _ in range(2):
            done = roboss("run", YARD, *options, "--duration", 0.02, "--headless", "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
        ends = [line for line in (FOLDER / "l.log").read_text().splitlines() if " event=end " in line]
        self.assertEqual(len(ends), 2, "a log is added to")

    def test_two_outputs_have_two_files(self):
        self.refused(["run", YARD, "--trace", FOLDER / "one.csv", "--contacts", FOLDER / "one.csv", "--duration", 0.01,
                      "--headless"], 1, "[output-twice]")


if __name__ == "__main__":
    unittest.main()
