"""Runs a check of tools/ over a small tree of files."""
import os
import subprocess
import sys
import tempfile
from pathlib import Path


def run_check(name, files):
    """Exit code and output of tools/NAME over a tree of {path: text}."""
    tool = Path(os.environ["ROBOSS_TOOLS"]) / name
    with tempfile.TemporaryDirectory() as root:
        for file, text in files.items():
            path = Path(root) / file
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        done = subprocess.run([sys.executable, tool, root], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr
