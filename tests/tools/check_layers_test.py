"""tools/check_layers accepts a sound tree and names what is wrong in each kind of unsound one."""
import unittest

from check_tree import run_check

LAYERS = "roboss_layer(core)\nroboss_layer(math DEPENDS core)\nroboss_layer(sdf DEPENDS math)\nroboss_layer(sensors DEPENDS math)\n"


def run(files):
    return run_check("check_layers", {"CMakeLists.txt": LAYERS, **files})


class CheckLayers(unittest.TestCase):
    def refuses(self, files, words):
        code, output = run(files)
        self.assertEqual(code, 1, output)
        self.assertIn(words, output)

    def test_accepts_includes_of_the_same_and_of_all_lower_layers(self):
        code, output = run({
            "src/core/a.h": "#include <vector>\n",
            "src/math/b.h": "",
            "src/math/b.cpp": '#include "math/b.h"\n#include "core/a.h"\n',
            "src/sdf/c.cpp": '#include "core/a.h"\n',
            "src/sdf/c_test.cpp": '#include <sdf/sdf.hh>\n',
            "src/app/d.cpp": '#include <CLI/CLI.hpp>\n#include "math/b.h"\n',
            "src/math/b_test.cpp": "#include <gtest/gtest.h>\n#include <random>\n",
        })
        self.assertEqual(code, 0, output)

    def test_refuses_a_higher_layer(self):
        self.refuses({"src/core/a.cpp": '#include "math/b.h"\n', "src/math/b.h": ""},
                     'src/core/a.cpp:1: layer core may not include "math/b.h"')

    def test_refuses_a_sibling_layer(self):
        self.refuses({"src/sdf/a.cpp": '\n#include "sensors/b.h"\n', "src/sensors/b.h": ""}, "src/sdf/a.cpp:2")

    def test_refuses_an_external_library_outside_its_layer(self):
        self.refuses({"src/math/a.cpp": "#include <pugixml.hpp>\n"}, "<pugixml.hpp> belongs in xml only")

    def test_refuses_a_library_that_nobody_listed(self):
        self.refuses({"src/core/a.cpp": "#include <curl/curl.h>\n"}, "<curl/curl.h> is not known")

    def test_refuses_test_libraries_in_the_product(self):
        self.refuses({"src/core/a.cpp": "#include <gtest/gtest.h>\n"}, "<gtest/gtest.h> belongs in tests only")

    def test_refuses_clocks_and_threads_where_bits_must_be_equal(self):
        self.refuses({"src/math/a.cpp": "#include <chrono>\n"}, "<chrono> in layer math")
        self.refuses({"src/sdf/a.cpp": "#include <thread>\n"}, "<thread> in layer sdf")

    def test_refuses_files_in_a_circle(self):
        self.refuses({"src/core/a.h": '#include "core/b.h"\n', "src/core/b.h": '#include "core/a.h"\n'},
                     "core/a.h -> core/b.h -> core/a.h")

    def test_refuses_a_header_that_is_not_there(self):
        self.refuses({"src/core/a.h": '#include "b.h"\n', "src/core/b.h": ""}, '"b.h" is not a file of src/')

    def test_refuses_a_folder_that_is_no_layer(self):
        self.refuses({"src/extra/a.h": ""}, "the folder extra is no layer")

    def test_refuses_an_empty_tree(self):
        self.assertEqual(run({"README.md": ""})[0], 1)


if __name__ == "__main__":
    unittest.main()
