"""`roboss record`, `plot` and `analyse`: variables of runs, their files, reports."""
import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import roboss
from conftest import REPOSITORY, analysis_command
from roboss import analysis

CROSSROADS, ARM = roboss.example("crossroads.sdf"), roboss.example("arm.sdf")
ORDERS = REPOSITORY / "worlds" / "crossroads.jsonl"
PATTERNS = ["car_[03].pose", "car_0.speed", "car_0.front_left.*", "car_3.compass.heading", "car_3.energy", "car_?.contacts"]


def command(*arguments, code=0):
    """What a command printed to standard output; it ended with this exit code."""
    ended, output, errors = analysis_command(*map(str, arguments))
    assert ended == code, errors
    return output if code == 0 else errors


@pytest.fixture(scope="module")
def journal(tmp_path_factory):
    """A journal of a second of cars under orders."""
    from roboss.analysis.recorder import journal_of_run
    return journal_of_run(CROSSROADS, 1.0, tmp_path_factory.mktemp("journal"), orders=str(ORDERS))


def test_a_recording_has_the_arrays_of_the_simulation():
    recording = analysis.record(CROSSROADS, PATTERNS, until=0.1, every=0.02)
    sim = roboss.Simulation(CROSSROADS)
    sim.step(50)
    cars = sim.robots(["car_0", "car_3"])
    assert recording.time == pytest.approx(np.linspace(0, 0.1, 6))
    assert recording["car_3.pose"][-1].tolist() == cars.pose[1].tolist()
    assert recording["car_0.speed"][-1] == np.linalg.norm(cars.twist[0, :3])
    assert recording["car_3.energy.potential"][-1] == cars.energy[1, 1]
    assert recording["car_3.compass.heading"][-1] == cars[1:]["compass"].read_all()["heading"][0]
    assert recording["car_0.contacts"][-1] == np.sum((sim.contacts["robot_a"] == 0) | (sim.contacts["robot_b"] == 0)) > 0
    assert recording.facts["mass_kg"]["car_0"] == pytest.approx(6.2)


def test_robots_that_cannot_move_are_recorded():
    recording = analysis.record(roboss.example("conveyor.sdf"), "*.pose", until=0)
    assert "cross.pose" in recording and "cross" not in recording.facts["mass_kg"]


def test_efforts_are_those_of_the_motors():
    sim = roboss.Simulation(ARM)
    sim.robots("arm").set_joint_targets([1.5, 2, 3, 0.1, 0.2, 0.3], mode="effort")
    recording = analysis.record(sim, "arm.*.effort", until=0.01, every=0.001)
    assert recording.values[0] == pytest.approx(np.zeros(6)) and recording.values[-1] == pytest.approx([1.5, 2, 3, 0.1, 0.2, 0.3])
    assert {column.unit for column in recording.columns} == {"N m"}


def test_a_journal_gives_afterwards_what_the_run_gave(journal, tmp_path):
    live = roboss.Journal(journal).at(0)
    first = analysis.record(live, PATTERNS, until=1.0)
    again = analysis.record(journal, PATTERNS)
    assert again.values.tobytes() == first.values.tobytes() and again.columns == first.columns
    assert np.ptp(again["car_0.speed"]) > 0.1  # it drove
    command("record", CROSSROADS, *PATTERNS, "--orders", ORDERS, "--until", "1", "-o", tmp_path / "run.parquet", "--quiet")
    assert analysis.read(tmp_path / "run.parquet").values.tobytes() == first.values.tobytes()


def test_a_free_run_is_recorded_as_its_journal(tmp_path):
    from roboss.analysis.recorder import journal_of_run
    path = journal_of_run(CROSSROADS, 0.3, tmp_path)
    assert analysis.record(path, PATTERNS).values.tobytes() == analysis.record(CROSSROADS, PATTERNS, until=0.3).values.tobytes()


