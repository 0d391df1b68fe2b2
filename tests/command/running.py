"""Runs the roboss command for tests. Arguments of a test script: ROBOSS CITY_DRIVER WORLDS_FOLDER."""
import json
import os
import pty
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROBOSS, DRIVER, WORLDS = sys.argv[1], sys.argv[2], Path(sys.argv[3])
del sys.argv[1:4]
FOLDER = Path(tempfile.mkdtemp(prefix="roboss_test_"))


def roboss(*arguments):
    """The finished process; its output is text."""
    return subprocess.run([ROBOSS, *map(str, arguments)], capture_output=True, text=True, timeout=600)


def on_terminal(*arguments):
    """What the command prints on a terminal; fails if it does."""
    ours, its = pty.openpty()
    with subprocess.Popen([ROBOSS, *map(str, arguments)], stdout=its, stderr=its, close_fds=True) as process:
        os.close(its)
        text = b""
        while True:
            try:
                part = os.read(ours, 4096)
            except OSError:  # the other end is closed
                break
            if not part:
                break
            text += part
        os.close(ours)
        if process.wait(600) != 0:
            raise AssertionError(f"roboss {arguments} ended with {process.returncode}:\n{text.decode()}")
    return text.decode()


def summary(*arguments):
    """What `roboss run ... --json` wrote; fails if the run did."""
    file = FOLDER / "summary.json"
    done = roboss("run", *arguments, "--quiet", "--json", file, *([] if "--speed" in arguments else ["--speed", "max"]))
    if done.returncode != 0:
        raise AssertionError(f"roboss run {arguments} ended with {done.returncode}:\n{done.stderr}")
    return json.loads(file.read_text())


class RobossTest(unittest.TestCase):
    def refused(self, arguments, exit_code, *words):
        """The command ends with this exit code and prints these error codes, names or values."""
        done = roboss(*arguments)
        self.assertEqual(done.returncode, exit_code, done.stderr + done.stdout)
        for word in words:
            self.assertIn(word, done.stderr + done.stdout)
        return done
