"""The notebooks of examples/notebooks, run from the first cell to the last as a person would."""
import subprocess
import sys

import pytest

from conftest import REPOSITORY

NOTEBOOKS = sorted((REPOSITORY / "examples" / "notebooks").glob("*.ipynb"))
RUN = """
import sys, nbformat
from nbclient import NotebookClient
notebook = nbformat.read(sys.argv[1], 4)
assert not any(cell.get("outputs") for cell in notebook.cells), "kept without outputs"
NotebookClient(notebook, timeout=300).execute()
kinds = {kind for cell in notebook.cells for output in cell.get("outputs", []) for kind in output.get("data", {})}
assert "image/png" in kinds, kinds
"""


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_runs(notebook, tmp_path):
    done = subprocess.run([sys.executable, "-P", "-c", RUN, notebook], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-3000:]


def test_there_are_notebooks():
    assert len(NOTEBOOKS) >= 6