@pytest.mark.parametrize("suffix", [".parquet", ".mcap"])
def test_files_give_back_every_bit_with_units_and_frames(tmp_path, suffix):
    recording = analysis.record(CROSSROADS, [*PATTERNS, "car_1.laser.ranges"], until=0.1)
    analysis.write(recording, tmp_path / f"run{suffix}")
    again = analysis.read(tmp_path / f"run{suffix}")
    finite = np.where(np.isfinite(recording.values), recording.values, np.nan) if suffix == ".mcap" else recording.values
    assert again.columns == recording.columns and again.facts == recording.facts
    assert np.array_equal(again.values, finite, equal_nan=True)
    assert again.time == pytest.approx(recording.time, abs=1e-9)
    assert {column.unit for column in again.columns if column.variable == "car_3.pose"} == {"m", ""}


def test_mcap_has_schemas_that_viewers_know(tmp_path):
    from mcap.reader import make_reader
    analysis.write(analysis.record(CROSSROADS, ["car_3.pose", "car_3.speed"], until=0.1), tmp_path / "run.mcap")
    with open(tmp_path / "run.mcap", "rb") as stream:
        messages = {channel.topic: (schema, json.loads(message.data))
                    for schema, channel, message in make_reader(stream).iter_messages()}
    schema, pose = messages["/car_3/pose"]
    assert (schema.name, schema.encoding) == ("foxglove.PoseInFrame", "jsonschema")
    assert pose["frame_id"] == "world" and pose["timestamp"] == {"sec": 0, "nsec": 100_000_000}
    assert set(pose["pose"]["orientation"]) == set("xyzw")
    assert list(messages["/car_3/speed"][1]) == ["value"]


def test_the_list_has_all_variables_with_their_units():
    rows = {row["variable"]: row for row in json.loads(command("record", ARM, "--list", "--json"))}
    assert rows["arm.elbow.power"]["units"] == ["W"] and rows["arm.tool.pose"]["frame"] == "world"
    assert rows["arm.tool.twist"]["parts"] == ["vx", "vy", "vz", "wx", "wy", "wz"]


def test_an_example_is_recorded_with_its_orders(journal, tmp_path):
    command("record", "example:crossroads", "car_*.speed", "--until", 1, "-o", tmp_path / "example.parquet")
    ran, ordered = analysis.read(tmp_path / "example.parquet"), analysis.record(journal, "car_*.speed")
    assert ran["car_0.speed"].max() > 0.1 and np.array_equal(ran["car_0.speed"], ordered["car_0.speed"])
    assert "arm.elbow.power" in command("record", "example:arm", "--list")


