"""What reaches a terminal or a log: no control characters of world files, and no token of the viewer."""
import os
import re
import signal
import stat
import subprocess
import time
import unittest
from pathlib import Path

from running import FOLDER, ROBOSS, on_terminal, roboss

NAME = "ball\u009b31m\u202eabc\u200f"  # CSI as one character, and text that runs backwards
WORLD = f"""<sdf version="1.9"><world name="w{NAME}">
<model name="{NAME}"><pose>0 0 1 0 0 0</pose><link name="l{NAME}"><inertial><mass>1</mass></inertial>
<collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link>
<joint name="j{NAME}" type="revolute"><parent>world</parent><child>nowhere{NAME}</child></joint></model>
<model name="ground"><static>true</static><link name="l"><collision name="c"><geometry><plane/></geometry></collision></link></model>
</world></sdf>"""
HARMFUL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u200e\u200f\u202a-\u202e\u2066-\u2069]")


class Words(unittest.TestCase):
    def setUp(self):
        self.world = FOLDER / "escape.sdf"
        self.world.write_text(WORLD)

    def harmless(self, text, *words):
        self.assertIsNone(HARMFUL.search(text.replace("\r", "")), repr(text))
        for word in words:
            self.assertIn(word, text)

    def test_names_of_a_world_file_move_no_cursor(self):
        done = roboss("check", "--all", "--names", self.world)
        self.harmless(done.stdout + done.stderr, "ball?31m?abc?")
        done = roboss("run", self.world, "--duration", 0.01, "--headless", "--trace", "-", "--log", FOLDER / "escape.log")
        self.harmless(done.stdout + done.stderr)
        self.harmless((FOLDER / "escape.log").read_text())

    def test_nor_do_file_names(self):
        done = roboss("run", FOLDER / "no\x1b]0;title\x07 such.sdf", "--duration", 0.01, "--headless")
        self.assertNotEqual(done.returncode, 0)
        self.harmless(done.stdout + done.stderr, "no?]0;title? such.sdf")


class Tokens(unittest.TestCase):
    VIEW = ["--view", "0.0.0.0:0", "--duration", 0.01, "--no-stay"]

    def test_a_log_gets_none_and_names_a_private_file_that_has_them(self):
        world = FOLDER / "plain.sdf"
        world.write_text(WORLD.replace(NAME, "ball"))
        process = subprocess.Popen([ROBOSS, "run", world, "--view", "0.0.0.0:0", "--paused", "--log", FOLDER / "run.log"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        try:
            for line in process.stderr:
                if "viewer at" in line:
                    break
            self.assertNotIn("token=", line)
            file = Path(re.search(r"tokens are in (\S+)", line).group(1))
            self.assertEqual(stat.S_IMODE(file.stat().st_mode), 0o600)
            kept = file.read_text()
            self.assertEqual(len(re.findall(r"token=[0-9a-f]{32}", kept)), 3, kept)
            end = time.monotonic() + 20
            while not (FOLDER / "run.log").exists() and time.monotonic() < end:
                time.sleep(0.01)
        finally:
            process.send_signal(signal.SIGINT)
            rest = process.stderr.read()
            process.stderr.close()
            process.wait()
        self.assertNotIn("token=", rest)
        self.assertNotIn("token=", (FOLDER / "run.log").read_text())

    def test_a_terminal_gets_them(self):
        world = FOLDER / "plain.sdf"
        world.write_text(WORLD.replace(NAME, "ball"))
        self.assertRegex(on_terminal("run", world, *self.VIEW), r"token=[0-9a-f]{32}")


if __name__ == "__main__":
    unittest.main()
