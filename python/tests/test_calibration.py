"""Numbers of a world file, found again from recorded runs of a model in which they differ."""
import importlib.util
import json
import subprocess
import sys

import numpy as np
import pytest

import roboss
from conftest import REPOSITORY
from roboss.analysis import calibration, read, record

_SPEC = importlib.util.spec_from_file_location("soccer_calibrate", REPOSITORY / "examples/soccer/calibrate.py")
soccer = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(soccer)

SLIDE = """<sdf version="1.9"><world name="slide"><physics name="p" type="ode"><max_step_size>0.002</max_step_size></physics>
<gravity>0 0 -10</gravity>
<model name="ground"><static>true</static><link name="l"><collision name="c"><geometry><plane/></geometry>
<surface><friction><ode><mu>9</mu><mu2>9</mu2></ode></friction></surface></collision></link></model>
<model name="box"><pose>0 0 0.1 0 0 0</pose><link name="l"><inertial><mass>2</mass>
<inertia><ixx>0.0333</ixx><iyy>0.0333</iyy><izz>0.0533</izz></inertia></inertial><collision name="c">
<geometry><box><size>0.4 0.4 0.2</size></box></geometry>
<surface><friction><ode><mu>{mu}</mu><mu2>{mu}</mu2></ode></friction></surface></collision></link></model>
</world></sdf>"""
PUSH = '{"t": 0, "robot": "box", "set_velocity": {"linear": [2, 0, 0], "angular": [0, 0, 0]}}\n'
MU = ".//model[@name='box']//ode/mu,.//model[@name='box']//ode/mu2"


@pytest.fixture(scope="module")
def slide(tmp_path_factory):
    """A folder with a sliding box: slide.sdf (mu 0.3), push.jsonl, and run.parquet of a box with mu 0.4."""
    folder = tmp_path_factory.mktemp("slide")
    (folder / "slide.sdf").write_text(SLIDE.format(mu=0.3))
    (folder / "true.sdf").write_text(SLIDE.format(mu=0.4))
    (folder / "push.jsonl").write_text(PUSH)
    command(folder, "record", "true.sdf", "box.*", "--until", "0.8", "--orders", "push.jsonl", "-o", "run.parquet")
    return folder


def command(folder, *words, code=0):
    done = subprocess.run([sys.executable, "-m", "roboss", *words], cwd=folder, capture_output=True, text=True, timeout=120)
    assert done.returncode == code, done.stderr
    return done.stdout if code == 0 else done.stderr


def test_torque_and_friction_of_a_soccer_robot_are_found(tmp_path):
    found = soccer.calibrated(tmp_path)
    true = np.array([soccer.TRUE[name] for name in found.names])
    assert found.converged
    assert np.abs(found.values / true - 1).max() < 0.02            # what the issue of the example asks for
    assert (np.abs(found.values - true) < 2 * (found.high - found.low) / 2).all()
    assert found.rms["m"] == pytest.approx(soccer.NOISE["m"], rel=0.15)   # what is left is the camera's noise
    assert found.rms["rad"] == pytest.approx(soccer.NOISE["rad"], rel=0.15)
    assert found.rms_before["m"] > 10 * found.rms["m"]


def test_the_interval_is_that_of_the_noise(slide):
    """x = v t - mu g t^2 / 2 until the box stops after v / (mu g): linear regression says how well mu can be known."""
    clean, noise = read(slide / "run.parquet"), 0.005
    time, shape = clean.time[::4], clean.values[::4].shape
    noisy = roboss.analysis.Recording(time, clean.columns, clean.values[::4] + np.random.default_rng(2).normal(0, noise, shape))
    found = calibration.calibrate(slide / "slide.sdf", [calibration.Parameter("mu", tuple(MU.split(",")))],
                                  [calibration.TestRun(noisy, str(slide / "push.jsonl"))], compare="box.x")
    slope = -10 * np.minimum(time, 2 / (0.4 * 10))**2 / 2          # dx / dmu
    assert (found.high - found.low)[0] / 2 == pytest.approx(1.99 * noise / np.linalg.norm(slope), rel=0.15)
    assert found.low[0] < 0.4 < found.high[0]


def test_the_command_writes_the_world_and_tells_the_numbers(slide):
    words = ["calibrate", "slide.sdf", "--run", "run.parquet=push.jsonl", "--parameter", f"mu={MU}@0.1..1", "-o", "found.sdf"]
    told = json.loads(command(slide, *words, "--json"))
    assert told["parameters"][0]["value"] == pytest.approx(0.4, rel=1e-4)
    assert told["converged"] and told["rms"]["m"] < 1e-5 < told["rms_before"]["m"]
    again = record(roboss.load(slide / "found.sdf"), "box.z", until=0.01)   # the file loads
    assert again["box.z"][-1] == pytest.approx(0.1, abs=1e-4)
    assert command(slide, *words).splitlines()[1].split()[:2] == ["mu", "0.3"]
    assert sorted(path.name for path in slide.iterdir()) == ["found.sdf", "push.jsonl", "run.parquet", "slide.sdf", "true.sdf"]


@pytest.mark.parametrize("parameter, code", [
    ("mu=.//model[@name='bowl']//mu", "no-number"), ("mu=.//model[@name='box']", "no-number"), ("mu", "bad-value"),
    ("mu=.//model[@name='box'", "bad-path"), (f"mu={MU}@0.5..1", "bad-bounds"), (f"mu={MU}@a..1", "bad-value"),
    ("dt=.//physics/no_such_number", "no-number"), ("far=.//model[@name='ground']//mu", "no-influence")])
def test_parameters_that_cannot_be_are_refused(slide, parameter, code):
    error = command(slide, "calibrate", "slide.sdf", "--run", "run.parquet=push.jsonl", "--parameter", parameter, "--quiet", code=1)
    assert f"[{code}]" in error and "remedy: " in error
    assert "Traceback" not in error


def test_recordings_of_other_worlds_are_refused(slide):
    for recorded, code in (("no.parquet", "no-recording"), ("slide.sdf", "bad-value")):
        error = command(slide, "calibrate", "slide.sdf", "--run", recorded, "--parameter", f"mu={MU}", code=1)
        assert f"[{code}]" in error
    error = command(slide, "calibrate", "slide.sdf", "--run", "run.parquet=push.jsonl", "--parameter", f"mu={MU}",
                    "--compare", "ball.*", code=1)
    assert "[nothing-to-compare]" in error
