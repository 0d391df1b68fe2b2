"""tools/check_builds: equal hashes pass; another hash in one build, in the list, or a run that fails does not."""
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

TOOL = Path(os.environ["ROBOSS_TOOLS"]) / "check_builds"
# Stands in for a build's `roboss`: writes the summary with the hashes that stand beside it, or fails.
ROBOSS = """#!/bin/bash
here=$(dirname "$0")
echo "$*" >> "$here/calls"
while [[ $1 != --json ]]; do shift; done
cat "$here/hashes" > "$2"
"""


class CheckBuilds(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = Path(self.folder.name)
        (self.root / "tests").mkdir()
        (self.root / "tools").mkdir()
        for tool in (TOOL, TOOL.parent / "jobs.sh"):
            shutil.copy(tool, self.root / "tools")
        self.script("tools/build.sh", "#!/bin/bash\n")
        for preset in ("release", "check-debug", "check-clang"):
            self.build(preset, "aaaa", "1111")
        self.list = self.root / "tests/golden_hashes.txt"
        self.list.write_text("# comment\naaaa worlds/a.sdf --duration 1 --client @BUILD@/lib/x.so\n")

    def script(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)

    def build(self, preset, state_hash, model_hash):
        self.script(f"build/{preset}/bin/roboss", ROBOSS)
        (self.root / f"build/{preset}/bin/hashes").write_text(f'{{"state_hash": "{state_hash}", "model_hash": "{model_hash}"}}')

    def run_tool(self, *arguments):
        done = subprocess.run([self.root / "tools/check_builds", *arguments], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def test_passes_when_all_builds_and_the_list_agree(self):
        code, output = self.run_tool()
        self.assertEqual((code, output.splitlines()[-1]), (0, "builds: 3 passed, 0 failed"))

    def test_gives_each_build_its_own_control_program(self):
        self.run_tool()
        self.assertIn("run worlds/a.sdf --duration 1 --client build/check-debug/lib/x.so", (self.root / "build/check-debug/bin/calls").read_text())

    def test_fails_when_one_build_has_another_state_or_model_hash(self):
        self.build("check-clang", "bbbb", "1111")
        self.assertEqual(self.run_tool()[0], 1)
        self.build("check-clang", "aaaa", "2222")
        code, output = self.run_tool()
        self.assertEqual((code, output.splitlines()[-1]), (1, "builds: 2 passed, 1 failed"))
        self.assertIn("WRONG check-clang", output)

    def test_fails_when_the_list_says_otherwise(self):
        self.list.write_text("cccc worlds/a.sdf\n")
        self.assertEqual(self.run_tool()[1].splitlines()[-1], "builds: 0 passed, 3 failed")

    def test_tells_each_run_in_the_order_of_the_list(self):
        self.list.write_text("".join(f"{'cccc' if i == 3 else 'aaaa'} worlds/{i}.sdf\n" for i in range(6)))
        code, output = self.run_tool("release", "check-clang")
        self.assertEqual(code, 1)
        told = [(line.split()[0], line.split()[1], line.split()[-1]) for line in output.splitlines()[:-1]]
        self.assertEqual(told, [("WRONG" if i == 3 else "ok", build, f"worlds/{i}.sdf") for i in range(6) for build in ("release", "check-clang")])

    def test_fails_when_a_run_fails_or_nothing_is_listed(self):
        self.script("build/check-debug/bin/roboss", "#!/bin/bash\necho no such world >&2\nexit 3\n")
        code, output = self.run_tool()
        self.assertEqual(code, 1)
        self.assertIn("no such world", output)
        self.list.write_text("# nothing\n")
        self.assertEqual(self.run_tool()[0], 1)

    def test_short_plays_only_worlds_that_are_stepped_in_a_moment(self):
        self.list.write_text("aaaa worlds/scouts.sdf --lanes 1\naaaa worlds/heap.sdf\naaaa worlds/joints.sdf\n")
        code, output = self.run_tool("--short", "release")
        self.assertEqual((code, [line.split()[3] for line in output.splitlines()[:-1]]), (0, ["worlds/scouts.sdf", "worlds/joints.sdf"]))
        self.list.write_text("aaaa worlds/heap.sdf\n")
        self.assertEqual(self.run_tool("--short", "release")[0], 1)
        self.assertEqual(self.run_tool("--short", "--update", "release")[0], 2)

    def test_refuses_unknown_options(self):
        code, output = self.run_tool("--fast")
        self.assertEqual((code, output), (2, "check_builds: no option --fast\n"))

    def test_plays_a_build_for_aarch64_under_qemu_and_only_that(self):
        self.build("check-aarch64", "aaaa", "1111")
        self.script("bin/qemu-aarch64-static", '#!/bin/bash\necho "$1" >> "$(dirname "$0")/started"\nexec "$@"\n')
        path = os.environ["PATH"]
        self.addCleanup(os.environ.__setitem__, "PATH", path)
        os.environ["PATH"] = f"{self.root}/bin:{path}"
        self.assertEqual(self.run_tool("release", "check-aarch64")[0], 0)
        self.assertEqual((self.root / "bin/started").read_text(), "build/check-aarch64/bin/roboss\n")

    def test_update_writes_the_hashes_and_keeps_comments_and_arguments(self):
        self.build("release", "dddd", "1111")
        self.assertEqual(self.run_tool("--update")[0], 0)
        self.assertEqual(self.list.read_text(), "# comment\ndddd worlds/a.sdf --duration 1 --client @BUILD@/lib/x.so\n")


if __name__ == "__main__":
    unittest.main()
