#!/usr/bin/env python3
"""Starts each benchmark of bench.sh at its smallest size, with all engines that are installed.

Rows taken here say nothing about speed: what counts is that each benchmark comes to its end and that no engine
crashes. What is not installed is skipped, and named.
Usage: bench/smallest.py BIN [NAME ...]    BIN: the folder of the built programs
Exit codes: 0 all that could be started came to their ends, 1 one did not, 2 wrong usage
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ENGINES = ("MuJoCo", "ODE", "Bullet", "DART", "Box3D", "Rapier")
LIMIT_S = 600
ROBOTS = {"city": 50, "joint_grid": 36}  # these scenes have no smaller size
FAILS = ("crashed", "ended its process", "process has ended")  # bench/peers/worker.cpp


class Skipped(Exception):
    """Something that a benchmark needs is not there."""


class Smallest:
    """Each method is a benchmark; it raises if the benchmark fails."""

    def __init__(self, programs, scratch):
        self.programs, self.scratch = programs, scratch

    def run(self, program, *arguments):
        """Output of a program that must end with 0."""
        path = self.programs / program if isinstance(program, str) else program
        if not path.exists():
            raise Skipped(f"{path.name} is not built")
        done = subprocess.run([path, *map(str, arguments)], capture_output=True, text=True, cwd=ROOT, timeout=LIMIT_S,
                              check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{path.name} {' '.join(map(str, arguments))} ended with {done.returncode}:\n"
                               f"{done.stdout[-1000:]}{done.stderr[-2000:]}")
        return done.stdout

    def engines(self):
        """Those that were built in; the others are named."""
        line = next(l for l in self.run("roboss-accuracy", "--list").splitlines() if l.startswith("engines:"))
        there = [name for name in ENGINES if name in line.split()]
        for name in ENGINES:
            if name not in there:
                print(f"skipped: {name} is not installed (tools/setup.sh peers, tools/fetch_mujoco.sh, tools/fetch_peers.sh)")
        return there

    def peers(self):
        """All scenes in all engines, few robots."""
        self.run("roboss-peers", "--check-engines")
        listed = self.run("roboss-peers", "--help").split("Scenes:")[1].split("  threads:")[0]
        scenes = [line.split(":")[0].strip() for line in listed.splitlines() if ": " in line]
        rows = self.scratch / "peers.json"
        for scene in scenes:
            self.run("roboss-peers", "--scene", scene, "--robots", ROBOTS.get(scene, 4), "--steps", 3, "--settle", 1,
                     "--blocks", 1, "--limit", 5, "--start-limit", 60, "--json", rows)
            for row in json.loads(rows.read_text())["rows"]:
                if any(sign in row.get("skipped", "") for sign in FAILS):
                    raise RuntimeError(f"{row['scene']}, {row['engine']}: {row['skipped']}")

    def accuracy(self):
        """All cases on all peers, each with little patience; RoBOSS has its bounds tested elsewhere."""
        peers = [argument for name in self.engines() for argument in ("--engine", name)]
        if not peers:
            raise Skipped("no other engine is installed")
        self.run("roboss-accuracy", "--patience", 0.05, *peers)

    def table1(self):
        """A city and a pile on one and two Simulators."""
        self.run("roboss-table1", "--driver", self.programs.parent / "lib/roboss_city_driver.so", "--pile",
                 ROOT / "worlds/pile.sdf", "--cars", 10, "--simulators", 1, 2, "--crowd", 10, "--seconds", 0.2, "--detach", 0)

    def bus(self):
        """Two members."""
        self.run("roboss-bus", "--bytes", 1000, "--members", 2, "--idle", 0.1)

    def viewer(self):
        """A few cars, one browser."""
        self.run("roboss-viewer-cost", "--cars", 10, "--viewers", 1, "--rounds", 1, "--seconds", 1)

    def google(self):
        """The first size of each Google Benchmark."""
        first = {}
        for name in self.run("roboss-bench", "--benchmark_list_tests").splitlines():
            first.setdefault(name.split("/")[0], name)
        for name in first.values():
            self.run("roboss-bench", f"--benchmark_filter=^{name}$", "--benchmark_min_time=0.001")

    def learning(self):
        """Agents in Python beside MuJoCo."""
        python = ROOT / "build/python/venv/bin/python"
        if not python.exists() or subprocess.run([python, "-c", "import roboss, mujoco"], capture_output=True, check=False).returncode != 0:
            raise Skipped("build/python/venv has no roboss and mujoco (./bench.sh learning makes it)")
        self.run(python, "-B", ROOT / "bench/learning/learning.py", "--only", 64, "--rounds", 1, "--seconds", 0.1, "--threads", 1)

    def cameras_beside_mujoco(self):
        """Pictures beside MuJoCo's renderer."""
        python = ROOT / "build/bench/osmesa/bin/python"
        if not python.exists():
            raise Skipped("build/bench/osmesa is not there (./bench.sh cameras_beside_mujoco makes it)")
        self.run(python, "-B", ROOT / "bench/cameras/beside_mujoco.py", "--rounds", 1, "--seconds", 0.1, "--threads", 1)


NAMES = ("peers", "accuracy", "table1", "bus", "viewer", "google", "learning", "cameras_beside_mujoco")


def main(arguments):
    """Exit code."""
    wanted = arguments[1:] or NAMES
    if not arguments or any(name not in NAMES for name in wanted):
        print(__doc__, file=sys.stderr)
        return 2
    failed = False
    with tempfile.TemporaryDirectory() as scratch:
        smallest = Smallest(Path(arguments[0]).resolve(), Path(scratch))
        for name in wanted:
            try:
                getattr(smallest, name)()
                print(f"{name}: came to its end")
            except Skipped as reason:
                print(f"skipped: {name}: {reason}")
            except (RuntimeError, subprocess.TimeoutExpired) as error:
                failed = True
                print(f"{name}: FAILED: {error}")
            sys.stdout.flush()
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
