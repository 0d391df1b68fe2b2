"""tools/check_prose accepts sound pages and comments, and names what is wrong in each kind of unsound one."""
import unittest

from check_tree import run_check

WORDS = """# a comment
except: STYLE.md
absent: tools/later
docs: behind its back => asynchronously
comments: \\btold\\b => reported
everywhere: \\bhelpless\\b => no work stealing
"""


def run(files):
    return run_check("check_prose", {"tools/prose_words.txt": WORDS, **files})


class CheckProse(unittest.TestCase):
    def accepts(self, files):
        code, output = run(files)
        self.assertEqual(code, 0, output)

    def refuses(self, files, words):
        code, output = run(files)
        self.assertEqual(code, 1, output)
        self.assertIn(words, output)

    def test_accepts_sound_pages_and_comments(self):
        self.accepts({
            "README.md": "# A page\nIt refers to docs/a.md, `core/a.h`, tools/later and decision 0001.\n",
            "docs/a.md": "Text.\n",
            "docs/decisions/0001-first.md": "Text.\n",
            "src/core/a.h": "// See b.cpp and docs/a.md.\nint told;\n",
            "src/core/b.cpp": 'const char* text = "told, behind its back, see nothing.h";\n',
            "tools/c": "#!/usr/bin/env python3\n# See src/core.\n",
        })

    def test_refuses_wide_lines_of_pages(self):
        self.refuses({"docs/a.md": "Short.\n" + "x" * 121 + "\n"}, "docs/a.md:2: 121 columns")
        self.accepts({"docs/a.md": "é" * 120 + "\n"})

    def test_rows_of_tables_and_generated_lines_may_be_wide(self):
        wide = "x" * 121
        self.accepts({"docs/a.md": f"| {wide} |\n<!-- rows: begin (a tool) -->\n{wide}\n<!-- rows: end -->\n"})
        self.refuses({"docs/a.md": f"<!-- rows: begin -->\n<!-- rows: end -->\n{wide}\n"}, "docs/a.md:3")

    def test_refuses_words_in_their_scope_only(self):
        self.refuses({"docs/a.md": "It works behind its back.\n"}, 'docs/a.md:1: "behind its back": write asynchronously')
        self.accepts({"src/a.cpp": "// behind its back\n"})
        self.refuses({"src/a.cpp": "int a;\n// It is told.\n"}, 'src/a.cpp:2: "told"')
        self.accepts({"src/a.cpp": 'int told; const char* b = "// told";\n'})
        self.refuses({"src/a.cpp": 'auto a = "--helpless";\n'}, 'src/a.cpp:1: "helpless"')
        self.refuses({"docs/a.md": "Told.\n"}, '"Told"')

    def test_finds_words_in_comments_of_every_language(self):
        self.refuses({"src/a.h": "int a;  // told\n"}, "src/a.h:1")
        self.refuses({"web/src/a.ts": "/* is\n * told */\n"}, "web/src/a.ts:2")
        self.refuses({"tools/a.py": '"""It is told."""\n'}, "tools/a.py:1")
        self.refuses({"tools/a.sh": "echo  # told\n"}, "tools/a.sh:1")
        self.refuses({"cmake/a.cmake": "# told\n"}, "cmake/a.cmake:1")

    def test_finds_phrases_across_lines(self):
        self.refuses({"docs/a.md": "It works behind\nits back.\n"}, "docs/a.md:1")

    def test_exceptions_may_have_the_words_but_not_the_width(self):
        self.accepts({"STYLE.md": "Not: told, helpless.\n"})
        self.refuses({"STYLE.md": "x" * 121 + "\n"}, "STYLE.md:1: 121 columns")

    def test_refuses_references_to_files_that_do_not_exist(self):
        self.refuses({"README.md": "See docs/b.md.\n"}, "README.md:1: refers to docs/b.md, which does not exist")
        self.refuses({"src/core/a.h": "// See gone.h.\n"}, "src/core/a.h:1: refers to gone.h")
        self.refuses({"src/core/a.h": "\n// See core/gone.cpp.\n"}, "src/core/a.h:2: refers to core/gone.cpp")
        self.refuses({"tools/a.py": "# See tools/gone\n"}, "refers to tools/gone")
        self.refuses({"README.md": "See decisions 0001 and 0002.\n", "docs/decisions/0001-a.md": "Text.\n"},
                     "refers to decision 0002")

    def test_placeholders_and_code_blocks_of_pages_are_no_references(self):
        self.accepts({"README.md": "docs/decisions/NNNN-title.md and src/NAME\n```\nsee docs/gone.md\n```\n"})

    def test_refuses_a_word_list_that_it_does_not_understand(self):
        self.refuses({"tools/prose_words.txt": "somewhere: a => b\n", "README.md": "Text.\n"}, "tools/prose_words.txt:1")

    def test_refuses_an_empty_tree(self):
        self.assertEqual(run_check("check_prose", {})[0], 1)


if __name__ == "__main__":
    unittest.main()
