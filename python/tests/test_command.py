"""`python -m roboss` and the script `roboss` of the wheel: the program of the build, in an environment of its own."""
import contextlib
import json
import re
import signal
import subprocess
import urllib.request

import pytest

import roboss
from check_install import foreign_libraries
from conftest import REPOSITORY

BUILT = REPOSITORY / "build" / "release" / "bin" / "roboss"
WORLD = roboss.example("crossroads.sdf")


@pytest.fixture(params=["module", "script"])
def command(request, clean_python):
    return [clean_python, "-P", "-m", "roboss"] if request.param == "module" else [clean_python.with_name("roboss")]


def outcome(command, *arguments, program=None):
    done = subprocess.run([*command, *arguments], executable=program, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


@pytest.mark.parametrize("arguments", [["--version"], ["--help-all"], ["run", "--no-such-option"], ["run", "no_such.sdf"],
                                       ["check", WORLD, "--json"], ["control", "--simulation", "nobody", "pause"]])
def test_says_what_the_built_program_says(command, arguments, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))  # no list of the runs of other tests
    assert outcome(command, *arguments) == outcome(["roboss"], *arguments, program=BUILT)


def test_a_run_has_the_hash_of_a_simulation(command, tmp_path):
    code, text, _ = outcome(command, "run", WORLD, "--duration", "1", "--headless", "--quiet", "--processes", "2", "--json", "-")
    sim = roboss.Simulation(WORLD)
    sim.step(500)
    assert code == 0 and json.loads(text)["state_hash"] == sim.state_hash


def test_serves_the_viewer_s_page_and_ends_by_ctrl_c(command):
    with (subprocess.Popen([*command, "run", WORLD], stderr=subprocess.PIPE, text=True) as run,
          contextlib.ExitStack() as at_the_end):
        at_the_end.callback(run.kill)  # it has no end of its own, for which a failure here would wait
        url = next(found.group() for line in run.stderr if (found := re.search(r"http://127\S+", line)))
        with urllib.request.urlopen(url) as page:
            assert "page.js" in page.read().decode()
        with urllib.request.urlopen(url + "page.js") as script:
            assert len(script.read()) > 100_000
        foreign = foreign_libraries(run.pid, inside=(str(command[0].parent.parent),))
        run.send_signal(signal.SIGINT)
        run.stderr.read()
        assert run.wait() == 130
    assert not foreign
