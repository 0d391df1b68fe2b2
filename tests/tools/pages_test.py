"""Pages are there, and what they point to is there too."""
import os
import re
import unittest
from pathlib import Path

ROOT = Path(os.environ["ROBOSS_TOOLS"]).resolve().parent
APART = {"build", "node_modules", ".git"}
LINK = re.compile(r"\]\(([^)#\s]+)[^)]*\)")


def pages():
    return [ROOT / name for name in ("README.md", "ARCHITECTURE.md", "CHANGELOG.md")] + [
        page for folder in ("docs", "deploy", "examples") for page in (ROOT / folder).rglob("*.md") if not APART & set(page.parts)]


class Pages(unittest.TestCase):
    def test_none_is_empty(self):
        for page in pages():
            self.assertGreater(len(page.read_text().split()), 20, page)

    def test_the_readme_begins_with_two_commands_and_a_picture(self):
        text = (ROOT / "README.md").read_text()
        for words in ("./run.sh", "./test.sh", "](docs/images/", "## Measured"):
            self.assertIn(words, text)

    def test_links_lead_somewhere(self):
        for page in pages():
            for target in LINK.findall(page.read_text()):
                if "://" not in target:
                    self.assertTrue((page.parent / target).exists(), f"{page.relative_to(ROOT)} points to {target}")


if __name__ == "__main__":
    unittest.main()
