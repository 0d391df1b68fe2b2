"""Each line of docs/security.md names tests that exist."""
import os
import re
import unittest
from pathlib import Path

ROOT = Path(os.environ["ROBOSS_TOOLS"]).resolve().parent
GTEST = re.compile(r"\bTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\s*\)")
FOLDERS = ("src", "tests")


def tests_there():
    """Names as the page writes them: Suite.Claim, Class.test_claim, command.NAME, processes.NAME."""
    names = set()
    for folder in FOLDERS:
        for source in (ROOT / folder).rglob("*_test.cpp"):
            names |= {".".join(found) for found in GTEST.findall(source.read_text())}
    for source in (ROOT / "tests").rglob("*_test.py"):
        owner = ""
        for line in source.read_text().splitlines():
            if found := re.match(r"class (\w+)", line):
                owner = found[1]
            elif found := re.match(r"    def (test_\w+)", line):
                names.add(f"{owner}.{found[1]}")
        names.add(f"{source.parent.name}.{source.name.removesuffix('_test.py')}")
    return names


def rows(text):
    """(first cell, tests) of each line of the tables."""
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if line.startswith("|") and len(cells) == 3 and cells[0] not in ("what somebody may try", "---"):
            suite, names = "", []
            for name in re.findall(r"`([^`]+)`", cells[2]):
                suite = suite if name.startswith(".") else name.split(".")[0]
                names.append(suite + name if name.startswith(".") else name)
            yield cells[0], names


def missing(text, there):
    """The rows and names that no test stands for."""
    found = []
    for claim, names in rows(text):
        found += [claim] if not names else []
        for name in names:
            known = (ROOT / name).exists() if "/" in name else any(
                t.startswith(name[:-1]) for t in there) if name.endswith("*") else name in there
            found += [] if known else [name]
    return found


class SecurityPage(unittest.TestCase):
    def test_each_line_names_tests_that_exist(self):
        text = (ROOT / "docs/security.md").read_text()
        self.assertGreater(len(list(rows(text))), 20)
        self.assertEqual(missing(text, tests_there()), [])

    def test_a_line_without_a_test_and_a_test_that_is_not_there_are_found(self):
        text = "| what somebody may try | b | test |\n|---|---|---|\n| bare | b | |\n| x | b | `A.B`, `.C`, `A.*`, `src/none` |\n"
        self.assertEqual(missing(text, {"A.B"}), ["bare", "A.C", "src/none"])


if __name__ == "__main__":
    unittest.main()
