"""tools/check_sizes measures files and functions rightly, holds the limits, and only ever tightens the ratchet."""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL = Path(os.environ["ROBOSS_TOOLS"]) / "check_sizes"


def function(name, lines):
    return f"int {name}(int x) {{\n" + "    x += 1;\n" * (lines - 2) + "}\n"


class CheckSizes(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = Path(self.folder.name)
        (self.root / "src").mkdir()
        (self.root / "tools").mkdir()

    def write(self, name, text):
        (self.root / name).write_text(text)

    def run_tool(self, *options):
        done = subprocess.run([sys.executable, TOOL, *options, self.root], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def test_holds_the_hard_limits_without_a_ratchet_file(self):
        self.write("src/a.cpp", function("f", 70))
        self.assertEqual(self.run_tool()[0], 0)
        self.write("src/a.cpp", function("f", 71))
        code, output = self.run_tool()
        self.assertEqual(code, 1)
        self.assertIn("src/a.cpp:1 f: function of 71 lines", output)
        self.write("src/a.cpp", "// line\n" * 601)
        self.assertIn("file of 601 lines", self.run_tool()[1])

    def test_ratchet_only_tightens(self):
        self.write("src/a.cpp", function("f", 30))
        self.assertEqual(self.run_tool("--update")[0], 0)
        self.assertEqual((self.root / "tools/sizes.txt").read_text(), "file 30\nfunction 30\n")
        self.write("src/a.cpp", function("f", 31))
        self.assertEqual(self.run_tool("--update")[0], 1)
        self.assertEqual((self.root / "tools/sizes.txt").read_text(), "file 30\nfunction 30\n")

    def test_a_ratchet_file_cannot_loosen_the_hard_limits(self):
        self.write("tools/sizes.txt", "file 9000\nfunction 900\n")
        self.write("src/a.cpp", function("f", 71))
        self.assertEqual(self.run_tool()[0], 1)

    def test_finds_functions_in_namespaces_classes_and_after_initialisers(self):
        self.write("src/a.cpp", '''namespace a {
struct Table { int x[2] = {1, 2}; };
const char* text = "{ not code } (";
// { nor this
class B : public C {
  public:
    explicit B(int x) : x_(x) {
        run([&] { x_ = 1; });
    }
    int value() const { return x_; }
};
template <class T>
T twice(const T& t) {
    if (t > 0) {
        return t + t;
    }
    return T{0};
}
}  // namespace a
''')
        output = self.run_tool("--worst", "9")[1]
        self.assertIn("7 lines  function  src/a.cpp:12 twice", output)
        self.assertIn("3 lines  function  src/a.cpp:7 B", output)
        self.assertIn("1 lines  function  src/a.cpp:10 value", output)
        self.assertIn("3 functions", output)


if __name__ == "__main__":
    unittest.main()
