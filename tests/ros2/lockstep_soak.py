"""Lockstep for long: five nodes of rclpy drive twenty robots by their scans, in many runs, whose hashes must be equal.

Usage: lockstep_soak.py ROBOSS WORLD CLIENTS [--runs N] [--seconds S] [--load N] [--client kilted]
CLIENTS: the folder that tools/ros2_clients.sh made. From the third run on each has other numbers of Simulators; in every second
one a Simulator process is killed, again and again. --load: processes that compute beside it. At the end the last journal is
replayed without nodes. Exit code 1: a hash differs.
"""
import argparse
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from harness import Process, children_of, enter_own_network, python_of

HERE = Path(__file__).resolve().parent
ROBOTS, NODES = 20, 5


def kill_simulators(run, chance, killed):
    """Kills one Simulator every few seconds until the run is over."""
    while run.poll() is None:
        time.sleep(chance.uniform(2, 6))
        simulators = children_of(run.pid, "simulator") if run.poll() is None else []
        if len(simulators) > 1:
            os.kill(chance.choice(simulators), signal.SIGKILL)
            killed.append(time.monotonic())


def play(o, number, folder):
    """One run with its nodes: the summary, how many Simulators were killed, and seconds."""
    processes = 0 if number < 2 else 2 + number % 3
    words = ["--processes", str(processes)] if processes else ["--simulators", str(number + 1)]
    log = open(folder / f"{number}.log", "w")
    begin = time.monotonic()
    run = subprocess.Popen([o.roboss, "run", o.world, "--ros2", "--ros2-lockstep", "/*/cmd_vel", "--ros2-period", "0.1", "--headless",
                            "--speed", "max", "--duration", str(o.seconds), "--journal", folder / "run.journal", "--json",
                            folder / "run.json", *words], stdout=subprocess.DEVNULL, stderr=log)
    python, environment = python_of(o.clients / o.client)
    each = ROBOTS // NODES
    nodes = [Process([python, "-B", HERE / "nodes/wanderer.py", f"wanderer_{n}", *(f"turtle_{n * each + k}" for k in range(each))],
                     environment) for n in range(NODES)]
    killed = []
    if number % 2 == 1 and processes:
        threading.Thread(target=kill_simulators, args=(run, random.Random(number), killed), daemon=True).start()
    code = run.wait(timeout=60 + 30 * o.seconds)
    for node in nodes:
        node.process.kill()
        node.process.wait()
    if code:
        sys.exit(f"the run ended with {code}:\n" + (folder / f"{number}.log").read_text())
    return json.loads((folder / "run.json").read_text()), words, len(killed), time.monotonic() - begin


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("roboss", type=Path)
    arguments.add_argument("world", type=Path)
    arguments.add_argument("clients", type=Path)
    arguments.add_argument("--runs", type=int, default=10)
    arguments.add_argument("--seconds", type=float, default=60)
    arguments.add_argument("--load", type=int, default=0)
    arguments.add_argument("--client", default="kilted")
    o = arguments.parse_args()
    enter_own_network(o.clients / o.client)
    busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(o.load)]
    hashes = set()
    try:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for number in range(o.runs):
                (folder / "run.journal").unlink(missing_ok=True)
                summary, words, killed, seconds = play(o, number, folder)
                hashes.add(summary["state_hash"])
                print(f"run {number + 1}: {summary['state_hash']}, {' '.join(words)}, {killed} killed, {seconds:.0f} s", flush=True)
            replay = subprocess.run([o.roboss, "replay", folder / "run.journal", "--json", "-"], capture_output=True, text=True,
                                    check=True)
            hashes.add(json.loads(replay.stdout)["state_hash"])
            print("replay: " + json.loads(replay.stdout)["state_hash"])
    finally:
        for process in busy:
            process.kill()
    sys.exit(len(hashes) != 1)


if __name__ == "__main__":
    main()
