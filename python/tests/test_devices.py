"""`roboss device`: control programs of the simulation, unchanged, drive stand-ins for hardware (examples/devices)."""
import contextlib
import csv
import json
import math
import os
import re
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

from conftest import REPOSITORY

BUILD = Path(os.environ.get("ROBOSS_BUILD", REPOSITORY / "build" / "release"))
WORLDS, STAND_INS = REPOSITORY / "worlds", REPOSITORY / "examples" / "devices"
ROBOSS = BUILD / "bin" / "roboss"


@contextlib.contextmanager
def running(*command):
    """A process with its output as text; it is gone when the block ends."""
    process = subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               env={**os.environ, "ROBOSS_SOCCER_HALF": "300"})
    try:
        yield process
    finally:
        if not process.stdout.closed:
            process.kill()
            process.communicate()


@contextlib.contextmanager
def stand_in(name, world, *options):
    """A stand-in, and what it says of itself first: its terminal or its ports."""
    with running(sys.executable, STAND_INS / f"{name}_stand_in.py", WORLDS / world, *options) as process:
        yield process, json.loads(process.stdout.readline())


def summary(process):
    """Ends a stand-in; what happened to it."""
    process.send_signal(signal.SIGTERM)
    return json.loads(process.communicate(timeout=20)[0].splitlines()[-1])


def device(tmp_path, client, *options):
    """The command, which writes its summary to tmp_path."""
    return [ROBOSS, "device", "--client", BUILD / "lib" / f"{client}.so", "--json", tmp_path / "device.json", *options]


def drive(tmp_path, client, *options):
    """Runs `roboss device` to its end; its summary."""
    patient = ["--give-up", 30]                                 # on a busy computer a stand-in may stall
    with running(*device(tmp_path, client, *options, *patient)) as process:
        said = process.communicate(timeout=90)[1]
        assert process.returncode == 0, said
    return json.loads((tmp_path / "device.json").read_text())


def await_driving(process):
    """Reads what the command says until the program drives; then lets it drive for a moment."""
    for line in process.stderr:
        if "[driving]" in line:
            time.sleep(0.5)
            return
    raise AssertionError("it never drove")


KHEPERA = ["--robot", "khepera", "--protocol", "khepera", "--connect"]


def test_the_khepera_avoids_walls_on_a_bad_line_and_after_a_reboot(tmp_path):
    line = ["--drop", 0.002, "--drift", 0.03, "--reboot-at", 3.5]
    with stand_in("khepera", "khepera.sdf", *line) as (robot, at):
        done = drive(tmp_path, "roboss_khepera", WORLDS / "khepera.sdf", *KHEPERA, f"serial:{at['serial']},38400",
                     "--duration", 8)
        found = summary(robot)
    assert found["touches"] == 0 and found["distance_m"] > 0.25
    assert max(map(abs, found["joint_velocity"])) < 0.1         # it stopped
    assert found["reboots"] == 1 and found["characters_lost"] > 0
    assert done["calls"] > 100 and done["failure"] is None
    port = done["devices"][0]
    assert port["reboots"] == 1 and port["damaged"] + port["lost"] > 0 and port["taken"] > 200


def test_a_soccer_team_drives_robots_that_a_camera_sees_through_bad_packets(tmp_path):
    bad = ["--loss", 0.1, "--late", 0.1, "--double", 0.1, "--drift", -0.02, "--noise", 0.001]
    robots = ["--robot", "blue_0:0", "--robot", "blue_1:0", "--camera", 0]
    with stand_in("joints", "soccer.sdf", *robots, *bad) as (field, at):
        lines = [word for name, port in at["robots"].items()
                 for word in ("--robot", name, "--connect", f"udp:127.0.0.1:{port}")]
        done = drive(tmp_path, "roboss_soccer_blue", WORLDS / "soccer.sdf", *lines, "--camera",
                     f"udp:127.0.0.1:{at['camera']}", "--duration", 4)
        found = summary(field)
    assert found["blue_1"]["distance_m"] > 0.2                  # it goes for the ball
    assert max(map(abs, found["blue_1"]["joint_velocity"])) < 0.5
    assert done["failure"] is None and done["calls"] > 100
    for port in done["devices"]:
        assert port["taken"] > 100 and port["stale"] > 10 and port["lost"] > 10 and port["damaged"] == 0


def test_a_robot_that_falls_silent_alone_does_not_stop_the_others(tmp_path):
    with stand_in("joints", "soccer.sdf", "--robot", "blue_0:0") as (lost, at_lost), \
            stand_in("joints", "soccer.sdf", "--robot", "blue_1:0", "--camera", 0) as (field, at):
        lines = ["--robot", "blue_0", "--connect", f"udp:127.0.0.1:{at_lost['robots']['blue_0']}", "--robot", "blue_1",
                 "--connect", f"udp:127.0.0.1:{at['robots']['blue_1']}", "--camera", f"udp:127.0.0.1:{at['camera']}"]
        words = ["stop-this", "stop-all", "stop-all"]
        silence = [word for each in words for word in ("--on-silence", each)]
        with running(*device(tmp_path, "roboss_soccer_blue", WORLDS / "soccer.sdf", *lines, *silence, "--duration", 4,
                             "--give-up", 30)) as process:
            await_driving(process)
            lost.kill()
            said = process.communicate(timeout=60)[1]
            assert process.returncode == 0, said
        assert summary(field)["blue_1"]["distance_m"] > 0.1     # it drove on
    done = json.loads((tmp_path / "device.json").read_text())
    assert done["losses"] >= 1 and done["failure"] is None
    assert "[lost]" in said and "[unstopped]" in said


def test_the_arm_moves_from_posture_to_posture_through_a_reboot(tmp_path):
    with stand_in("joints", "arm.sdf", "--robot", "arm:0", "--loss", 0.05, "--reboot-at", 2) as (arm, at):
        done = drive(tmp_path, "roboss_arm_postures", WORLDS / "arm.sdf", "--robot", "arm", "--connect",
                     f"udp:127.0.0.1:{at['robots']['arm']}", "--duration", 5)
        found = summary(arm)["arm"]
    assert found["highest"][0] == pytest.approx(0.8, abs=0.03) and found["lowest"][0] == pytest.approx(-0.8, abs=0.03)
    assert done["devices"][0]["reboots"] == found["reboots"] == 1


ARM = """
import sys
angles = dict.fromkeys(["yaw", "shoulder", "elbow", "roll", "bend", "flange"], 0.0)

def stop_motors():
    pass

def set_motors(joints):
    for name, order in joints.items():
        angles[name] += max(-0.01, min(0.01, order["target"] - angles[name]))
        if name == "yaw" and angles[name] > 0.75:
            print("reached", flush=True)

def read_encoders():
    return {name: {"position": angle, "velocity": 0.0} for name, angle in angles.items()}
"""


