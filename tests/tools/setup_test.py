"""tools/setup.sh: no apt when nothing is missing, the right packages when something is, a clear word when it cannot."""
import os
import platform
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(os.environ["ROBOSS_TOOLS"])
# Stand-ins for the system's programs: `installed` lists what dpkg-query knows, `calls` receives each call of apt-get.
DPKG_QUERY = '#!/bin/bash\ngrep -qxF "${!#}" "$STAND_INS/installed" && echo installed || { echo "no packages found" >&2; exit 1; }\n'
APT_GET = '#!/bin/bash\necho "$DEBIAN_FRONTEND $*" >> "$STAND_INS/calls"\n'


class Setup(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = Path(self.folder.name)
        self.stand_in("dpkg-query", DPKG_QUERY)
        self.stand_in("apt-get", APT_GET)
        self.stand_in("id", "#!/bin/bash\necho 0\n")

    def stand_in(self, name, text):
        path = self.root / name
        path.write_text(text)
        path.chmod(0o755)

    def os_release(self, codename):
        """A file like /etc/os-release of that release."""
        path = self.root / "os-release"
        path.write_text(f"VERSION_CODENAME={codename}\n")
        return str(path)

    def run_setup(self, installed, *groups, path=None, **more):
        (self.root / "installed").write_text("".join(f"{name}\n" for name in installed))
        environment = {"PATH": path or f"{self.root}:/usr/bin:/bin", "STAND_INS": str(self.root), **more}
        done = subprocess.run(["/bin/bash", TOOLS / "setup.sh", *groups], env=environment, capture_output=True, text=True, check=False)
        calls = self.root / "calls"
        return done.returncode, done.stdout + done.stderr, calls.read_text() if calls.exists() else ""

    @staticmethod
    def packages(group):
        lines = (line.split() for line in (TOOLS / "packages.txt").read_text().splitlines() if not line.startswith("#"))
        return [words[1] for words in lines if words[0] == group and not Setup.is_there_anyway(words) and not Setup.is_elsewhere(words)]

    @staticmethod
    def is_elsewhere(words):
        """Marked only=RELEASE, and this machine has another one."""
        release = platform.freedesktop_os_release().get("VERSION_CODENAME", "")
        return any(word.startswith("only=") and word != f"only={release}" for word in words)

    @staticmethod
    def is_there_anyway(words):
        """Marked unless=COMMAND, and this machine has the command."""
        marks = [word.removeprefix("unless=") for word in words if word.startswith("unless=")]
        return any(shutil.which(command, path="/usr/bin:/bin") for command in marks)

    def test_calls_no_apt_when_all_is_there(self):
        code, output, calls = self.run_setup(self.packages("build"), "build")
        self.assertEqual((code, output, calls), (0, "", ""))

    def test_installs_just_what_is_missing_without_questions(self):
        code, output, calls = self.run_setup(self.packages("build")[1:], "build", "test")
        self.assertEqual(code, 0, output)
        update, install = calls.splitlines()
        self.assertIn("update", update)
        self.assertTrue(install.startswith("noninteractive install"), install)
        wanted = [word for word in install.split()[2:] if not word.startswith("-")]
        self.assertEqual(wanted, self.packages("build")[:1] + self.packages("test"))

    def test_says_what_to_do_without_root_and_sudo(self):
        self.stand_in("id", "#!/bin/bash\necho 1000\n")
        for name in ("bash", "grep", "dirname", "env"):
            os.symlink(f"/usr/bin/{name}", self.root / name)
        code, output, calls = self.run_setup([], "bench", path=str(self.root))
        self.assertEqual((code, calls), (1, ""))
        self.assertIn("neither root nor has sudo: libbenchmark-dev", output)
        self.assertIn("apt-get install --no-install-recommends libbenchmark-dev", output)

    def test_says_what_to_do_on_a_system_without_apt(self):
        (self.root / "apt-get").unlink()
        for name in ("bash", "grep", "dirname", "env"):
            os.symlink(f"/usr/bin/{name}", self.root / name)
        code, output, _ = self.run_setup([], "build", path=str(self.root))
        self.assertEqual(code, 1)
        self.assertIn("ROBOSS_SKIP_SETUP=1", output)
        self.assertEqual(self.run_setup([], "build", path=str(self.root), ROBOSS_SKIP_SETUP="1")[0], 0)

    def test_installs_the_packages_of_this_release(self):
        for release, its, other in (("bookworm", "libssl3", "libssl3t64"), ("trixie", "libssl3t64", "libssl3")):
            (self.root / "calls").unlink(missing_ok=True)
            code, output, calls = self.run_setup([], "run", ROBOSS_OS_RELEASE=self.os_release(release))
            self.assertEqual(code, 0, output)
            self.assertIn(its, calls.split())
            self.assertNotIn(other, calls.split())

    def test_says_that_a_release_is_not_supported_and_tries(self):
        code, output, calls = self.run_setup([], "bench", ROBOSS_OS_RELEASE=self.os_release("noble"))
        self.assertEqual(code, 0, output)
        self.assertIn("noble is not supported (Debian 12 and 13 are)", output)
        self.assertIn("libbenchmark-dev", calls)
        self.assertNotIn("not supported", self.run_setup([], "bench", ROBOSS_OS_RELEASE=self.os_release("trixie"))[1])

    def test_refuses_a_group_whose_names_an_unsupported_release_does_not_have(self):
        code, output, calls = self.run_setup([], "run", ROBOSS_OS_RELEASE=self.os_release("bullseye"))
        self.assertEqual((code, calls), (1, ""))
        self.assertIn("bullseye is not supported, and libpng16-16 of the group run has another name there", output)
        self.assertIn("ROBOSS_SKIP_SETUP=1", output)

    def test_says_why_apt_failed_and_what_to_do(self):
        for words, said, remedy in (
                ("E: Unable to locate package libbenchmark-dev", "do not have: libbenchmark-dev", "apt-get update"),
                ("E: Package 'libbenchmark-dev' has no installation candidate", "do not have: libbenchmark-dev", "by hand"),
                ("E: Failed to fetch x  Temporary failure resolving 'm'", "no network: apt-get could not fetch: libbenchmark-dev", "proxy"),
                ("E: You don't have enough free space in /var/cache/apt/archives/.", "the disk is full", "apt-get clean"),
                ("E: Failed to fetch x  Write error - write (28: No space left on device)", "the disk is full", "df -h"),
                ("E: something else", "apt-get could not install: libbenchmark-dev", "read apt's message")):
            with self.subTest(words=words):
                self.stand_in("apt-get", f'#!/bin/bash\n[[ $1 == install ]] || exit 0\necho "{words}" >&2\nexit 100\n')
                # A full disk takes no file of apt's words, so the reason must be found without one.
                code, output, _ = self.run_setup([], "bench", ROBOSS_OS_RELEASE=self.os_release("bookworm"), TMPDIR="/no/such/folder")
                self.assertEqual(code, 1)
                for word in (words, said, "  remedy: ", remedy):
                    self.assertIn(word, output)

    def test_refuses_a_group_that_is_not_there(self):
        code, output, _ = self.run_setup([], "nonsense", ROBOSS_OS_RELEASE=self.os_release("trixie"))
        self.assertEqual(code, 1)
        self.assertIn("no packages for trixie in: nonsense", output)


if __name__ == "__main__":
    unittest.main()
