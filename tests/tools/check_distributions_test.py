"""tools/check_distributions: what it asks of which root, and that neither a failed release nor another hash passes. Real roots need
root, a network and a build each, so the one tool that it calls is a stand-in here."""
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(os.environ["ROBOSS_TOOLS"])
LISTED = "00000000000000aa"
BARE_ROOT = """#!/bin/bash
echo "$*" >> "$CALLS/calls"
release=$1 root=$2
mkdir "$CALLS/$release.busy" || { echo "two at once in $release" >> "$CALLS/calls"; exit 1; }
trap 'rmdir "$CALLS/$release.busy"' EXIT
sleep .05
case "$*" in
*test.sh*) echo "7 passed, 0 failed"; echo "builds: 3 passed, 0 failed"; exit $([[ $release == "$FAILS" ]] && echo 1 || echo 0) ;;
*" controller "*) mkdir -p "$root/root/roboss/build"; echo "{\\"state_hash\\": \\"$HASH\\"}" > "$root/root/roboss/build/mixed.json" ;;
esac
"""


class CheckDistributions(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        for name in ("tools", "tests"):
            (self.root / name).mkdir()
        (self.root / "tools" / "bare_root.sh").write_text(BARE_ROOT)
        (self.root / "tools" / "bare_root.sh").chmod(0o755)
        (self.root / "tests" / "golden_hashes.txt").write_text(
            f"# comment\n{LISTED} worlds/city.sdf --client @BUILD@/lib/roboss_city_driver.so --duration 2\n"
            "00000000000000bb worlds/city.sdf --client @BUILD@/lib/roboss_city_driver.so --duration 2 --lanes 1\n")
        shutil.copy(TOOLS / "check_distributions", self.root / "tools")

    def run_tool(self, *words, found=LISTED, fails=""):
        environment = {"PATH": "/usr/bin:/bin", "CALLS": str(self.root), "HASH": found, "FAILS": fails}
        done = subprocess.run([self.root / "tools/check_distributions", *words, self.root / "roots"], env=environment, capture_output=True,
                              text=True, check=False)
        calls = self.root / "calls"
        return done.returncode, done.stdout + done.stderr, calls.read_text().splitlines() if calls.exists() else []

    def test_tests_both_releases_and_runs_them_together(self):
        code, said, calls = self.run_tool()
        self.assertEqual(code, 0, said)
        self.assertEqual([call.split()[0] for call in calls if "test.sh" in call], ["bookworm", "trixie"])
        self.assertEqual(sum(" controller " in call for call in calls), 2)
        self.assertEqual(sum(" simulator " in call for call in calls), 2, "two members in each call")
        self.assertFalse([call for call in calls if call.startswith("two at once")], "each copies the repository into its root")
        for call in calls:
            self.assertEqual(call.split()[1], str(self.root / "roots" / call.split()[0]))
        self.assertEqual(said.count("7 passed, 0 failed"), 2, said)
        self.assertEqual(said.count(f"{LISTED}, in the list: {LISTED}"), 2, said)

    def test_a_release_whose_tests_fail_does_not_pass(self):
        code, said, calls = self.run_tool(fails="trixie")
        self.assertEqual(code, 1, said)
        self.assertIn("trixie FAILED", said)
        self.assertEqual(sum(" controller " in call for call in calls), 2, "the run of both is played all the same")

    def test_another_hash_does_not_pass(self):
        self.assertEqual(self.run_tool("--mixed", found="00000000000000bb")[0], 1)
        self.assertEqual(self.run_tool("--mixed")[0], 0)

    def test_an_unknown_option_is_refused(self):
        code, said, calls = self.run_tool("--short")
        self.assertEqual((code, calls), (2, []))
        self.assertIn("no option --short", said)


if __name__ == "__main__":
    unittest.main()
