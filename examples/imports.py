"""What the scripts of examples say where a Python package is missing."""
import contextlib
import sys
from pathlib import Path


@contextlib.contextmanager
def needed():
    """Around imports: a missing package ends the process with 2 and says what to install."""
    try:
        yield
    except ModuleNotFoundError as error:
        package = str(error.name).partition(".")[0]
        remedy = "install it as docs/python.md says" if package == "roboss" else f"pip install {package}"
        print(f"{Path(sys.argv[0]).stem}: the Python package {package} is missing\n  remedy: {remedy}", file=sys.stderr)
        sys.exit(2)
