"""Pages are there, what they point to is there, and the program that the README shows is the one that is tested."""
import os
import re
import unittest
from pathlib import Path

ROOT = Path(os.environ["ROBOSS_TOOLS"]).resolve().parent
APART = {"build", "node_modules", ".git"}
LINK = re.compile(r"\]\(([^)#\s]*)(?:#([^)\s]*))?[^)]*\)")
CODE = re.compile(r"^```\w*\n(.*?)^```", re.DOTALL | re.MULTILINE)
README_LINES = 150


def pages():
    return sorted(ROOT.glob("*.md")) + [
        page for folder in ("docs", "deploy", "examples") for page in (ROOT / folder).rglob("*.md") if not APART & set(page.parts)]


def anchors(page):
    """The anchors of a page's headings, as GitHub makes them."""
    headings = re.findall(r"^#+ (.*)$", CODE.sub("", page.read_text()), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


class Pages(unittest.TestCase):
    def test_none_is_empty(self):
        for page in pages():
            self.assertGreater(len(page.read_text().split()), 20, page)

    def test_the_readme_begins_with_two_commands_and_a_picture(self):
        text = (ROOT / "README.md").read_text()
        for words in ("./run.sh", "./test.sh", "](docs/images/", "## Measured"):
            self.assertIn(words, text)

    def test_the_readme_is_short(self):
        self.assertLessEqual(len((ROOT / "README.md").read_text().splitlines()), README_LINES)

    def test_the_readme_shows_the_program_that_is_tested(self):
        shown = CODE.findall((ROOT / "README.md").read_text())
        self.assertIn((ROOT / "examples/first_robot/circle.cpp").read_text(), shown)

    def test_links_lead_somewhere(self):
        for page in pages():
            for target, anchor in LINK.findall(CODE.sub("", page.read_text())):
                if "://" in target:
                    continue
                where = page.parent / target if target else page
                name = f"{page.relative_to(ROOT)} points to {target}"
                self.assertTrue(where.exists(), name)
                if anchor:
                    self.assertIn(anchor, anchors(where), name)

    def test_the_index_names_every_page(self):
        index = ROOT / "docs" / "README.md"
        named = {(index.parent / target).resolve() for target, _ in LINK.findall(index.read_text())}
        for page in (ROOT / "docs").glob("*.md"):
            if page != index:
                self.assertIn(page.resolve(), named, page)


if __name__ == "__main__":
    unittest.main()
