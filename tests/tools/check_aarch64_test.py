"""tools/check_aarch64: which root it asks for, what it installs there, and what it plays. A real one needs root, a network
and a build, so the system's programs are stand-ins here."""
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(os.environ["ROBOSS_TOOLS"])
STAND_INS = {
    "tools/bare_root.sh": 'printf "%s\\n" "$@" > "$CALLS/bare_root"',
    "tools/setup.sh": 'echo "$*" >> "$CALLS/setup"',
    "tools/check_builds": 'echo "$*" > "$CALLS/check_builds"; exit "${CODE:-0}"',
    "bin/dpkg": '[[ $1 != --print* ]] || { cat "$CALLS/foreign" 2>/dev/null; exit 0; }\necho "$2" > "$CALLS/foreign"',
    "bin/apt-get": 'echo "$*" >> "$CALLS/apt"',
}


class CheckAarch64(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        for name, text in STAND_INS.items():
            path = self.root / name
            path.parent.mkdir(exist_ok=True)
            path.write_text(f"#!/bin/bash\n{text}\n")
            path.chmod(0o755)
        for name in ("check_aarch64", "setup_aarch64.sh", "packages.txt"):
            shutil.copy(TOOLS / name, self.root / "tools")

    def run_tool(self, *words, code=0):
        environment = {"PATH": f"{self.root}/bin:/usr/bin:/bin", "CALLS": str(self.root), "CODE": str(code)}
        done = subprocess.run([self.root / "tools/check_aarch64", *words], env=environment, capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def read(self, name):
        return (self.root / name).read_text().splitlines()

    def test_runs_itself_in_a_root_of_debian_12(self):
        self.assertEqual(self.run_tool()[0], 0)
        self.assertEqual(self.read("bare_root"), ["bookworm", "/var/tmp/roboss_aarch64", "tools/check_aarch64", "--inside"])
        self.assertEqual(self.run_tool("--short", "/tmp/x")[0], 0)
        self.assertEqual(self.read("bare_root"), ["bookworm", "/tmp/x", "tools/check_aarch64", "--inside", "--short"])

    def test_refuses_unknown_options(self):
        code, output = self.run_tool("--fast")
        self.assertEqual(code, 2)
        self.assertIn("no option --fast", output)

    def test_installs_the_libraries_of_the_build_for_arm64_and_the_tools_for_this_processor(self):
        self.assertEqual(self.run_tool("--inside", "--short")[0], 0)
        self.assertEqual(self.read("foreign"), ["arm64"])
        self.assertEqual(self.read("setup"), ["aarch64"])
        update, install = self.read("apt")
        self.assertIn("update", update)
        libraries = [word for word in install.split() if word.endswith(":arm64")]
        self.assertIn("libpugixml-dev:arm64", libraries)
        self.assertGreater(len(libraries), 10)
        self.assertNotIn("cmake", install)
        self.assertEqual(self.read("check_builds"), ["--short check-aarch64"])

    def test_a_second_time_adds_no_architecture_and_ends_as_the_runs_end(self):
        self.run_tool("--inside")
        (self.root / "apt").unlink()
        self.assertEqual(self.run_tool("--inside", code=1)[0], 1)
        self.assertNotIn("update", " ".join(self.read("apt")))
        self.assertEqual(self.read("check_builds"), ["check-aarch64"])


if __name__ == "__main__":
    unittest.main()
