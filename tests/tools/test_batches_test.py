"""tools/test_batches puts test files together only where no private name of one is a word in another."""
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

TOOL = Path(os.environ["ROBOSS_TOOLS"]) / "test_batches"


def file_of(definition, body="EXPECT_TRUE(true);"):
    return f'#include <gtest/gtest.h>\nnamespace roboss {{\nnamespace {{\n\n{definition}\n\nTEST(A, B) {{\n    {body}\n}}\n\n}}  // namespace\n}}\n'


class TestBatches(unittest.TestCase):
    def batches(self, *texts, most=8):
        with tempfile.TemporaryDirectory() as folder:
            files = [Path(folder) / f"t{i}_test.cpp" for i in range(len(texts))]
            for file, text in zip(files, texts):
                file.write_text(text)
            done = subprocess.run([TOOL, "--most", str(most), *files], check=True, capture_output=True, text=True)
            return [[Path(file).name[1] for file in line.split(";")] for line in done.stdout.split()]

    def test_files_of_different_names_go_together_up_to_the_most(self):
        texts = [file_of(f"constexpr double k{i} = 1;") for i in range(5)]
        self.assertEqual(self.batches(*texts, most=3), [["0", "1", "2"], ["3", "4"]])

    def test_every_kind_of_definition_keeps_two_files_apart(self):
        for definition in ("constexpr double kLong = 1;", "const Vec3 kSide{1, 2, 3};", "double kA = 0, kB = 1;",
                           "struct Probe {\n    int n = 0;\n};", "class Probe final : public Base {};",
                           "enum class Way { kIn };", "using Rows = std::vector<double>;", "namespace fs = std::filesystem;",
                           "std::vector<int> rows_of(const World& world,\n                         int n) {\n    return {};\n}",
                           "template <class T>\nT twice(T x) {\n    return x + x;\n}",
                           "constexpr std::array<int, 2> kPair = {1, 2};", "double table[3] = {1, 2, 3};"):
            with self.subTest(definition):
                self.assertEqual(self.batches(file_of(definition), file_of(definition)), [["0"], ["1"]])

    def test_a_name_that_another_file_only_uses_keeps_them_apart(self):
        self.assertEqual(self.batches(file_of("void load(int n) {}"), file_of("", "load(world);")), [["0"], ["1"]])
        self.assertEqual(self.batches(file_of("", "const double kG = 2;"), file_of("constexpr double kG = 9.8;")), [["0"], ["1"]])

    def test_members_texts_and_comments_keep_nothing_apart(self):
        body = 'run.load(); // load\n    EXPECT_EQ(text, "load");\n    World w{.load = 1};'
        self.assertEqual(self.batches(file_of("void load(int n) {}"), file_of("", body)), [["0", "1"]])

    def test_a_file_that_is_not_there_is_told(self):
        done = subprocess.run([TOOL, "nowhere_test.cpp"], capture_output=True, text=True)
        self.assertEqual((done.returncode, "nowhere_test.cpp" in done.stderr), (1, True))


if __name__ == "__main__":
    unittest.main()
