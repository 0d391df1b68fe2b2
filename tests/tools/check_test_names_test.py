"""tools/check_test_names refuses programs that print parameters of tests as bytes."""
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

TOOL = Path(os.environ["ROBOSS_TOOLS"]) / "check_test_names"


class CheckTestNames(unittest.TestCase):
    def check(self, listed):
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "some_test"
            program.write_text(f"#!/bin/sh\ncat <<'END'\n{listed}\nEND\n")
            program.chmod(0o755)
            return subprocess.run([TOOL, program], capture_output=True, text=True)

    def test_names_and_texts_pass(self):
        done = self.check("Sleep.\n  Wakes\nPairs/Each.\n  Touches/0  # GetParam() = 3\n  Touches/box  # GetParam() = box")
        self.assertEqual((done.returncode, done.stdout), (0, ""))

    def test_bytes_are_refused_with_the_name_of_the_test(self):
        done = self.check("Pairs/Each.\n  Touches/a  # GetParam() = a\n  Touches/b  # GetParam() = 8-byte object <00-00>")
        self.assertEqual(done.returncode, 1)
        self.assertIn("Pairs/Each.Touches/b: its parameter", done.stdout)
        self.assertNotIn("Touches/a", done.stdout)

    def test_a_program_that_fails_is_an_error(self):
        self.assertNotEqual(self.check("END\nexit 3\ncat <<'END'").returncode, 0)
        self.assertNotEqual(subprocess.run([TOOL], capture_output=True).returncode, 0)


if __name__ == "__main__":
    unittest.main()
