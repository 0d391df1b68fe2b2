"""tools/bare_root.sh and .ci/run: what they refuse, with which remedy, what a root gets, and what comes out of it. A real
root needs root, a network and half a minute, so debootstrap is a stand-in here; .ci/run itself works in a real one."""
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(os.environ["ROBOSS_TOOLS"])
# Stand-ins for the system's programs. `files` lists what git knows.
STAND_INS = {
    "id": "echo 0",
    "unshare": "exit 0",
    "df": "printf 'Avail\\n50000\\n'",
    "git": "cat \"$STAND_INS/files\"",
    "debootstrap": "echo \"$*\" > \"$STAND_INS/call\"; mkdir -p \"$4\"/etc/apt/apt.conf.d \"$4/root\"",
    "apt-config": "printf '%s\\n' 'Acquire::http::Proxy \"http://proxy:3142\";' 'Acquire::IndexTargets::x \"\";' 'Acquire::http::"
                  "Proxy-Auto-Detect \"/usr/bin/gone\";' 'DPkg::Post-Invoke:: \"/usr/bin/gone\";'",
    "apt-get": ". /etc/os-release; d=$VERSION_CODENAME; printf '%s\\n' \"http://m/debian/ $d main\" \"http://m/debian/ $d contrib\" "
               "\"http://m/security/ $d-security main\" \"http://other/ nodistro main\"",
}