def test_the_device_that_the_page_shows_is_one(tmp_path):
    page = (REPOSITORY / "docs" / "devices.md").read_text()
    shown, = re.findall(r"^```python\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    assert '("", 2008)' in shown
    with running(sys.executable, "-c", ARM + shown.replace('("", 2008)', f'("127.0.0.1", {port})')) as arm:
        done = drive(tmp_path, "roboss_arm_postures", WORLDS / "arm.sdf", "--robot", "arm", "--connect",
                     f"udp:127.0.0.1:{port}", "--duration", 3)
        arm.kill()
        said = arm.communicate()
    assert "reached" in said[0], said[1]
    assert done["devices"][0]["lost"] == done["devices"][0]["damaged"] == 0


def test_a_robot_whose_program_was_killed_stops_by_its_watchdog(tmp_path):
    with stand_in("joints", "arm.sdf", "--robot", "arm:0") as (arm, at):
        with running(*device(tmp_path, "roboss_arm_postures", WORLDS / "arm.sdf", "--robot", "arm", "--connect",
                             f"udp:127.0.0.1:{at['robots']['arm']}")) as process:
            await_driving(process)
            process.kill()
        time.sleep(1.2)
        found = summary(arm)["arm"]
    assert found["watchdog"] == 1 and max(map(abs, found["joint_velocity"])) < 0.01


def test_ctrl_c_stops_the_robot_first(tmp_path):
    with stand_in("joints", "arm.sdf", "--robot", "arm:0", "--loss", 0.2) as (arm, at):
        options = ["--robot", "arm", "--connect", f"udp:127.0.0.1:{at['robots']['arm']}", WORLDS / "arm.sdf"]
        with running(*device(tmp_path, "roboss_arm_postures", *options)) as process:
            await_driving(process)
            process.send_signal(signal.SIGINT)
            said = process.communicate(timeout=10)[1]
        found = summary(arm)["arm"]
    assert process.returncode == 130 and "[unstopped]" not in said, said
    assert found["stops"] == 1 and "watchdog" not in found


def drive_twin(tmp_path):
    """Places of the twin, where the robot stands in the end, and the command's summary."""
    name = f"twin_{os.getpid()}_{time.monotonic_ns()}"
    trace = tmp_path / "trace.csv"
    with stand_in("khepera", "khepera.sdf", "--drop", 0.001) as (robot, at), \
            running(ROBOSS, "controller", WORLDS / "khepera.sdf", "--local", 1, "--simulators", 0, "--simulation", name,
                    "--headless", "--speed", 1, "--trace", trace, "--trace-every", 0.1, "--no-stay") as run:
        done = drive(tmp_path, "roboss_khepera", "--twin", "--simulation", name, *KHEPERA, f"serial:{at['serial']},38400",
                     "--duration", 4)
        time.sleep(0.5)                                         # it stays where it was put last
        run.send_signal(signal.SIGINT)
        run.communicate(timeout=20)
        found = summary(robot)
    with trace.open() as rows:
        places = [(float(row["x"]), float(row["y"])) for row in csv.DictReader(rows)
                  if row["robot"] == "khepera" and row["link"] == "body"]
    return places, found["pose"][:2], done


def test_a_twin_follows_the_real_robot_in_a_run_of_others(tmp_path):
    for _ in range(5):                                          # where replies are late, odometry is coarse
        places, end, done = drive_twin(tmp_path)
        if done["calls"] > 70:                                  # of 80
            break
    else:
        pytest.skip("this computer is too busy for a robot in real time")
    assert math.dist(places[0], places[-1]) > 0.02
    assert math.dist(places[-1], end) < 0.02                    # odometry drifts
    assert done["placed"] > 50


@pytest.mark.parametrize("options, code, words", [
    ([WORLDS / "khepera.sdf", *KHEPERA, "serial:/dev/no_such_port"], 1, "no-line"),
    ([WORLDS / "khepera.sdf", *KHEPERA, "khepera"], 1, "bad-address"),
    ([WORLDS / "khepera.sdf", "--robot", "kepera", "--connect", "udp:127.0.0.1:9"], 1, "khepera"),
    ([WORLDS / "soccer.sdf", "--robot", "blue_0", "--protocol", "khepera", "--connect", "serial:/dev/null"], 1,
     "not-this-robot"),
    ([*KHEPERA, "udp:127.0.0.1:9"], 2, "--twin"),
    ([WORLDS / "khepera.sdf", "--robot", "khepera", "--robot", "a", "--connect", "udp:127.0.0.1:9"], 2, "--connect"),
    ([WORLDS / "khepera.sdf", *KHEPERA, "udp:127.0.0.1:9", "--give-up", 0.3], 3, "device-lost")])
def test_what_cannot_be_is_said_with_a_remedy(tmp_path, options, code, words):
    with running(*device(tmp_path, "roboss_khepera", *options)) as process:
        said = process.communicate(timeout=20)[1]
    assert process.returncode == code and words in said, said
    assert "remedy:" in said
