"""Earlier moments of a run: previews change nothing, bookmarks are kept, a journal with a limit stays small and whole, and a
replay is turned to any time."""
import json
import subprocess
import time
import unittest

from running import FOLDER, ROBOSS, WORLDS, RobossTest, roboss, summary

WORLD = WORLDS / "pile.sdf"


class LiveRun:
    """A run in the background that `roboss control` reaches by its name."""

    count = 0

    def __init__(self, *arguments):
        LiveRun.count += 1
        self.name = f"timeline_{time.time_ns()}_{LiveRun.count}"
        self.summary = FOLDER / f"{self.name}.json"
        self.process = subprocess.Popen(
            [ROBOSS, *map(str, arguments), "--simulation", self.name, "--quiet", "--json", str(self.summary)],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def control(self, *words):
        return roboss("control", "--simulation", self.name, "--patience", 30, "--json", *words)

    def asked(self, *words):
        """The reply; fails if it is a refusal."""
        done = self.control(*words)
        assert done.returncode == 0, f"{words}: {done.stdout}{done.stderr}"
        return json.loads(done.stdout)

    def wait_for(self, time_s):
        while self.asked("status")["time_s"] < time_s:
            time.sleep(0.05)

    def end(self):
        """What --json has."""
        assert self.process.wait(120) == 0, self.process.stderr.read()
        return json.loads(self.summary.read_text())

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()


class Timeline(RobossTest):
    def test_previews_of_a_run_change_nothing(self):
        undisturbed = summary(WORLD, "--until", 9)["state_hash"]
        with LiveRun("run", WORLD, "--headless", "--speed", 1, "--until", 9, "--journal", FOLDER / "seen.journal",
                     "--journal-every", 0.5) as run:
            run.wait_for(0.8)
            run.asked("speed", 0.02)  # the run does not end during these questions, even on a slow machine
            for at in (0.1, 0.734, 0.3, 0.75):
                seen = run.asked("preview", at)
                self.assertTrue(seen["exact"], seen)
                self.assertAlmostEqual(seen["time_s"], at, 6)
                self.assertEqual((seen["branch"], seen["gone"], seen["absent"]), (1, 0, 0))
            late = run.control("preview", 500)
            self.assertEqual((late.returncode, json.loads(late.stdout)["code"]), (3, "no-such-time"))
            self.assertEqual(json.loads(run.control("preview", "#7@0.1").stdout)["code"], "no-branch")
            self.assertLess(run.asked("status")["time_s"], 9)
            run.asked("speed", "max")
            self.assertEqual(run.end()["state_hash"], undisturbed)

    def test_a_robot_that_came_later_is_absent_from_an_earlier_moment(self):
        with LiveRun("run", WORLD, "--headless", "--speed", 1, "--journal", FOLDER / "came.journal") as run:
            run.wait_for(0.5)
            self.assertTrue(run.asked("remove", "arm")["done"])
            seen = run.asked("preview", "#1@0.2")
            self.assertEqual((seen["gone"], seen["absent"], seen["branch"]), (1, 0, 1))
            run.asked("reset")
            run.asked("quit")

    def test_without_a_journal_a_preview_is_refused_with_a_remedy(self):
        with LiveRun("run", WORLD, "--headless", "--speed", 1) as run:
            refused = json.loads(run.control("preview", 0).stdout)
            self.assertEqual(refused["code"], "no-journal")
            self.assertIn("--journal", refused["remedy"])
            run.asked("quit")

    def test_bookmarks_are_kept_in_the_journal(self):
        file = FOLDER / "marks.journal"
        with LiveRun("run", WORLD, "--headless", "--speed", 1, "--journal", file) as run:
            run.wait_for(0.5)
            run.asked("bookmark", "the start", 0.25)
            run.asked("bookmark", "now")
            run.asked("bookmark", "a slip", "#1@0.3")
            run.asked("bookmark", "remove", 3)
            self.assertEqual(json.loads(run.control("bookmark", "later", 99).stdout)["code"], "no-such-time")
            marks = run.asked("timeline")["bookmarks"]
            self.assertEqual([(m["id"], m["name"]) for m in marks], [(1, "the start"), (2, "now")])
            run.asked("quit")
            run.end()
        info = json.loads(roboss("journal", "info", file, "--json").stdout)
        self.assertEqual([(m["branch"], m["name"]) for m in info["bookmarks"]], [(1, "the start"), (1, "now")])
        self.assertEqual(info["bookmarks"][0]["time_s"], 0.25)
        self.assertIn("the start", roboss("journal", "info", file).stdout)

    def test_a_journal_with_a_limit_keeps_the_last_part_whole(self):
        file = FOLDER / "short.journal"
        undisturbed = summary(WORLD, "--until", 4)["state_hash"]
        # Slow enough that nearly every checkpoint is written: a run that is faster than its disk leaves some out.
        found = summary(WORLD, "--until", 4, "--speed", 0.5, "--journal", file, "--journal-every", 0.1, "--journal-keep", "1s")
        self.assertEqual(found["state_hash"], undisturbed)
        branch = json.loads(roboss("journal", "info", file, "--json").stdout)["branches"][0]
        self.assertGreaterEqual(branch["first_s"], 2.6)
        self.assertLessEqual(branch["first_s"], 3.0)
        verified = json.loads(roboss("journal", "verify", file, "--json").stdout)
        self.assertTrue(verified["good"])
        self.assertGreaterEqual(len(verified["stretches"]), 7)
        self.refused(["run", WORLD, "--from", f"{file}@1", "--quiet", "--headless", "--until", 4], 1, "no-such-time")
        self.assertEqual(summary(WORLD, "--from", f"{file}@3.5", "--until", 4)["state_hash"], undisturbed)
        self.assertEqual(roboss("replay", file, "--quiet").returncode, 0)
        resumed = summary(WORLD, "--until", 5, "--journal", file, "--journal-every", 0.1, "--journal-keep", "1s")
        self.assertEqual(resumed["state_hash"], summary(WORLD, "--until", 5)["state_hash"])
        self.assertTrue(json.loads(roboss("journal", "verify", file, "--json").stdout)["good"])

    def test_a_limit_that_is_none_is_refused(self):
        for text in ("10", "ten min", "-1s", "5 parsecs"):
            self.refused(["run", WORLD, "--journal", FOLDER / "x.journal", "--journal-keep", text], 2, "10min")

    def test_a_replay_with_a_viewer_stays_and_turns_to_any_time_of_any_branch(self):
        file = FOLDER / "turned.journal"
        summary(WORLD, "--until", 1, "--journal", file, "--journal-every", 0.25)
        summary(WORLD, "--until", 1.2, "--from", f"{file}@0.6", "--journal", file, "--journal-every", 0.25)
        with LiveRun("replay", file, "--view", 0, "--speed", "max") as replay:
            replay.wait_for(1.2)
            self.assertTrue(replay.asked("status")["replay"])
            replay.asked("rewind", 0.7)
            self.assertAlmostEqual(replay.asked("status")["time_s"], 0.7, 6)
            replay.asked("rewind", "#1@0.9")
            status = replay.asked("status")
            self.assertEqual((round(status["time_s"], 6), status["branch"]), (0.9, 1))
            replay.asked("resume")
            replay.wait_for(1)
            self.assertTrue(replay.asked("preview", "#2@1.1")["exact"])
            self.assertEqual(json.loads(replay.control("bookmark", "no").stdout)["code"], "read-only")
            replay.asked("quit")
            replay.end()


if __name__ == "__main__":
    unittest.main(verbosity=2)
