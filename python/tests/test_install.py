"""The wheel in a clean environment, without the libraries of the system."""
import subprocess
from pathlib import Path

import roboss


def test_a_clean_environment_needs_nothing_else(clean_python, tmp_path):
    script = Path(__file__).with_name("check_install.py")
    done = subprocess.run([clean_python, "-I", script], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    sim = roboss.Simulation(roboss.example("city.sdf"), threads=1)
    sim.step(1000)
    assert done.stdout.split() == [sim.state_hash]


def test_has_types_and_licences(clean_python):
    package = Path(subprocess.run([clean_python, "-I", "-c", "import roboss; print(roboss.__path__[0])"],
                                  capture_output=True, text=True, check=True).stdout.strip())
    assert (package / "py.typed").exists() and "class Simulation" in (package / "_core.pyi").read_text()
    licences = {path.name for path in (package / "licences").iterdir()}
    assert {"roboss.txt", "libpugixml1v5.txt", "libcli11-dev.txt", "nanobind.txt"} <= licences


def test_environments_without_their_extra_say_what_is_missing(clean_python):
    script = "try:\n import roboss.envs\nexcept ImportError as error:\n print(error.name, str(error).count('roboss[envs]'))"
    done = subprocess.run([clean_python, "-I", "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["gymnasium", "1"]