@pytest.mark.parametrize("arguments, code, name", [
    (["record", "example:crosroads", "--until", "1", "-o", "a.parquet"], 1, "did you mean 'crossroads'?"),
    (["record", "example:crossroads", "-o", "a.parquet"], 1, "no-end"),
    (["record", "no_such.sdf", "*", "--until", "1", "-o", "a.parquet"], 1, "no-file"),
    (["record", ARM, "arm.elbo.effort", "--until", "1", "-o", "a.parquet"], 1, "unknown-name"),
    (["record", ARM, "*", "-o", "a.parquet"], 1, "no-end"),
    (["record", ARM, "*", "--until", "1", "-o", "a.xlsx"], 1, "unknown-format"),
    (["record", ARM, "contact_points", "--until", "1", "-o", "a.csv"], 1, "no-numbers"),
    (["record", ARM, "--unti", "1"], 2, "wrong-usage"),
    (["analyse", "arm", CROSSROADS, "--robot", "car_0"], 1, "free-base"),
    (["analyse", "legs", ARM], 2, "wrong-usage"),
    (["plot", ORDERS, "x"], 1, ""),
    (["plot", "nofile.md", "x"], 1, "no-file"),
    (["record", "no_such.journal", "*", "-o", "a.parquet"], 1, "no-file"),
    (["analyse", "walker", "no_such.parquet"], 1, "no-file"),
    (["record", ARM, "*", "--until", "1", "-o", "nodir/a.parquet"], 1, "no-file"),
    (["plot", ARM, "arm.x", "--until", "1", "-o", "nodir/a.png"], 1, "no-file"),
    (["record", ARM, "*", "--until", "-1", "-o", "a.parquet"], 1, "no-such-time"),
    (["record", ARM, "*", "--from", "3", "--until", "1", "-o", "a.parquet"], 1, "bad-value"),
    (["plot", ARM, "arm.x", "--until", "-2"], 1, "no-such-time"),
    (["analyse", "arm", ARM, "--robot", "arm", "--link", "tol"], 1, "did you mean 'tool'?"),
    (["analyse", "vehicle", CROSSROADS, "--robot", "car"], 1, "did you mean 'car_"),
    (["analyse", "vehicle", CROSSROADS, "--left", "front_lef"], 1, "unknown-name"),
])
def test_errors_have_codes_and_exit_codes(arguments, code, name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert name in command(*arguments, code=code)
    assert not list(tmp_path.iterdir())


def test_times_that_a_source_does_not_have_are_refused(journal, tmp_path):
    path = tmp_path / "run.parquet"
    analysis.write(analysis.record(CROSSROADS, "car_0.**", until=0.1), path)
    for source, start, until, code in [(path, 3, None, "no-such-time"), (path, None, -1, "no-such-time"), (path, 0.1, 0, "bad-value"),
                                       (journal, 0.6, 0.5, "bad-value"), (journal, None, 7, "no-such-time"),
                                       (CROSSROADS, -1, 0.1, "no-such-time"), (CROSSROADS, 0, float("inf"), "no-such-time")]:
        with pytest.raises(roboss.RobossError) as caught:
            analysis.record(source, "car_0.speed", start=start, until=until)
        assert caught.value.code == code and caught.value.remedy
    assert "bad-value" in command("analyse", "walker", path, "--mass", -3, code=1)
    assert "ends at 0.1 s" in command("analyse", "walker", path, "--robot", "car_0", "--from", 3, code=1)


def test_a_damaged_file_is_refused(tmp_path):
    for suffix in (".parquet", ".mcap"):
        (tmp_path / f"bad{suffix}").write_bytes(b"PAR1 or not")
        with pytest.raises(roboss.RobossError) as caught:
            analysis.read(tmp_path / f"bad{suffix}")
        assert caught.value.code == "no-recording"


@pytest.mark.parametrize("suffix", ["png", "svg"])
def test_plots_are_pictures(tmp_path, suffix):
    picture = tmp_path / f"plot.{suffix}"
    result = json.loads(command("plot", CROSSROADS, "car_3.twist", "car_3.x", "--until", "0.1", "-o", picture, "--json"))
    assert result["samples"] == 11 and any(row["unit"] == "rad/s" for row in result["columns"])
    data = picture.read_bytes()
    assert data.startswith(b"\x89PNG") if suffix == "png" else b"</svg>" in data
    command("plot", CROSSROADS, "car_[0-3].y", "--against", "car_0.x", "--until", "0.1", "-o", picture)


def test_an_arm_is_tested_and_its_recording_gives_the_same_figures(tmp_path):
    options = ["--robot", "arm", "--link", "tool", "--cycles", "2", "--speeds", "1", "--loads", "0.1", "1", "--quiet", "--json"]
    page, kept = tmp_path / "arm.html", tmp_path / "arm.parquet"
    tested = json.loads(command("analyse", "arm", ARM, *options, "-o", page, "--keep", kept))["tables"]
    worst = tested["Worst values of each condition"]
    assert [row["Condition"] for row in worst] == ["0.2 kg, 100 % of speed", "2 kg, 100 % of speed"]
    assert all(0 < row["RP [mm]"] < 0.1 and 0 < row["AP [mm]"] < 0.5 for row in worst)
    assert worst[1]["AT [mm]"] > worst[0]["AT [mm]"]  # the load is not known to the servo
    stiff = tested["Static compliance at P1 with the rated load"]
    assert all(row["Compliance [mm/N]"] > 0 for row in stiff)
    again = json.loads(command("analyse", "arm", kept, "-o", tmp_path / "again.html", "--json"))["tables"]
    for one, other in zip(again["Worst values of each condition"], worst):
        assert {**one, "Condition": 0} == pytest.approx({**other, "Condition": 0})
    text = page.read_text()
    assert text.count("<svg") == 6 and "http-equiv" not in text and 'src="' not in text  # nothing is fetched


def test_an_arm_of_four_axes_keeps_the_orientation_that_it_can():
    from roboss.analysis.arm_driver import ArmDriver, ArmTest
    driver = ArmDriver(ArmTest(roboss.example("arm_cell.sdf"), "arm_0", "hand", payload=0.5, cycles=2, loads=(1.0,), speeds=(1.0,)))
    assert not driver.cube.turns and driver.cube.poses[:, 3:].tolist() == [[0, 0, 0, 1]] * 5
    (_, recording), = driver.recordings()
    condition = analysis.analyse_arm(recording.time, recording["arm_0.hand.pose"], recording["arm_0.hand.command"])
    assert all(0 < pose.score.repeatability < 1e-4 and pose.score.accuracy < 1e-3 for pose in condition.poses)


def test_the_orientation_is_free_where_an_arm_of_few_axes_cannot_keep_it(tmp_path):
    from roboss.analysis.arm_driver import ArmDriver, ArmTest
    text = Path(ARM).read_text()
    for joint in ("roll", "bend", "flange"):
        text = re.sub(rf'(<joint name="{joint}" type=)"revolute"(.*?)<axis>.*?</axis>', r'\1"fixed"\2', text, flags=re.DOTALL)
    (tmp_path / "three.sdf").write_text(text)
    cube = ArmDriver(ArmTest(tmp_path / "three.sdf", "arm", "tool")).cube
    assert cube.turns and cube.q.shape == (5, 3)
    assert len(np.unique(cube.poses[:, 3:].round(6), axis=0)) == 5
    with pytest.raises(roboss.ArgumentError):
        ArmDriver(ArmTest(tmp_path / "three.sdf", "arm", "tool", orientation=(0, 1, 0, 0)))


def test_without_errors_of_encoders_an_arm_repeats(tmp_path):
    from roboss.analysis.arm_driver import ArmDriver, ArmTest
    test = ArmTest(ARM, "arm", "tool", cycles=3, loads=(0.0,), speeds=(0.5,), encoder_noise=0.0, encoder_bits=40)
    (_, recording), = ArmDriver(test).recordings()
    condition = analysis.analyse_arm(recording.time, recording["arm.tool.pose"], recording["arm.tool.command"])
    assert len(condition.poses) == 5
    for pose in condition.poses:
        assert pose.score.repeatability < 1e-6 and pose.score.accuracy < 1e-5


def test_a_car_drives_its_test(tmp_path):
    tables = json.loads(command("analyse", "vehicle", CROSSROADS, "--runs", "1", "--side", "2", "--quiet", "--json",
                                "-o", tmp_path / "car.html"))["tables"]
    circle, = tables["Steady circle"]
    assert circle["Radius [m]"] == pytest.approx(2, rel=0.05) and circle["Speed [m/s]"] == pytest.approx(0.5, rel=0.05)
    stop, = tables["Stop on a straight line"]
    assert stop["Mean deceleration [m/s²]"] == pytest.approx(7.5, abs=1.5)  # friction 0.9 at most
    weave, = tables["Weave (slalom)"]
    assert weave["Yaw rate gain"] == pytest.approx(1, abs=0.1) and 0 < weave["Lag [s]"] < 0.05
    squares, = tables["UMBmark"]
    assert squares["E_d"] == pytest.approx(1, abs=0.01)  # its wheels are equal


def test_a_walker_s_demand_is_that_of_its_motors(tmp_path):
    world = roboss.WorldBuilder()
    slider = world.model("slider", pose=[0, 0, 1])
    slider.box("trunk", [0.2, 0.2, 0.2], mass=2).box("arm", [0.1, 0.1, 0.1], mass=1)
    slider.joint("lift", "prismatic", "trunk", "arm", axis=[1, 0, 0])
    built = world.build()
    sim = roboss.Simulation(built)
    sim.robots("slider").set_joint_targets(3.0, mode="effort")
    analysis.write(analysis.record(sim, "slider.**", until=0.2, every=sim.dt), tmp_path / "run.parquet")
    result = json.loads(command("analyse", "walker", tmp_path / "run.parquet", "--from", 0.05, "-o", tmp_path / "walker.html", "--json"))
    joint, = result["tables"]["Demand of each joint"]
    assert joint["Joint"] == "lift" and joint["rms [N]"] == pytest.approx(3) and joint["peak [N]"] == pytest.approx(3)
    assert joint["peak speed [m/s]"] == pytest.approx(0.2 * 3 * (1 + 1 / 2), rel=0.01)


def as_csv(recording, path, order=1):
    """The numbers as a table of another program, in this order of columns."""
    names = [column.name for column in recording.columns][::order]
    rows = [",".join(map(repr, [float(time), *values.tolist()])) for time, values in zip(recording.time, recording.values[:, ::order])]
    path.write_text("\n".join([",".join(["time", *names]), *rows]) + "\n")


def test_an_arm_is_analysed_from_a_table(tmp_path):
    line = np.linspace(0, 0.4, 41)[:, None] * [1.0, 0.5, 0]
    one = np.vstack([np.tile(line[0], (30, 1)), line, np.tile(line[-1], (30, 1)), line[::-1]])
    commanded = np.hstack([np.tile(one, (3, 1)), np.tile([0, 1.0, 0, 0], (3 * len(one), 1))])
    measured = commanded + [0, 0, 0.001, 0, 0, 0, 0]
    columns = [analysis.Column(f"arm.tool.{what}.{part}", f"arm.tool.{what}") for what in ("pose", "command")
               for part in ("x", "y", "z", "qx", "qy", "qz", "qw")]
    recording = analysis.Recording(np.arange(len(commanded)) * 0.01, columns, np.hstack([measured, commanded]))
    as_csv(recording, tmp_path / "arm.csv", order=-1)
    again = analysis.read(tmp_path / "arm.csv")
    assert set(again.variables) == {"arm.tool.pose", "arm.tool.command"} and (again["arm.tool.pose"] == measured).all()
    assert {column.name: column.unit for column in again.columns}["arm.tool.pose.x"] == "m"
    tables = json.loads(command("analyse", "arm", tmp_path / "arm.csv", "-o", tmp_path / "arm.html", "--json"))["tables"]
    rows = tables["Pose accuracy (AP) and repeatability (RP)"]
    assert len(rows) == 2 and all(row["AP [mm]"] == pytest.approx(1) for row in rows)
    recording.values[7, 2] = np.nan
    as_csv(recording, tmp_path / "gaps.csv")
    assert "has-gaps" in command("analyse", "arm", tmp_path / "gaps.csv", "-o", tmp_path / "gaps.html", code=1)


def test_a_walker_is_analysed_from_a_table(tmp_path):
    time = np.arange(101) * 0.01
    columns = [analysis.Column(f"bug.{name}", f"bug.{name}") for name in ("pose.x", "pose.y", "hip.effort", "hip.velocity")]
    values = np.column_stack([time, 0 * time, 0 * time + 3, 0 * time + 2])
    as_csv(analysis.Recording(time, columns, values), tmp_path / "bug.csv")
    tables = json.loads(command("analyse", "walker", tmp_path / "bug.csv", "--mass", 2, "-o", tmp_path / "bug.html", "--json"))["tables"]
    joint, = tables["Demand of each joint"]
    assert joint["Joint"] == "hip" and joint["rms [N m or N]"] == pytest.approx(3)
    cost, = tables["Mechanical cost of transport"]
    assert cost["Cost"] == pytest.approx(3 * 2 / (2 * 9.81))


def test_a_table_that_is_recorded_reads_back_with_the_same_bits_units_and_facts(tmp_path):
    patterns = ["car_3.pose", "car_3.laser.ranges", "car_*.speed"]
    for name in ("run.csv", "run.parquet"):
        command("record", CROSSROADS, *patterns, "--until", 0.1, "-o", tmp_path / name)
    table, other = analysis.read(tmp_path / "run.csv"), analysis.read(tmp_path / "run.parquet")
    assert table.columns == other.columns and table.facts == other.facts
    assert np.array_equal(table.time, other.time) and np.array_equal(table.values, other.values, equal_nan=True)


def test_a_vehicle_whose_controller_takes_velocities_is_driven_by_them(tmp_path):
    from roboss.analysis.vehicle_driver import VehicleDriver, VehicleTest
    driver = VehicleDriver(VehicleTest(roboss.example("drives.sdf"), "rover", runs=1, side=1.0))
    assert driver.command == "cmd_vel" and driver.wheel_radius == pytest.approx(0.12, rel=0.01)
    _, circle = driver.circle()
    assert circle.radius == pytest.approx(2, rel=0.03) and circle.speed == pytest.approx(0.5, rel=0.02)