class Tree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.base = Path(folder.name)
        self.tree, self.bin, self.root = self.base / "tree", self.base / "bin", self.base / "root"
        (self.tree / "tools").mkdir(parents=True)
        self.bin.mkdir()
        for name, text in STAND_INS.items():
            self.program(self.bin / name, text)

    @staticmethod
    def program(path, text):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"#!/bin/bash\n{text}\n")
        path.chmod(0o755)

    def start(self, program, *words):
        environment = {"PATH": f"{self.bin}:/usr/sbin:/usr/bin:/sbin:/bin", "STAND_INS": str(self.bin), "HOME": str(self.base),
                       "TMPDIR": str(self.base)}
        done = subprocess.run([program, *words], env=environment, capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr


class BareRoot(Tree):
    def setUp(self):
        super().setUp()
        for name in ("bare_root.sh", "setup.sh", "packages.txt"):
            shutil.copy(TOOLS / name, self.tree / "tools" / name)
        self.files({"a.txt": "one", "folder/b.txt": "two"})

    def files(self, texts):
        """The files that git lists, and those of them that are there."""
        for name, text in texts.items():
            path = self.tree / name
            path.parent.mkdir(exist_ok=True)
            if text is not None:
                path.write_text(text)
            else:
                path.unlink(missing_ok=True)
        (self.bin / "files").write_text("".join(f"{name}\0" for name in texts))

    def make(self, release="bookworm", root=None, *command):
        return self.start(self.tree / "tools/bare_root.sh", release, root or self.root, *command)

    def refused(self, code, *words, release="bookworm", root=None):
        got, output = self.make(release, root)
        self.assertEqual(got, code, output)
        for word in words:
            self.assertIn(word, output)

    def test_refuses_an_unknown_release_and_no_folder(self):
        self.refused(2, "no release 'sarge'", "usage: tools/bare_root.sh bookworm|trixie DIR", release="sarge")
        for words in ([], ["bookworm"], ["bookworm", ""]):
            code, output = self.start(self.tree / "tools/bare_root.sh", *words)
            self.assertEqual(code, 2)
            self.assertIn("usage: tools/bare_root.sh", output)

    def test_refuses_a_folder_that_has_something_else(self):
        (self.base / "mine").mkdir()
        (self.base / "mine/letter").write_text("dear")
        self.refused(2, "is not empty", "remedy: name a folder", root=self.base / "mine")
        self.assertEqual(os.listdir(self.base / "mine"), ["letter"])
        self.refused(2, "is no folder", root=self.base / "mine/letter")

    def test_refuses_the_root_of_another_release(self):
        self.assertEqual(self.make()[0], 0)
        self.refused(2, "a root of bookworm, not of trixie", release="trixie")

    def test_says_what_the_machine_lacks(self):
        for program, text, words in (
                ("id", "echo 1000", ("not root", "remedy: sudo")),
                ("unshare", "exit 1", ("no mount namespace", "--privileged")),
                ("df", "printf 'Avail\\n100\\n'", ("100 MiB free", "another disk")),
                ("debootstrap", "echo 'E: no such host'; exit 1", ("E: no such host", "debootstrap failed", "no network?")),
                ("debootstrap", "echo 'E: Release signed by unknown key (key id 1)'; exit 1", ("no key of bookworm",))):
            with self.subTest(program=program, words=words):
                self.program(self.bin / program, text)
                self.refused(3, *words)
                self.program(self.bin / program, STAND_INS[program])
        (self.bin / "files").unlink()
        self.program(self.bin / "git", "echo 'not a repository' >&2; exit 1")
        self.refused(3, "not a repository", "must be a clone")

    def test_takes_the_archives_of_debian_alone_and_for_its_release(self):
        for release in ("bookworm", "trixie"):
            root = self.base / release
            code, output = self.make(release, root)
            self.assertEqual(code, 0, output)
            self.assertEqual((root / "etc/apt/sources.list").read_text().splitlines(), [
                f"deb http://m/debian/ {release} main", f"deb http://m/security/ {release}-security main"])
            self.assertTrue((self.bin / "call").read_text().endswith(f" {release} {root} http://m/debian/\n"))

    def test_takes_the_proxy_and_no_hooks_of_this_machine(self):
        self.assertEqual(self.make()[0], 0)
        settings = (self.root / "etc/apt/apt.conf.d/90host").read_text()
        self.assertIn('Acquire::http::Proxy "http://proxy:3142";', settings)
        for word in ("gone", "IndexTargets"):
            self.assertNotIn(word, settings)

    def test_copies_what_is_on_disk_and_removes_what_is_gone(self):
        (self.tree / "ignored.txt").write_text("ignored")
        self.assertEqual(self.make()[0], 0)
        copy = self.root / "root/roboss"
        self.assertEqual(sorted(p.name for p in copy.rglob("*") if p.is_file()), ["a.txt", "b.txt"])
        (copy / "build").mkdir()
        (copy / "build/made").write_text("made")
        self.files({"a.txt": "changed", "folder/b.txt": None, "new name.txt": "new"})
        code, output = self.make()
        self.assertEqual(code, 0, output)
        self.assertEqual((copy / "a.txt").read_text(), "changed")
        self.assertEqual(sorted(p.name for p in copy.rglob("*") if p.is_file()), ["a.txt", "made", "new name.txt"])

    def test_the_exit_code_is_that_of_the_command(self):
        self.program(self.bin / "unshare", '[[ ${!#} == true ]] || exit 7')
        self.assertEqual(self.make("bookworm", self.root, "ls")[0], 7)


class Ci(Tree):
    """.ci/run among stand-ins: the root is a folder, and what runs in it runs in a copy."""
    ROOT = 'mkdir -p "$2/root/roboss"; [[ $# -gt 2 ]] || exit 0; d=$2/root/roboss; shift 2; [[ $1 == apt-get ]] && exit 0\n' \
           'cp -r . "$d"; cd "$d"; exec "$@"'
    TEST = 'mkdir -p build/release; echo "<testcase name=\\"a\\" status=\\"run\\">" > build/release/test_results.xml'

    def setUp(self):
        super().setUp()
        (self.tree / ".ci").mkdir()
        shutil.copy(TOOLS.parent / ".ci/run", self.tree / ".ci/run")
        shutil.copy(TOOLS / "count_tests.sh", self.tree / "tools/count_tests.sh")
        for name in ("run.sh", "tools/setup.sh", "tools/check_builds"):
            self.program(self.tree / name, f"echo {name} in $PWD >> {self.base}/calls")
        self.program(self.tree / "test.sh", self.TEST)
        self.program(self.tree / "tools/bare_root.sh", self.ROOT)

    def run_ci(self):
        (self.base / "calls").write_text("")
        code, output = self.start(self.tree / ".ci/run")
        return code, output.splitlines(), (self.base / "calls").read_text()

    def test_works_in_the_root_and_brings_the_results_out(self):
        code, lines, calls = self.run_ci()
        self.assertEqual((code, lines[-1]), (0, "1 passed, 0 failed"), lines)
        self.assertNotIn(f"in {self.tree}\n", calls)
        self.assertEqual([line.split()[0] for line in calls.splitlines()], ["run.sh", "tools/setup.sh", "tools/check_builds"])
        self.assertTrue((self.tree / "build/release/test_results.xml").exists())
        self.assertEqual(list(self.base.glob("roboss_ci*")), [])

    def test_any_part_that_fails_makes_it_fail(self):
        for name in ("run.sh", "test.sh", "tools/check_builds", "tools/setup.sh"):
            with self.subTest(name=name):
                before = (self.tree / name).read_text()
                self.program(self.tree / name, f"{before}\nexit 5")
                code, lines, _ = self.run_ci()
                self.assertEqual((code, lines[-1]), (1, "1 passed, 0 failed"), lines)
                (self.tree / name).write_text(before)

    def test_tests_that_never_ran_count_as_a_failure(self):
        self.assertEqual(self.run_ci()[0], 0)
        self.program(self.tree / "test.sh", "exit 1")
        code, lines, _ = self.run_ci()
        self.assertEqual((code, lines[-1]), (1, "0 passed, 1 failed"), lines)

    def test_says_loudly_and_last_what_was_not_proved_without_a_root(self):
        self.program(self.tree / "tools/bare_root.sh", "echo 'bare_root: this user is not root' >&2; exit 3")
        code, lines, calls = self.run_ci()
        self.assertEqual((code, lines[-1]), (0, "1 passed, 0 failed"), lines)
        self.assertIn(f"in {self.tree}\n", calls)
        self.assertIn("NO BARE ROOT", "\n".join(lines))
        self.assertIn("NOT PROVED", "\n".join(lines[-3:]))
        self.assertIn("not root", lines[-2])


if __name__ == "__main__":
    unittest.main()
