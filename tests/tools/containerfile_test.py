"""deploy/Containerfile: what it copies is there, the groups that it installs exist, and they are what the program needs."""
import os
import platform
import re
import shlex
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

TOOLS = Path(os.environ["ROBOSS_TOOLS"])
ROOT = TOOLS.parent
PROGRAM = os.environ.get("ROBOSS_PROGRAM", "")
LOADED = Path(PROGRAM).parent.parent / "lib/libroboss_fastdds.so"  # by the program
ALWAYS_THERE = {"libc6", "libstdc++6", "libgcc-s1"}  # apt needs them
sys.path.insert(0, str(TOOLS))
import debian_licences  # noqa: E402


def instructions():
    """(instruction, rest) of each line, with continued lines as one."""
    text = (ROOT / "deploy/Containerfile").read_text().replace("\\\n", " ")
    lines = (line.strip() for line in text.splitlines())
    return [tuple(line.split(maxsplit=1)) for line in lines if line and not line.startswith("#")]


def packages(group, release):
    """The packages of a group of tools/packages.txt in a release."""
    lines = (line.split() for line in (TOOLS / "packages.txt").read_text().splitlines() if not line.startswith("#"))
    return {words[1] for words in lines if words[0] == group
            and not any(word.startswith("only=") and word != f"only={release}" for word in words[2:])}


class Containerfile(unittest.TestCase):
    def setUp(self):
        self.ignored = (ROOT / ".dockerignore").read_text().split()

    def test_stages_are_of_debian_12_or_have_a_name(self):
        names = set()
        for instruction, rest in instructions():
            if instruction == "FROM":
                image, *name = rest.split()
                self.assertTrue(image == "debian:12" or image in names, rest)
                names.update(name[1:])
        self.assertTrue(names)

    def test_what_it_copies_is_there(self):
        prefixes = re.findall(r"--prefix (\S+)", (ROOT / "deploy/Containerfile").read_text())
        copies = 0
        for instruction, rest in instructions():
            if instruction != "COPY":
                continue
            copies += 1
            *sources, _ = [word for word in rest.split() if not word.startswith("--")]
            for source in sources:
                if source not in prefixes:  # what the stage before installed is not a file of the repository
                    inside = Path(source).relative_to("/src") if source.startswith("/") else Path(source)
                    self.assertTrue((ROOT / inside).exists(), rest)
                    self.assertNotIn(str(inside), self.ignored)
        self.assertGreater(copies, 2)

    def test_the_groups_that_it_installs_exist(self):
        groups = [group for _, rest in instructions() for called in re.findall(r"tools/setup\.sh ([a-z ]+)", rest)
                  for group in shlex.split(called)]
        self.assertIn("run", groups)
        for group in groups:
            for release in ("bookworm", "trixie"):
                self.assertTrue(packages(group, release), group)

    def test_what_is_built_here_stays_outside(self):
        for folder in ("build", "dist", "web/node_modules"):
            self.assertIn(folder, self.ignored)

    def test_the_group_run_has_the_packages_of_the_programs_libraries(self):
        release = platform.freedesktop_os_release().get("VERSION_CODENAME", "")
        if not Path(PROGRAM).is_file() or not shutil.which("dpkg-query") or not packages("run", release):
            self.skipTest("no program, or no Debian")
        if not LOADED.is_file():
            self.skipTest("no Fast DDS")
        found = {}
        for program in (PROGRAM, LOADED):
            headers = subprocess.run(["readelf", "-d", program], capture_output=True, text=True, check=True).stdout
            needed = set(re.findall(r"\(NEEDED\).*\[(.*)\]", headers))
            loaded = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
            for name, path in re.findall(r"(\S+) => (/\S+)", loaded):
                if name in needed:
                    found[name] = debian_licences.package_of(Path(path)) or debian_licences.package_of(Path("/usr" + path))
        self.assertGreater(len(found), 5)
        names = {str(package).split(":")[0] for package in found.values()} - ALWAYS_THERE
        self.assertEqual(names, packages("run", release), found)


if __name__ == "__main__":
    unittest.main()
