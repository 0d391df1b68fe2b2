"""tools/viewer_protocol: what it writes follows the schema, and a file that does not is found."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(os.environ["ROBOSS_TOOLS"])


class ViewerProtocol(unittest.TestCase):
    def setUp(self):
        self.root = Path(tempfile.mkdtemp(prefix="roboss_test_"))
        self.addCleanup(shutil.rmtree, self.root)
        for folder in ("src/gateway", "src/wire", "web/src"):
            (self.root / folder).mkdir(parents=True)
        self.schema = self.root / "src/gateway/protocol.json"
        shutil.copy(TOOLS.parent / "src/gateway/protocol.json", self.schema)

    def run_tool(self, *arguments):
        return subprocess.run([sys.executable, TOOLS / "viewer_protocol", *arguments, self.root], capture_output=True, text=True, timeout=60)

    def test_both_languages_have_the_same_numbers(self):
        self.assertEqual(self.run_tool().returncode, 0)
        header = (self.root / "src/wire/viewer_protocol.h").read_text()
        page = (self.root / "web/src/protocol.ts").read_text()
        self.assertIn("kStateBytes = 28;", header)
        self.assertIn("STATE_BYTES = 28;", page)
        self.assertIn("kStateEntryCoordinatesAt = 24;", header)
        self.assertIn("STATE_ENTRY_COORDINATES_AT = 24;", page)
        self.assertIn("tick: view.getFloat64(8, true)", page)

    def test_a_field_more_moves_those_behind_it(self):
        schema = json.loads(self.schema.read_text())
        schema["messages"]["State"]["header"].insert(4, {"name": "branch", "type": "u32"})
        self.schema.write_text(json.dumps(schema))
        self.run_tool()
        self.assertIn("kStateTickAt = 12;", (self.root / "src/wire/viewer_protocol.h").read_text())
        self.assertIn("STATE_BYTES = 32;", (self.root / "web/src/protocol.ts").read_text())

    def test_check_finds_a_file_that_is_not_up_to_date(self):
        self.assertEqual(self.run_tool("--check").returncode, 1)
        self.run_tool()
        self.assertEqual(self.run_tool("--check").returncode, 0)
        page = self.root / "web/src/protocol.ts"
        page.write_text(page.read_text().replace("= 28", "= 29"))
        found = self.run_tool("--check")
        self.assertEqual(found.returncode, 1)
        self.assertIn("web/src/protocol.ts", found.stdout)

    def test_without_a_page_there_is_only_the_header(self):
        shutil.rmtree(self.root / "web")
        self.assertEqual(self.run_tool().returncode, 0)
        self.assertFalse((self.root / "web").exists())


if __name__ == "__main__":
    unittest.main()
