"""tools/bare_root.sh: what it refuses, with which remedy, what a root gets, and what comes out of it. A real root needs root, a
network and half a minute, so debootstrap is a stand-in here."""
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
    "debootstrap": "echo \"$*\" > \"$STAND_INS/call\"; root=${@: -2:1}; mkdir -p \"$root\"/etc/apt/apt.conf.d \"$root/root\"",
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
        for name in ("bare_root.sh", "debian_archives.sh", "setup.sh", "packages.txt"):
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
        self.refused(2, "no release 'sarge'", "usage: tools/bare_root.sh bookworm|trixie[-arm64] DIR", release="sarge")
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

    def test_makes_a_root_of_another_processor_that_the_kernel_can_start(self):
        self.program(self.bin / "uname", "echo aarch64")
        code, output = self.make("trixie-arm64")
        self.assertEqual(code, 0, output)
        call = (self.bin / "call").read_text()
        self.assertIn(" --arch=arm64 ", call)
        self.assertTrue(call.endswith(f" trixie {self.root} http://m/debian/\n"), call)
        self.assertIn("deb http://m/debian/ trixie main", (self.root / "etc/apt/sources.list").read_text())
        self.refused(2, "a root of trixie-arm64, not of trixie", release="trixie")
        self.program(self.bin / "uname", "echo x86_64")
        self.program(self.bin / "grep", "exit 1")
        self.refused(3, "no programs of arm64", "qemu-user-static", release="trixie-arm64", root=self.base / "other")

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

    def test_what_changed_is_new_and_the_rest_keeps_its_time(self):
        copy, long_ago = self.root / "root/roboss", 10**9
        (self.tree / "folder/b.txt").chmod(0o644)
        self.assertEqual(self.make()[0], 0)
        os.utime(copy / "folder/b.txt", (long_ago, long_ago))
        self.files({"a.txt": "edited while a build read it", "folder/b.txt": "two"})
        os.utime(self.tree / "a.txt", (long_ago, long_ago))
        (copy / "object").write_text("of the first one")
        self.assertEqual(self.make()[0], 0)
        self.assertGreaterEqual((copy / "a.txt").stat().st_mtime, (copy / "object").stat().st_mtime)
        self.assertEqual((copy / "folder/b.txt").stat().st_mtime, long_ago)
        (self.tree / "folder/b.txt").chmod(0o755)
        self.assertEqual(self.make()[0], 0)
        self.assertEqual((copy / "folder/b.txt").stat().st_mode & 0o777, 0o755)

    def test_the_exit_code_is_that_of_the_command(self):
        self.program(self.bin / "unshare", '[[ ${!#} == true ]] || exit 7')
        self.assertEqual(self.make("bookworm", self.root, "ls")[0], 7)


if __name__ == "__main__":
    unittest.main()
