"""Faults of control programs: a crash names the library and leaves the journal intact; errors say what exists."""
import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

PROGRAM, FIELD = sys.argv.pop(), sys.argv.pop()
from running import FOLDER, ROBOSS, RobossTest, roboss, summary  # noqa: E402  (reads the other arguments)


class Faults(RobossTest):
    def run_with(self, fault, *arguments):
        return subprocess.run([ROBOSS, "run", FIELD, "--client", PROGRAM, "--duration", "0.5", "--headless", *map(str, arguments)],
                              env={**os.environ, "FAULT": fault}, capture_output=True, text=True, timeout=120)

    def test_a_crash_names_the_library_and_leaves_the_journal_intact(self):
        for fault in ("segv", "null", "overflow"):
            with self.subTest(fault=fault):
                journal = FOLDER / f"{fault}.journal"
                done = self.run_with(fault, "--journal", journal, "--journal-every", 0.1)
                self.assertLess(done.returncode, 0, "it ends by the signal")
                for word in (Path(PROGRAM).name, "[client-crashed]", "control()", "SIGSEGV", str(journal)):
                    self.assertIn(word, done.stderr)
                info = json.loads(roboss("journal", "info", journal, "--json").stdout)
                self.assertGreaterEqual(info["branches"][0]["end_s"], 0.1)
                self.assertTrue(json.loads(roboss("journal", "verify", journal, "--json").stdout)["good"])
                continued = FOLDER / "continued.json"
                done = self.run_with("none", "--journal", journal, "--until", 0.5, "--json", continued)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(json.loads(continued.read_text())["state_hash"],
                                 summary(FIELD, "--client", PROGRAM, "--headless", "--until", 0.5)["state_hash"])

    def test_an_exception_in_a_thread_of_the_program_is_a_crash_too(self):
        done = self.run_with("thread")
        self.assertIn("SIGABRT", done.stderr)
        self.assertIn("in a thread", done.stderr)
        self.assertLess(done.returncode, 0)

    def test_names_that_do_not_exist_end_the_run_with_what_exists(self):
        for fault, words in (("robot", ("no robot 'rovr'", "did you mean 'rover'?")),
                             ("joint", ("no joint 'left_weel'", "did you mean 'left_wheel'?", "'right_wheel'")),
                             ("throw", ("as it was asked",)), ("value", ("robot",))):
            with self.subTest(fault=fault):
                done = self.run_with(fault)
                self.assertEqual(done.returncode, 3, done.stderr)
                for word in (*words, Path(PROGRAM).name):
                    self.assertIn(word, done.stderr)
                self.assertEqual(done.stderr.count("threw"), 1, "once: " + done.stderr)
                why = done.stderr.partition("threw")[2]
                self.assertEqual(why.count("remedy:"), 1, "the program's own, if it has one: " + done.stderr)

    def test_options_that_throw_are_an_error_before_the_run(self):
        done = self.run_with("options")
        self.assertEqual(done.returncode, 1, done.stderr)
        for word in ("options()", "no options", Path(PROGRAM).name, "[client-failed]"):
            self.assertIn(word, done.stderr)

    def test_a_refused_order_that_the_program_ignores_is_reported_once(self):
        for fault in ("order", "id"):
            with self.subTest(fault=fault):
                done = self.run_with(fault)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(done.stderr.count("an order was refused"), 1, done.stderr)
                self.assertIn(Path(PROGRAM).name, done.stderr)


if __name__ == "__main__":
    unittest.main()
