"""tools/check_types finds types of one name in two files of one program, and nothing else."""
import unittest

from check_tree import run_check


def run(files):
    return run_check("check_types", files)


def inside(namespace, text):
    return f"namespace {namespace} {{\n{text}\n}}\n"


class CheckTypes(unittest.TestCase):
    def finds(self, one, other, words, paths=("src/a/one.h", "src/b/two.cpp")):
        code, output = run(dict(zip(paths, (one, other))))
        self.assertEqual(code, 1, output)
        self.assertIn(words, output)

    def accepts(self, one, other, paths=("src/a/one.h", "src/b/two.cpp")):
        code, output = run(dict(zip(paths, (one, other))))
        self.assertEqual(code, 0, output)

    def test_finds_each_kind_of_type(self):
        for kind in ("struct T {", "class T final : public Base {", "enum class T : std::uint8_t {", "union T {",
                     "template <class X, int N>\nstruct T {", "struct alignas(64) T {", "class T : public A, private b::B<int> {"):
            self.finds(inside("n", kind + " };"), inside("n", kind + " };"), "src/b/two.cpp:2: n::T is also defined in src/a/one.h:2")

    def test_names_namespaces_and_outer_types(self):
        self.finds(inside("a::b", "struct T { int x() { return 1; } struct In {}; };"),
                   inside("a", "namespace b {\nstruct T;\nstruct T::In { };\n}"), "a::b::T::In")
        self.accepts(inside("a", "struct T {};"), inside("b", "struct T {};"))
        self.accepts(inside("a", "struct S { struct T {}; };"), inside("a", "struct T {};"))

    def test_leaves_what_other_files_cannot_see(self):
        shared = "struct T { int a = {}; };"
        self.accepts(inside("n", shared), inside("n", "namespace {\n" + shared + "\n}"))
        self.accepts(inside("n", shared), inside("n", "void f() { " + shared + " }\nint x = [] { " + shared + " return 0; }();"))

    def test_leaves_declarations_specialisations_comments_and_strings(self):
        self.accepts(inside("n", "struct T {};"), inside("n", "struct T;\n// struct T {\nconst char* t = \"struct T {\";"))
        self.accepts(inside("n", "template <class X> struct T {};"), inside("n", "template <> struct T<int> {};"))
        self.finds(inside("n", "template <> struct T<int> {};"), inside("n", "template <> struct T< int > {};"), "n::T<int>")

    def test_functions_that_return_a_type_are_no_types(self):
        self.accepts(inside("n", "struct T {};"), inside("n", "struct T make(int x) { return {}; }"))

    def test_programs_of_two_folders_are_apart_but_each_contains_the_product(self):
        text = inside("n", "struct T {};")
        self.accepts(text, text, ("tests/a/one.h", "tests/b/two.h"))
        self.finds(text, text, "n::T", ("src/a/one.h", "tests/b/two.h"))
        self.finds(text, text, "n::T", ("tests/support/one.h", "tests/b/two.h"))

    def test_refuses_an_empty_tree(self):
        self.assertEqual(run({"README.md": ""})[0], 1)


if __name__ == "__main__":
    unittest.main()
