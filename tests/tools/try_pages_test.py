"""tools/try_pages: which lines it takes for commands, and its verdict on commands that end, fail, and never end."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(os.environ["ROBOSS_TOOLS"])


class TryPages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        (self.root / "tools").mkdir()
        shutil.copy(TOOLS / "try_pages", self.root / "tools/try_pages")

    def run_tool(self, page, table="", *options):
        (self.root / "page.md").write_text(page)
        (self.root / "tools/page_commands.txt").write_text(table)
        done = subprocess.run([sys.executable, "-B", self.root / "tools/try_pages", *options, self.root / "page.md"],
                              capture_output=True, text=True, check=False)
        return done.returncode, done.stdout.splitlines(), done.stderr

    def log(self):
        return (self.root / "build/try_pages.log").read_text()

    def test_takes_commands_and_leaves_output_and_code(self):
        page = "# A page\n\n    echo one      # says it\n    one\n    echo a \\\n        b && echo c\n- list\n\n    roboss: a notice\n" \
               "```cpp\n    echo no\n```\necho no\n"
        self.assertEqual(self.run_tool(page, "", "--list")[1], ["page.md: echo one", "page.md: echo a b", "page.md: echo c"])

    def test_counts_what_fails(self):
        code, lines, _ = self.run_tool("    echo fine\n    cd nowhere\n    ./gone.sh\n")
        self.assertEqual(code, 1)
        self.assertIn("pages: 2 passed, 1 failed, 0 skipped", lines[-1])

    def test_commands_of_a_page_share_folder_and_variables(self):
        (self.root / "deep").mkdir()
        code, lines, _ = self.run_tool("    cd deep\n    word=shared\n    echo $word > made.txt\n")
        self.assertEqual((code, (self.root / "deep/made.txt").read_text()), (0, "shared\n"), lines)

    def test_interrupts_what_never_ends(self):
        wait = self.root / "wait.sh"
        for end, wanted in (("trap 'echo interrupted; exit 130' INT", 0), ("trap 'exit 4' INT", 1)):
            wait.write_text(f"#!/bin/bash\n{end}\nwhile true; do sleep 0.1; done\n")
            wait.chmod(0o755)
            code, lines, _ = self.run_tool("    ./wait.sh\n", "seconds | wait | 1\n")
            self.assertEqual(code, wanted, lines)
        self.assertIn("interrupted", self.log())

    def test_the_table_skips_replaces_and_starts_in_the_background(self):
        table = "skip | page.md: sudo | needs root\nreplace | YOUR | my\nbehind | sleep | 0\nreplace | other.md: my | no\n"
        code, lines, _ = self.run_tool("    sudo rm x\n    echo YOUR name\n    cd . && echo begin && sleep 100 &\n"
                                       "    python3 -c 'import time; time.sleep(100)' # sleep\n", table)
        self.assertEqual(lines[1].split("    "), ["skipped  sudo rm x", "[needs root]"])
        self.assertIn("=== echo my name", self.log())
        self.assertIn("1 skipped", lines[-1])
        self.assertEqual(code, 1, "python ends an interrupt with a traceback")

    def test_refuses_a_table_that_it_does_not_understand(self):
        code, _, error = self.run_tool("", "ship | x\n")
        self.assertEqual(code, 1)
        self.assertIn("page_commands.txt:1", error)


if __name__ == "__main__":
    unittest.main()
