"""Numbers of a world file, found again from recorded runs of a model in which they differ."""
import importlib.util
import json
import subprocess
import sys

import numpy as np
import pytest

import roboss
from conftest import REPOSITORY, analysis_command
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
    if words[0] == "run":
        done = subprocess.run([sys.executable, "-m", "roboss", *words], cwd=folder, capture_output=True, text=True, timeout=120)
        ended, output, errors = done.returncode, done.stdout, done.stderr
    else:
        ended, output, errors = analysis_command(*words, folder=folder)
    assert ended == code, errors
    return output if code == 0 else errors


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
    assert not list(slide.glob(".calibrate*"))


@pytest.mark.parametrize("parameter, code", [
    ("mu=.//model[@name='bowl']//mu", "no-number"), ("mu=.//model[@name='box']", "no-number"), ("mu", "bad-value"),
    ("mu=.//model[@name='box'", "bad-path"), ("mu=.//mu[", "bad-path"), (f"mu={MU}@0.5..1", "bad-bounds"), (f"mu={MU}@a..1", "bad-value"),
    ("dt=.//physics/no_such_number", "no-number"), ("far=.//model[@name='ground']//mu", "no-influence"),
    ("mu=.//mu", "different-numbers")])
def test_parameters_that_cannot_be_are_refused(slide, parameter, code):
    refused(slide, code, "--run", "run.parquet=push.jsonl", "--parameter", parameter)


def refused(folder, code, *words, world="slide.sdf"):
    error = command(folder, "calibrate", world, *words, "--quiet", code=1)
    assert f"[{code}]" in error and "remedy: " in error
    assert "Traceback" not in error
    return error


def test_inputs_that_are_not_there_are_refused_before_anything_is_simulated(slide):
    parameter = ("--parameter", f"mu={MU}")
    refused(slide, "no-file", "--run", "no.parquet", *parameter)
    refused(slide, "no-file", "--run", "run.parquet=no.jsonl", *parameter)
    refused(slide, "no-file", "--run", "run.parquet=push.jsonl", *parameter, world="no.sdf")
    refused(slide, "no-file", "--run", "run.parquet=push.jsonl", *parameter, "-o", "no/found.sdf")
    refused(slide, "no-file", "--run", "run.parquet=push.jsonl", *parameter, "--client", "no.so")
    refused(slide, "bad-value", "--run", "slide.sdf", *parameter)
    assert "box.x" in refused(slide, "nothing-to-compare", "--run", "run.parquet=push.jsonl", *parameter, "--compare", "ball.*")


def changed(slide, change):
    """A calibration of mu with a recording that was changed; change(time, x) gives new ones."""
    clean = read(slide / "run.parquet")
    time, x = change(clean.time[::8].copy(), clean["box.x"][::8].copy())
    recording = roboss.analysis.Recording(time, [roboss.analysis.Column("box.x", "box.x", "m")], x[:, None])
    return calibration.calibrate(slide / "slide.sdf", [calibration.Parameter("mu", tuple(MU.split(",")))],
                                 [calibration.TestRun(recording, str(slide / "push.jsonl"))])


def test_gaps_of_a_tracker_are_left_out(slide):
    found = changed(slide, lambda time, x: (time, np.where(np.arange(len(x)) % 3 == 1, np.nan, x)))
    assert found.values[0] == pytest.approx(0.4, rel=1e-3)


@pytest.mark.parametrize("change", [lambda time, x: (time + 1.7e9, x), lambda time, x: (time[::-1], x),
                                    lambda time, x: (time - 1, x), lambda time, x: (time[:1], x[:1])])
def test_times_that_are_not_those_of_a_run_are_refused(slide, change):
    with pytest.raises(roboss.ArgumentError, match="times of 'recording'") as error:
        changed(slide, change)
    assert error.value.code == "bad-times"


def as_csv(slide, name, *, shift=(0, 0), late=0.0, delimiter=",", cell=lambda x: f"{x:.6f}"):
    """The recorded slide as a tracker would have written it: moved in x and y, its clock late by some seconds."""
    clean = read(slide / "run.parquet")
    lines = ["# a tracker", delimiter.join(["time", "box.x", "box.y", "box.yaw"])]
    for time, x, y, turn in list(zip(clean.time, clean["box.x"], clean["box.y"], clean["box.yaw"]))[::4]:
        lines.append(delimiter.join([f"{time + late:.6f}", cell(x + shift[0]), f"{y + shift[1]:.6f}", f"{turn:.6f}"]))
    (slide / name).write_text("\n".join(lines) + "\n")


