#!/usr/bin/env python3
"""Fleets of robots with a node that drives them all and reads their scans, beside the same runs without ROS 2.

Usage: scale.py BIN JSON [--robots N ...] [--seconds S]      BIN: the folder of roboss and roboss-fleet-peer
Each robot has cmd_vel, odom, joint_states and a scan of 360 beams at 10 Hz, and drives in circles in all rows: without
ROS 2 by a file of orders. Rows: real-time factor, CPU of the run and of the face as shares of a core, what arrived at the
node. The network is that of this computer: `unshare -n` with loopback and multicast keeps it apart.
"""
import argparse
import json
import os
import subprocess
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
TICKS = os.sysconf("SC_CLK_TCK")


def world_of(robots, folder):
    """A world with this number of robots of worlds/fleet.sdf, 2 m apart."""
    side = int(robots ** 0.5) + 1
    ground = ROOT.joinpath("worlds/fleet.sdf").read_text().split("<model name=\"yard\">")[0]
    fleet = "".join(f"<include><uri>model://turtle</uri><name>turtle_{n}</name><pose>{2 * (n % side)} {2 * (n // side)} 0 0 0 0"
                    "</pose></include>\n" for n in range(robots))
    path = folder / f"fleet_{robots}.sdf"
    path.write_text(ground + fleet + "</world></sdf>")
    return path


def cpu_s(pid):
    """CPU time of a process, s; None: it is gone."""
    try:
        fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    except OSError:
        return None
    return (int(fields[11]) + int(fields[12])) / TICKS


def measure(program, world, robots, seconds, words, is_read):
    """Factor of real time and CPU shares of the run and its children over `seconds`, with what the peer says."""
    log = world.with_suffix(".json")
    run = subprocess.Popen([program / "roboss", "run", world, "--path", ROOT / "worlds/models", "--headless", "--json", log,
                            "--duration", "100000", *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(2 + robots / 100)  # until it runs, and its face is there
    children = Path(f"/proc/{run.pid}/task/{run.pid}/children").read_text().split()
    peer = None
    row = {"robots": robots}
    if is_read:
        peer = subprocess.Popen([program / "roboss-fleet-peer", str(robots), str(seconds + 5), "120"], stdout=subprocess.PIPE,
                                text=True)
        row |= json.loads(peer.stdout.readline())
        time.sleep(1)
    before = [cpu_s(pid) for pid in (run.pid, *children)]
    time.sleep(seconds)
    after = [cpu_s(pid) for pid in (run.pid, *children)]
    row["run_cpu"] = round((after[0] - before[0]) / seconds, 3)
    if children:
        row["face_cpu"] = round(sum(b - a for a, b in zip(before[1:], after[1:])) / seconds, 3)
    if peer:
        row |= json.loads(peer.communicate(timeout=60)[0] or "{}")
    run.terminate()
    run.wait(timeout=60)
    summary = json.loads(log.read_text())
    row.setdefault("real_time_factor", round(summary["real_time_factor"], 2))  # the peer's is without the start
    return row


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("bin", type=Path)
    arguments.add_argument("json", type=Path)
    arguments.add_argument("--robots", type=int, nargs="+", default=[100, 500, 1000])
    arguments.add_argument("--seconds", type=float, default=20)
    o = arguments.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for robots in o.robots:
            world = world_of(robots, Path(folder))
            orders = Path(folder) / "orders.jsonl"
            orders.write_text('{"t": 0, "robot": "turtle_*", "command": {"name": "cmd_vel", "linear_x": 0.1, "angular_z": 0.2}}\n')
            driven, ros2, fast = ["--orders", orders], ["--ros2", "--ros2-period", "0.1"], ["--speed", "max"]
            for name, words, is_read in (("without ROS 2", [*fast, *driven], False),
                                         ("idle face, in real time", ["--speed", "1", *driven, *ros2], False),
                                         ("with a node", [*fast, *ros2], True),
                                         ("with a node, in real time", ["--speed", "1", *ros2], True)):
                row = {"run": name, **measure(o.bin, world, robots, o.seconds, words, is_read)}
                print(json.dumps(row), flush=True)
                rows.append(row)
    o.json.write_text(json.dumps(rows, indent=1))


if __name__ == "__main__":
    main()
