"""`roboss control` and `roboss runs` reach every run of this computer; a run stays after its duration; reset to a save."""
import json
import os
import signal
import socket
import subprocess
import tempfile
import time
import unittest

from running import FOLDER, ROBOSS, WORLDS, RobossTest, roboss, summary

PILE = WORLDS / "pile.sdf"
# A list of runs of its own, so that other tests and the user's runs are not seen. Socket paths must be short.
RUNTIME = tempfile.mkdtemp(prefix="rb", dir="/tmp")
os.chmod(RUNTIME, 0o700)
os.environ["XDG_RUNTIME_DIR"] = RUNTIME


def runs():
    return json.loads(roboss("runs", "--json").stdout)


class LocalRuns(RobossTest):
    def start(self, *arguments):
        before = {run["pid"] for run in runs()}
        process = subprocess.Popen([ROBOSS, "run", *map(str, arguments), "--quiet"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.addCleanup(self.end, process)
        deadline = time.monotonic() + 30
        while process.pid not in {run["pid"] for run in runs()} - before:
            self.assertIsNone(process.poll(), "it ended at once")
            self.assertLess(time.monotonic(), deadline, "it was not listed")
            time.sleep(0.02)
        return process

    def end(self, process):
        if process.poll() is None:
            process.kill()
        process.communicate()

    def ask(self, *words, name=None):
        done = roboss("control", *([] if name is None else ["--simulation", name]), "--json", *words)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return json.loads(done.stdout)

    def wait_for(self, what, name=None):
        deadline = time.monotonic() + 30
        while not what(self.ask("status", name=name)):
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)

    def test_without_a_run_it_says_so_at_once(self):
        began = time.monotonic()
        self.refused(["control", "pause"], 1, "[no-run]")
        self.refused(["save", FOLDER / "none.roboss"], 1, "[no-run]")
        self.assertLess(time.monotonic() - began, 5)
        self.assertEqual(runs(), [])

    def test_a_run_obeys_and_ends_in_the_same_state(self):
        expected = summary(PILE, "--headless", "--duration", 0.6)["state_hash"]
        json_file = FOLDER / "obeyed.json"
        run = self.start(PILE, "--headless", "--paused", "--until", 0.6, "--json", json_file)
        self.assertTrue(self.ask("status")["paused"])
        self.assertIn("15", self.ask("step", 15)["text"])
        self.wait_for(lambda status: status["tick"] == 15 and status["paused"])
        self.ask("resume")
        self.assertEqual(run.wait(60), 0)
        self.assertEqual(json.loads(json_file.read_text())["state_hash"], expected)

    def test_several_runs_are_reached_by_name_and_process(self):
        one = self.start(PILE, "--headless", "--paused")
        two = self.start(PILE, "--headless", "--paused")
        mine = self.start(PILE, "--headless", "--paused", "--simulation", "mine")
        self.assertEqual(sorted(run["name"] for run in runs()), ["mine", "pile", "pile-2"])
        self.refused(["control", "status"], 1, "[several-runs]", "pile-2", "mine")
        self.refused(["control", "--simulation", "yours", "status"], 1, "[no-run]", "pile-2")
        self.refused(["run", PILE, "--headless", "--simulation", "mine"], 1, "[run-exists]")
        self.ask("resume", name="mine")
        self.assertFalse(self.ask("status", name=str(mine.pid))["paused"])
        self.assertTrue(self.ask("status", name="pile-2")["paused"])
        one.send_signal(signal.SIGKILL)
        one.wait()
        self.assertEqual(sorted(run["name"] for run in runs()), ["mine", "pile-2"])
        self.ask("quit", name="pile-2")
        self.assertEqual(two.wait(30), 0)

    def test_a_run_that_stays_can_be_reset_to_its_save_and_to_its_start(self):
        folder = FOLDER / "stays"
        folder.mkdir()
        run = self.start(PILE, "--headless", "--duration", 0.4, "--stay", "--save-folder", folder)
        self.wait_for(lambda status: status["over"] and status["paused"])
        at_end = self.ask("status")
        self.refused(["control", "reset", "save"], 3, "[no-save]")
        self.ask("save", "end.roboss")
        self.ask("step", 50)
        self.wait_for(lambda status: status["tick"] == at_end["tick"] + 50)
        self.ask("reset", "save")
        after = self.ask("status")
        self.assertEqual((after["tick"], after["state_hash"]), (at_end["tick"], at_end["state_hash"]))
        self.ask("reset")
        self.assertEqual(self.ask("status")["tick"], 0)
        self.ask("quit")
        self.assertEqual(run.wait(30), 0)

    def test_a_continued_run_can_be_reset_to_the_state_it_began_with(self):
        saved = FOLDER / "half.roboss"
        summary(PILE, "--headless", "--duration", 0.2, "--save", saved)
        self.start(PILE, "--headless", "--from", saved, "--paused")
        began = self.ask("status")
        self.assertEqual(began["tick"], 100)
        self.ask("step", 20)
        self.wait_for(lambda status: status["tick"] == 120)
        self.ask("reset", "save")
        self.assertEqual(self.ask("status")["state_hash"], began["state_hash"])

    def test_with_a_viewer_the_default_is_real_time(self):
        self.start(PILE, "--view", 0, "--paused")
        self.start(PILE, "--headless", "--paused")
        self.assertEqual(self.ask("status", name="pile")["speed"], "1")
        self.assertEqual(self.ask("status", name="pile-2")["speed"], "max")

    def test_rubbish_at_its_socket_harms_nothing(self):
        run = self.start(PILE, "--headless", "--paused")
        path = f"{RUNTIME}/roboss/{run.pid}.sock"
        for rubbish in (b"", b"\xff\xff\xff\xff", b"\x05\0\0\0hello", b"\x10\0\0\0half"):
            with socket.socket(socket.AF_UNIX) as connection:
                connection.connect(path)
                connection.sendall(rubbish)
        self.assertTrue(self.ask("status")["paused"])
        self.assertEqual(os.stat(f"{RUNTIME}/roboss").st_mode & 0o077, 0)


if __name__ == "__main__":
    unittest.main()
