"""The commands that the pages show have the options that the command has, and name files that are there. tools/try_pages runs
them to their ends."""
import importlib.machinery
import importlib.util
import re
import shlex
import subprocess
import sys
import unittest
from functools import cache
from pathlib import Path

ROBOSS, WORLDS = Path(sys.argv[1]), Path(sys.argv[3])
ROOT = WORLDS.parent
PAGES = [*(ROOT / name for name in ("README.md", "CONTRIBUTING.md", "deploy/README.md")), *sorted((ROOT / "docs").glob("*.md"))]
GROUPS = ("journal", "cluster", "keys")  # commands of which the second word is a command, too
PYTHON = ("record", "plot", "analyse", "calibrate")  # parsed by the Python package


def load_tool(path):
    loader = importlib.machinery.SourceFileLoader(path.name, str(path))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(path.name, loader))
    loader.exec_module(module)
    return module


try_pages = load_tool(ROOT / "tools/try_pages")


@cache
def help_of(*words):
    done = subprocess.run([ROBOSS, *words, "--help-all"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        done = subprocess.run([ROBOSS, *words, "--help"], capture_output=True, text=True, check=False)
    return done.stdout if done.returncode == 0 else None


def shown():
    """(page, words) of each command that the pages show."""
    for page in PAGES:
        for command in try_pages.commands_of(page.read_text()):
            yield page.name, shlex.split(command.rstrip("& "))


def roboss_commands():
    """(page, command's words, other words) of each command of `roboss`."""
    for page, words in shown():
        while words and "=" in words[0]:
            words = words[1:]
        if words and Path(words[0]).name == "roboss" and len(words) > 1 and words[1] not in PYTHON:
            depth = 2 if words[1] in GROUPS else 1
            yield page, tuple(words[1:1 + depth]), words[1 + depth:]


class Pages(unittest.TestCase):
    def test_show_commands_and_options_that_there_are(self):
        seen = 0
        for page, command, words in roboss_commands():
            text = help_of(*command)
            self.assertIsNotNone(text, f"{page}: roboss {' '.join(command)} is no command")
            options = set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", text))
            for word in words:
                if re.match(r"--?[a-z]", word):
                    self.assertIn(word.split("=")[0], options, f"{page}: roboss {' '.join(command)}")
                    seen += 1
        self.assertGreater(seen, 50)

    def test_name_files_that_are_there(self):
        seen = 0
        for page, words in shown():
            for word in words:
                if re.match(r"(\./\w+\.sh|(worlds|tools|examples|bench|deploy)/[\w./-]+)$", word) and "SHARE" not in word:
                    self.assertTrue((ROOT / word).exists(), f"{page} shows {word}")
                    seen += 1
        self.assertGreater(seen, 50)

    def test_every_row_of_the_table_meets_a_command(self):
        table = try_pages.Commands(ROOT / "tools/page_commands.txt")
        for page in PAGES:
            for command in try_pages.commands_of(page.read_text()):
                command = table.replaced(page, command)
                for action in try_pages.ACTIONS:
                    table.of(action, page, command)
        self.assertEqual(table.unused(), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
