"""Where the repository is, runs of the golden list, and the commands of roboss.analysis."""
import contextlib
import io
import json
import os
import re
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

import roboss
from roboss.analysis.command import main as analysis

REPOSITORY = Path(__file__).resolve().parents[2]
ROBOSS = REPOSITORY / "build" / "release" / "bin" / "roboss"
#: Pages whose Python runs as it stands, one block after the other.
PAGES = ["README.md", "docs/python.md", "docs/learning.md", "docs/randomization.md", "docs/older-systems.md",
         "docs/from-isaac-lab-mujoco-gymnasium.md"]
BLOCK = re.compile(r"^```python\n(.*?)^```", re.DOTALL | re.MULTILINE)


@dataclass(frozen=True)
class Golden:
    """A run of tests/golden_hashes.txt: the hash that `roboss run` gives in every build."""

    hash: str
    world: str
    orders: str
    duration: float
    precision: str
    accuracy: str

    def __str__(self):
        return Path(self.world).stem + ("-float" if self.precision == "float" else "") + self.accuracy


def golden_runs():
    """One of each set of lines with the same hash, without those that need a control program or messages."""
    runs = {}
    for line in (REPOSITORY / "tests" / "golden_hashes.txt").read_text().splitlines():
        words = line.split()
        if not words or line.startswith("#") or "--client" in words or "errands" in words[1]:
            continue
        options = dict(zip(words, words[1:]))
        runs.setdefault(words[0], Golden(words[0], words[1], options.get("--orders", ""), float(options["--duration"]),
                                         options.get("--precision", "double"), options.get("--accuracy", "")))
    return list(runs.values())


def analysis_command(*words, folder="."):
    """Exit code, output and errors of `roboss record`, `plot`, `analyse` or `calibrate`, run in this process: a Python that
    starts and imports all again takes longer than most of them."""
    out, errors = io.StringIO(), io.StringIO()
    with contextlib.chdir(folder), contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors), \
            pytest.raises(SystemExit) as end:
        analysis(list(words))
    return end.value.code, out.getvalue(), errors.getvalue()


def refuse_one(robots, parameters, name, values, code):
    """Assigns numbers of which one robot of the crossroads, car_11, refuses its own, and nothing is changed."""
    before = robots.simulation.state_hash
    with pytest.raises(roboss.OrderError) as refused:
        parameters[name] = values
    assert refused.value.code == code and "car_11" in str(refused.value) and robots.simulation.state_hash == before


@pytest.fixture
def sim():
    """Cars that drive, with an order that has not taken effect yet."""
    sim = roboss.Simulation(REPOSITORY / "worlds/crossroads.sdf", threads=2, seed=3)
    sim.robots("car_*").set_joint_targets(9.0)
    sim.step(200)
    sim.robots("car_1*").set_joint_targets(-4.0)
    return sim


@pytest.fixture
def crossroads():
    """A simulation of sixteen cars on a ring."""
    return roboss.Simulation(roboss.example("crossroads.sdf"), threads=1)


@pytest.fixture(scope="session")
def clean_python(tmp_path_factory):
    """The Python of a new environment that has the wheel and what pip installs with it."""
    tag = "abi3" if sys.version_info >= (3, 12) else f"cp3{sys.version_info.minor}"  # tools/release.sh makes both
    wheel, = (REPOSITORY / "dist").glob(f"roboss-*-{tag}-*.whl")
    folder = tmp_path_factory.mktemp("clean")
    subprocess.run([sys.executable, "-m", "venv", folder], check=True)
    python = folder / "bin" / "python"
    subprocess.run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", wheel], check=True)
    return python


@pytest.fixture(scope="session")
def branched(tmp_path_factory):
    """A journal of 1 s, 1000 ticks; at 0.4 s a car went, at 0.7 s the run was taken back to 0.5 s."""
    folder = tmp_path_factory.mktemp("branched")
    path, name = folder / "branched.journal", f"branched_{os.getpid()}"
    command = [ROBOSS, "run", REPOSITORY / "worlds/crossroads.sdf", "--headless", "--quiet", "--paused", "--simulation", name,
               "--journal", path]
    with (subprocess.Popen(list(map(str, command)), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process,
          contextlib.ExitStack() as at_the_end):
        at_the_end.callback(process.kill)  # it is paused, and a failure here would wait for it
        def ask(*words):
            done = subprocess.run([ROBOSS, "control", "--simulation", name, "--patience", "30", "--json", *map(str, words)],
                                  capture_output=True, text=True, check=True)
            return json.loads(done.stdout)

        def to(tick):
            ask("step", tick - ask("status")["tick"])
            while ask("status")["tick"] < tick:
                time.sleep(0.01)
        to(200)
        ask("remove", "car_3")
        to(350)
        ask("rewind", 0.5)
        to(500)
        ask("quit")
        process.wait(timeout=60)
    return path


class OrderFile:
    """Orders of a --orders file, given through the package when their tick has come."""

    def __init__(self, path, sim):
        lines = [json.loads(line) for line in path.read_text().splitlines() if line and not line.startswith("#")]
        self.sim = sim
        self.lines = sorted(lines, key=lambda line: line["t"])  # stable: of one tick in the order of the file

    def run(self, end, part):
        """Steps to the tick `end`, at most `part` ticks a call."""
        while self.sim.tick < end:
            while self.lines and round(self.lines[0]["t"] / self.sim.dt) <= self.sim.tick:
                self.give(self.lines.pop(0))
            due = round(self.lines[0]["t"] / self.sim.dt) if self.lines else end
            self.sim.step(min(part, due - self.sim.tick, end - self.sim.tick))

    def give(self, line):
        (kind, order), = ((key, value) for key, value in line.items() if key not in ("t", "robot"))
        getattr(self, kind)(self.sim.robots(line["robot"]), order)  # a name or a pattern

    def joint(self, robot, order):
        mode, = (key for key in ("velocity", "position", "effort") if key in order)
        name = order["name"] if order["name"] in robot.joints else f"{order['name']}:{order.get('axis', 0)}"
        robot.set_joint_targets(order[mode], name, mode=mode, max_effort=order.get("max_effort"))

    def command(self, robot, order):
        named = {name: value for name, value in order.items() if name != "name"}
        robot.command(order["name"], named.pop("values", None), **named)

    def set_pose(self, robot, order):
        w, x, y, z = order.get("orientation", [1, 0, 0, 0])
        robot.pose = order["position"] + list(np.array([x, y, z, w]) / np.sqrt(w * w + x * x + y * y + z * z))

    def set_velocity(self, robot, order):
        robot.twist = order.get("linear", [0, 0, 0]) + order.get("angular", [0, 0, 0])

    def wrench(self, robot, order):
        robot.apply_wrench(order.get("force", [0, 0, 0]) + order.get("torque", [0, 0, 0]), order["link"],
                           ticks=round(order["duration"] / self.sim.dt))

    def transmit(self, robot, order):
        payload = bytes.fromhex(order["hex"]) if "hex" in order else order["text"]
        robot[order["radio"]].send(payload, to=order.get("to"))

    def attach(self, robot, order):
        self.sim.attach(robot.names[0], order["robot"], max_force=order.get("max_force", float("inf")))

    def detach(self, robot, order):
        self.sim.detach(robot.names[0], order["robot"])
