"""The Python in the pages passes `mypy --strict` against the installed wheel."""
import subprocess
import sys

import pytest

from conftest import BLOCK, PAGES, REPOSITORY


@pytest.mark.parametrize("page", PAGES)
def test_examples_pass_strict_type_checks(page, tmp_path):
    program = tmp_path / "page.py"
    program.write_text("\n".join(BLOCK.findall((REPOSITORY / page).read_text())))
    found = check(program, tmp_path)
    assert found.returncode == 0, found.stdout


def test_a_wrong_type_is_found(tmp_path):
    """Else the test above could not fail: without the package's types everything is right."""
    program = tmp_path / "wrong.py"
    program.write_text("import roboss\n\nroboss.Simulation(roboss.example('pile.sdf')).step('10')\n"
                       "roboss.Simulation(roboss.example('pile.sdf')).save().tick.bit_length(2)\n")
    found = check(program, tmp_path)
    assert found.returncode == 1 and found.stdout.count("error:") == 2, found.stdout


def check(program, folder):
    return subprocess.run([sys.executable, "-P", "-m", "mypy", "--strict", "--cache-dir", folder / "cache", program], cwd=folder,
                          capture_output=True, text=True, check=False)
