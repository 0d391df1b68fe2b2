"""Example scripts with wrong input: a clear text and exit code 2, no traceback."""
import os
import socket
import subprocess
import sys

import pytest

import roboss
from conftest import REPOSITORY

EXAMPLES, SOCCER, ARM = REPOSITORY / "examples", REPOSITORY / "worlds" / "soccer.sdf", roboss.example("arm.sdf")
TERRAIN, STAND_IN, SSL_TEAM = "spider/terrain.py", "devices/joints_stand_in.py", "soccer/ssl_team.py"
PROGRAM = EXAMPLES / "arm_program" / "pick_and_place.txt"


def refusal(script, *words, **environment):
    """What a script says when it ends with 2."""
    done = subprocess.run([sys.executable, EXAMPLES / script, *map(str, words)], capture_output=True, text=True, check=False,
                          timeout=60, env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1", **environment})
    assert done.returncode == 2 and "Traceback" not in done.stderr and done.stderr.strip(), done.stderr
    return done.stderr


@pytest.mark.parametrize("text", ["", "# nothing\n", "strid = 0.1", "stride 0.1", "stride = [1]", "stride = '0.1'", "phases = [0, 1]",
                                  "phases = 0.5", None])
def test_a_gait_that_is_none(tmp_path, text):
    path = tmp_path / "gait.toml"
    if text is not None:
        path.write_text(text)
    assert "gait.toml" in refusal(TERRAIN, path) and "remedy: " in refusal(TERRAIN, path)


@pytest.mark.parametrize("script, words", [
    (TERRAIN, [EXAMPLES / "spider/gaits/walk.toml", "--spiders", 0]),
    ("spider/search.py", ["--start", "no_such.toml", "-o", "a.toml"]),
    ("spider/search.py", ["--generations", 0, "-o", os.devnull]), ("spider/search.py", ["-o", "/no_such_folder/a.toml"]),
    ("older_systems/crowd.py", ["--seconds", -1]),
    (STAND_IN, ["no_such.sdf", "--camera", 0]), (STAND_IN, [SOCCER]), (STAND_IN, [SOCCER, "--robot", "blue_0:80000"]),
    (STAND_IN, [SOCCER, "--camera", 80000]), (STAND_IN, [SOCCER, "--camera", 0, "--loss", 2]),
    ("devices/khepera_stand_in.py", [REPOSITORY / "worlds/khepera.sdf", "--drop", 2]), (STAND_IN, [SOCCER, "--robot", "blue_0"]), (STAND_IN, [SOCCER, "--robot", "green_0:0"]),
    (STAND_IN, [SOCCER, "--camera", 0, "--frames", 0]), ("devices/khepera_stand_in.py", ["no_such.sdf"]),
    ("devices/khepera_stand_in.py", [SOCCER]), ("devices/khepera_stand_in.py", [REPOSITORY / "worlds/khepera.sdf", "--baud", 0]),
    ("arm_program/arm_program.py", ["no_such.urdf", PROGRAM]), ("arm_program/arm_program.py", [ARM, "no_such.txt"]),
    ("arm_program/arm_program.py", [ARM, PROGRAM, "--link", "no_such"]), ("arm_program/arm_program.py", [ARM, PROGRAM, "--ramp", 0]),
    ("arm_program/arm_program.py", [ARM, sys.executable]),
    (SSL_TEAM, ["green"]), (SSL_TEAM, ["blue", "--vision", "nonsense"]), (SSL_TEAM, ["blue", "--vision", "camera:10020"]),
    (SSL_TEAM, ["blue", "--vision", "224.5.23.2:70000"]), (SSL_TEAM, ["blue", "--vision", "192.0.2.1:10020"]),
    (SSL_TEAM, ["blue", "--simulator", "my_computer"]), (SSL_TEAM, ["blue", "--interface", "lo"]), (SSL_TEAM, ["blue", "--port", 0]),
])
def test_wrong_input(script, words):
    refusal(script, *words)


@pytest.mark.parametrize("script, package, words", [
    ("spider/search.py", "cma", ["-o", os.devnull]), ("spider/search.py", "roboss", ["-o", os.devnull]),
    ("soccer/calibrate.py", "pyarrow", []), ("arm_program/arm_program.py", "roboss", [ARM, PROGRAM]),
    ("older_systems/crowd.py", "roboss", []), ("older_systems/latency.py", "roboss", []),
    (STAND_IN, "roboss", [SOCCER, "--camera", 0]),
])
def test_a_package_is_missing(tmp_path, script, package, words):
    (tmp_path / f"{package}.py").write_text(f"raise ModuleNotFoundError(name='{package}')\n")
    path = os.pathsep.join(filter(None, [str(tmp_path), os.environ.get("PYTHONPATH")]))  # no empty one: the folder itself
    assert f"the Python package {package} is missing\n  remedy: " in refusal(script, *words, PYTHONPATH=path)


def test_a_port_that_is_taken():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.bind(("", 0))
        assert "joints_stand_in: " in refusal(STAND_IN, SOCCER, "--camera", other.getsockname()[1])


def test_protoc_is_missing(tmp_path):
    assert "remedy: install it" in refusal(SSL_TEAM, "blue", PATH=str(tmp_path))


def test_protobuf_does_not_fit_protoc(tmp_path):
    package = tmp_path / "google" / "protobuf"
    package.mkdir(parents=True)
    (tmp_path / "google" / "__init__.py").touch()
    (package / "__init__.py").touch()  # one that has nothing of what protoc's file imports
    assert "remedy: pip install" in refusal(SSL_TEAM, "blue", PYTHONPATH=str(tmp_path))
