#!/usr/bin/env python3
"""Finds motor torque and tyre friction of a soccer robot from recorded runs, as the 2005 paper did (section 5.2).

    python examples/soccer/calibrate.py

Runs of a robot whose numbers differ from those of worlds/soccer.sdf play the real one: an overhead camera sees it 60
times a second, with noise. `roboss.analysis.calibration` finds the numbers again; `roboss calibrate` does the same with
files (the commands that this program prints).
"""
import argparse
import json
import sys
import tempfile
import warnings
import xml.etree.ElementTree as xml
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from imports import needed  # noqa: E402

with needed():
    import numpy as np
    import pyarrow  # noqa: F401 (roboss.analysis imports these two when it needs them)
    import scipy  # noqa: F401

    import roboss
    from roboss.analysis import Recording, calibration, record, write
    from roboss.analysis.recorder import journal_of_run

TORQUE = calibration.Parameter("torque", (".//joint/axis/limit/effort",))
FRICTION = calibration.Parameter("friction", (".//collision[@name='tyre']/surface/friction/ode/mu",
                                              ".//collision[@name='tyre']/surface/friction/ode/mu2"), 0.3, 2.0)
TRUE = {"torque": 0.0262, "friction": 0.93}                # N m; 1
WHEELS = {"straight": [(0.0, 200, 200)], "curve": [(0.0, 60, 60), (0.3, 120, 40)]}  # s, rad/s: left, right
SECONDS = {"straight": 0.5, "curve": 1.0}
PERIOD, NOISE = 1 / 60, {"m": 0.001, "rad": 0.005}         # of the camera: s; standard deviations


def lone_robot(folder):
    """A world with blue_0 alone on the pitch."""
    tree = xml.parse(roboss.example("soccer.sdf"))
    world = tree.getroot().find("world")
    for model in list(world.findall("model")):
        if model.find("joint") is not None and model.get("name") != "blue_0" or model.get("name") in ("ball", "scoreboard"):
            world.remove(model)
    for name in ("mu", "mu2"):                             # of a pair the smaller friction counts: that of the tyres
        world.find(f".//collision[@name='table']/surface/friction/ode/{name}").text = "10"
    path = Path(folder) / "robot.sdf"
    tree.write(path)
    return path


def orders(folder, name):
    """The orders file of a run."""
    path = Path(folder) / f"{name}.jsonl"
    lines = [{"t": time, "robot": "blue_0", "joint": {"name": wheel, "velocity": speed}}
             for time, left, right in WHEELS[name] for wheel, speed in (("left", left), ("right", right))]
    path.write_text("".join(json.dumps(line) + "\n" for line in lines))
    return path


def seen(world, orders_file, seconds, folder, random):
    """What the camera saw of a run."""
    with tempfile.TemporaryDirectory(dir=folder) as place:
        run = record(journal_of_run(world, seconds, place, orders=str(orders_file)), ["blue_0.x", "blue_0.y", "blue_0.yaw"], every=0)
    rows = np.searchsorted(run.time, np.arange(0, seconds, PERIOD))
    noise = np.array([NOISE[column.unit] for column in run.columns])
    return Recording(run.time[rows], run.columns, run.values[rows] + random.normal(size=(len(rows), len(noise))) * noise)


def calibrated(folder, progress=None, seed=1):
    """Calibration of the nominal robot by runs of the true one."""
    nominal, random = lone_robot(folder), np.random.default_rng(seed)
    truth = Path(folder) / "truth.sdf"
    truth.write_text(calibration.WorldFile(nominal, (TORQUE, FRICTION)).text(TRUE.values()))
    runs = []
    for name, seconds in SECONDS.items():
        by = orders(folder, name)
        runs.append(calibration.TestRun(seen(truth, by, seconds, folder, random), str(by)))
        write(runs[-1].recording, Path(folder) / f"{name}.parquet")
    return calibration.calibrate(nominal, (TORQUE, FRICTION), runs, progress=progress)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--keep", metavar="FOLDER", help="leave world, orders and recordings here")
    parser.add_argument("--seed", type=int, default=1, help="of the camera's noise")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        if arguments.keep:
            folder = arguments.keep
            Path(folder).mkdir(exist_ok=True, parents=True)
        found = calibrated(folder, lambda line: print(line, flush=True), arguments.seed)
    for n, name in enumerate(found.names):
        print(f"{name}: in the file {found.start[n]:g}, true {TRUE[name]:g}, found {found.values[n]:.5g} "
              f"({100 * (found.values[n] / TRUE[name] - 1):+.2f} %), 95 % interval {found.low[n]:.5g} to {found.high[n]:.5g}")
    print("left: " + ", ".join(f"{rms:.3g} {unit}" for unit, rms in found.rms.items()))
    if arguments.keep:
        paths = [f'--parameter "{p.name}={",".join(p.paths)}{"" if p.low is None else f"@{p.low:g}..{p.high:g}"}"' for p in (TORQUE, FRICTION)]
        print(f"the same by files:\n  cd {folder}; roboss calibrate robot.sdf " + " ".join(f"--run {name}.parquet={name}.jsonl" for name in SECONDS)
              + " " + " ".join(paths) + " -o calibrated.sdf")


if __name__ == "__main__":
    warnings.simplefilter("ignore", roboss.WorldWarning)
    main()