def test_start_pose_and_time_are_found_from_a_table_of_a_tracker(slide):
    as_csv(slide, "moved.csv", shift=(0.12, -0.05), late=0.031, delimiter=";")
    words = ["calibrate", "slide.sdf", "--run", "moved.csv=push.jsonl", "--parameter", f"mu={MU}@0.1..1", "--json"]
    told = {row["name"]: row for row in json.loads(command(slide, *words, "--fit-start", "box", "--fit-time", "0.2"))["parameters"]}
    assert told["mu"]["value"] == pytest.approx(0.4, rel=2e-3)
    for name, value in (("time", 0.031), ("box x", 0.12), ("box y", -0.05), ("box yaw", 0)):
        found = told[f"{name} of moved.csv"]
        assert found["value"] == pytest.approx(value, abs=1e-3) and found["start"] == 0 and not found["at_bound"]
    blind = json.loads(command(slide, *words))["parameters"][0]
    assert abs(blind["value"] - 0.4) > 0.02  # without them mu is wrong


def test_an_offset_may_be_any_number_of_its_range(slide):
    as_csv(slide, "left.csv", shift=(-0.1, -0.1))
    words = ["calibrate", "slide.sdf", "--run", "left.csv=push.jsonl", "--parameter", f"mu={MU}@0.1..1", "--fit-start", "box"]
    told = {row["name"]: row for row in json.loads(command(slide, *words, "--json"))["parameters"]}
    assert told["box x of left.csv"]["value"] == pytest.approx(-0.1, abs=1e-4)
    assert told["box y of left.csv"]["value"] == pytest.approx(-0.1, abs=1e-4)
    assert told["mu"]["value"] == pytest.approx(0.4, rel=2e-3)


def test_a_table_that_is_wrong_names_its_line(slide):
    parameter = ("--parameter", f"mu={MU}")
    as_csv(slide, "words.csv", cell=lambda x: "1,2" if x > 0.5 else "?" if x > 0.4 else "")
    assert "words.csv:" in refused(slide, "bad-table", "--run", "words.csv=push.jsonl", *parameter)
    (slide / "short.csv").write_text("time,box.x\n0,0\n0.1\n")
    assert "short.csv:3" in refused(slide, "bad-table", "--run", "short.csv=push.jsonl", *parameter)
    (slide / "timeless.csv").write_text("t,box.x\n0,0\n")
    assert "timeless.csv:1" in refused(slide, "bad-table", "--run", "timeless.csv=push.jsonl", *parameter)
    as_csv(slide, "good.csv")
    refused(slide, "no-free-robot", "--run", "good.csv=push.jsonl", *parameter, "--fit-start", "bowl")
    refused(slide, "bad-value", "--run", "good.csv=push.jsonl", *parameter, "--fit-time", "0")


def test_a_value_at_its_bound_has_no_interval(slide):
    words = ["calibrate", "slide.sdf", "--run", "run.parquet=push.jsonl", "--parameter", f"mu={MU}@0.2..0.35", "--quiet"]
    told = json.loads(command(slide, *words, "--json"))["parameters"][0]
    assert told["at_bound"] and told["low"] is None and told["value"] == pytest.approx(0.35, rel=1e-3)
    assert "at its bound" in command(slide, *words)


CART = """<?xml version="1.0"?>
<!-- A cart on a rail. -->
<robot name="cart"><!-- of steel -->
<link name="rail"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="car"><inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="slide" type="prismatic"><parent link="rail"/><child link="car"/><axis xyz="1 0 0"/>
<limit lower="-100" upper="100" effort="{effort}" velocity="100"/></joint></robot>
"""


@pytest.fixture(scope="module")
def cart(tmp_path_factory):
    """A folder with file.urdf, a cart with a motor of 2 N, and run.parquet of one of 3 N, driven by go.jsonl."""
    folder = tmp_path_factory.mktemp("cart")
    for name, effort in (("true", 3.0), ("file", 2.0)):
        (folder / f"{name}.urdf").write_text(CART.format(effort=effort))
    (folder / "go.jsonl").write_text('{"t": 0, "robot": "cart", "joint": {"name": "slide", "velocity": 50}}\n')
    command(folder, "run", "true.urdf", "--fixed-base", "cart", "--orders", "go.jsonl", "--duration", "0.5", "--headless",
            "--journal", "true.journal")
    command(folder, "record", "true.journal", "cart.slide.position", "-o", "run.parquet")
    return folder


EFFORT = ("--fixed-base", "cart", "--run", "run.parquet=go.jsonl", "--parameter", "effort=.//limit/@effort")


def test_a_urdf_is_run_with_its_options_and_keeps_its_comments(cart):
    told = json.loads(command(cart, "calibrate", "file.urdf", *EFFORT, "-o", "found.urdf", "--json"))
    assert told["parameters"][0]["value"] == pytest.approx(3.0, rel=1e-5)
    assert told["compared"] == ["cart.slide.position"]
    assert "<!-- of steel -->" in (cart / "found.urdf").read_text()


def test_parameters_that_cannot_be_told_apart_are_refused(cart):
    """The acceleration is effort / mass."""
    error = refused(cart, "same-influence", *EFFORT, "--parameter", "mass=.//link[@name='car']/inertial/mass/@value", world="file.urdf")
    assert "effort" in error and "mass" in error
