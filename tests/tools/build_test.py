"""tools/build.sh: a full disk and a folder that cannot be made get a clear word, and the exit code stays that of the failure."""
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(os.environ["ROBOSS_TOOLS"])


class Build(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root, self.bin = Path(folder.name) / "tree", Path(folder.name) / "bin"
        (self.root / "tools").mkdir(parents=True)
        self.bin.mkdir()
        for name in ("build.sh", "jobs.sh"):
            shutil.copy(TOOLS / name, self.root / "tools" / name)

    def stand_in(self, name, text):
        path = self.bin / name
        path.write_text(f"#!/bin/bash\n{text}\n")
        path.chmod(0o755)

    def build(self, cmake, free_mib):
        self.stand_in("cmake", cmake)
        self.stand_in("df", f"printf 'Avail\\n{free_mib}\\n'")
        done = subprocess.run(["/bin/bash", self.root / "tools/build.sh", "release"], env={"PATH": f"{self.bin}:/usr/bin:/bin"},
                              capture_output=True, text=True, check=False)
        return done.returncode, done.stderr

    def test_says_that_the_disk_is_full_when_the_build_fails(self):
        code, said = self.build("[[ $1 != --build ]] || exit 4", 3)
        self.assertEqual(code, 4)
        self.assertIn("the disk of build/release is full (3 MiB left)", said)
        self.assertIn("remedy: free some space", said)

    def test_says_that_the_disk_is_full_when_cmake_fails(self):
        code, said = self.build("echo no file; exit 1", 3)
        self.assertEqual(code, 1)
        for words in ("no file", "the disk of build/release is full", "could not configure the preset release"):
            self.assertIn(words, said)

    def test_says_nothing_of_the_disk_when_there_is_space_or_no_failure(self):
        self.assertEqual(self.build("[[ $1 != --build ]] || exit 4", 5000), (4, ""))
        self.assertEqual(self.build("exit 0", 3), (0, ""))

    def test_says_that_its_folder_cannot_be_made(self):
        (self.root / "build").write_text("a file")
        code, said = self.build("exit 0", 5000)
        self.assertEqual(code, 1)
        self.assertIn("build/release cannot be made\n  remedy: ", said)


if __name__ == "__main__":
    unittest.main()
