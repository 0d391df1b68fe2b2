"""`roboss record`, `plot` and `analyse` run the Python package: all arguments and the exit code are passed on."""
import json
import os
import subprocess
import sys
import unittest

from running import FOLDER, ROBOSS, RobossTest

FAKE = FOLDER / "fake_python"
FAKE.write_text(f"#!{sys.executable}\nimport json, sys\nprint(json.dumps(sys.argv[3:]))\nsys.exit(3)\n")
FAKE.chmod(0o755)


def with_python(python, *arguments):
    """The finished process, which finds this Python."""
    return subprocess.run([ROBOSS, *arguments], capture_output=True, text=True, timeout=60,
                          env={**os.environ, "ROBOSS_PYTHON": str(python), "PYTHONPATH": ""})


class Analysis(RobossTest):
    def test_all_arguments_are_passed_on_in_their_order(self):
        for arguments in (["record", "run.journal", "*.speed", "--every", "0.1", "-o", "a b.parquet"], ["plot", "--help"],
                          ["analyse", "arm", "--json", "arm.sdf"]):
            done = with_python(FAKE, *arguments)
            self.assertEqual(json.loads(done.stdout), arguments)
            self.assertEqual(done.returncode, 3)

    def test_help_of_the_command_is_that_of_the_package(self):
        self.assertEqual(json.loads(with_python(FAKE, "help", "record").stdout), ["record", "--help"])

    def test_without_python_there_is_a_remedy(self):
        done = with_python(FOLDER / "no_such_python", "record", "x")
        self.assertEqual(done.returncode, 1)
        self.assertIn("[no-python]", done.stderr)

    def test_without_the_package_there_is_a_remedy(self):
        (FOLDER / "roboss").mkdir()  # a folder of that name in the folder of work is not the package
        done = subprocess.run([ROBOSS, "plot", "x"], capture_output=True, text=True, timeout=60, cwd=FOLDER,
                              env={"PATH": os.environ["PATH"], "ROBOSS_PYTHON": "/usr/bin/python3"})
        self.assertEqual(done.returncode, 1)
        self.assertIn("[no-package]", done.stderr)


if __name__ == "__main__":
    unittest.main()
