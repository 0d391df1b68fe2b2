"""tools/release.sh: what it makes for aarch64, and from what. A real release takes a build, so the tools that it starts are
stand-ins here; tools/try_release.sh tries its files."""
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(os.environ["ROBOSS_TOOLS"])
STAND_INS = {
    "tools/bare_root.sh": 'echo "$*" >> "$CALLS/bare_root"; copy=$2/root/roboss; mkdir -p "$copy/build/python"\n'
                          '[[ $# -eq 2 ]] || { cp "$copy"/build/python/raw/*.whl "$copy/dist/roboss-9.8.7-cp312-abi3-linux_aarch64.whl"\n'
                          'cat "$copy"/build/python/prefix/share/roboss/web/index.html > "$copy/dist/roboss-9.8.7-linux-aarch64.tar.xz"\n'
                          'echo deb > "$copy/dist/roboss_9.8.7_arm64.deb"; }',
    "bin/git": "echo 1234abc",
}


class Release(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = Path(folder.name)
        for name, text in STAND_INS.items():
            self.write(name, f"#!/bin/bash\n{text}\n").chmod(0o755)
        shutil.copy(TOOLS / "release.sh", self.tree / "tools")
        self.write("CMakeLists.txt", "project(roboss VERSION 9.8.7 LANGUAGES CXX)\n")

    def write(self, name, text):
        path = self.tree / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def run_tool(self, *words):
        environment = {"PATH": f"{self.tree}/bin:/usr/bin:/bin", "CALLS": str(self.tree)}
        done = subprocess.run([self.tree / "tools/release.sh", *words], env=environment, capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def test_refuses_unknown_options(self):
        code, output = self.run_tool("--arm")
        self.assertEqual(code, 2)
        self.assertIn("usage: tools/release.sh [--no-build | --aarch64 [DIR]]", output)

    def test_begins_aarch64_with_the_files_for_this_processor(self):
        code, output = self.run_tool("--aarch64", str(self.tree / "root"))
        self.assertEqual(code, 1)
        self.assertIn("remedy: first tools/release.sh", output)
        self.assertFalse((self.tree / "bare_root").exists())

    def test_adds_the_files_for_aarch64_and_sums_all_up(self):
        root = self.tree / "root"
        for name in ("roboss-9.8.7-cp311-cp311-linux_x86_64.whl", "roboss-9.8.7-linux-x86_64.tar.xz", "roboss_9.8.7_amd64.deb"):
            self.write(f"dist/{name}", "ours")
        self.write("build/python/raw/roboss-9.8.7-cp311-cp311-linux_x86_64.whl", "wheel")
        self.write("build/python/prefix/share/roboss/web/index.html", "page")
        left = root / "root/roboss/dist/roboss-9.8.6-linux-aarch64.tar.xz"
        left.parent.mkdir(parents=True)
        left.write_text("of an earlier version")
        for _ in range(2):
            code, output = self.run_tool("--aarch64", str(root))
            self.assertEqual(code, 0, output)
        self.assertEqual((self.tree / "bare_root").read_text().splitlines()[:2],
                         [f"bookworm {root}", f"bookworm {root} tools/release.sh --inside 1234abc"])
        self.assertEqual((self.tree / "dist/roboss-9.8.7-cp312-abi3-linux_aarch64.whl").read_text(), "wheel")
        self.assertEqual((self.tree / "dist/roboss-9.8.7-linux-aarch64.tar.xz").read_text(), "page")
        sums = (self.tree / "dist/SHA256SUMS").read_text().splitlines()
        self.assertEqual(sorted(line.split()[1] for line in sums), sorted(
            path.name for path in (self.tree / "dist").iterdir() if path.name != "SHA256SUMS"))
        self.assertEqual(len(sums), 6)


if __name__ == "__main__":
    unittest.main()
