#!/usr/bin/env python3
"""Speed-up by the clock on the wall: a recorded city on 1, 2, ... Simulator processes of this computer, as many as it has
cores (or as --processes says), by turns.
Usage: wall_clock.py BIN_FOLDER DRIVER OUT.json [--cars 2000] [--seconds 2] [--rounds 3] [--processes 1 2 4]"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path


def run(*words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"wall_clock: {' '.join(map(str, words))} ended with {done.returncode}:\n{done.stderr}")
    return done.stdout


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("bin", type=Path)
    parser.add_argument("driver", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--cars", type=int, default=2000)
    parser.add_argument("--settle", type=float, default=1, help="simulated seconds that are not counted: joining, windows that grow")
    parser.add_argument("--seconds", type=float, default=2, help="simulated seconds that are")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--processes", type=int, nargs="+")
    a = parser.parse_args()
    roboss, cores = a.bin / "roboss", len(os.sched_getaffinity(0))
    with tempfile.TemporaryDirectory(prefix="roboss_wall_") as name:
        folder = Path(name)
        world, journal, orders = folder / "city.sdf", folder / "city.journal", folder / "orders.jsonl"
        run(a.bin / "roboss-world", "city", "--cars", a.cars, "-o", world)
        end = a.settle + a.seconds
        print(f"recording {a.cars} cars, {end} s", flush=True)
        run(roboss, "run", world, "--client", a.driver, "--until", end, "--journal", journal, "--headless", "--quiet")
        orders.write_text(run(roboss, "journal", "export", journal, "--orders"))
        runs = [{"processes": n, "wall_s": [], "step_cpu_s": []} for n in a.processes or range(1, cores + 1)]
        summary, hashes = folder / "summary.json", set()

        def told(processes, until):
            run(roboss, "run", world, "--orders", orders, "--until", until, "--processes", processes, "--threads", 1, "--headless", "--quiet", "--json", summary)
            return json.loads(summary.read_text())

        for _ in range(a.rounds):
            for row in runs:
                before, after = told(row["processes"], a.settle), told(row["processes"], end)
                wall_s, step_cpu_s = (after[name] - before[name] for name in ("wall_time_s", "step_cpu_s"))
                row["wall_s"].append(wall_s)
                row["step_cpu_s"].append(step_cpu_s)
                hashes.add(after["state_hash"])
                print(f"{row['processes']} processes: {wall_s:.2f} s, stepping {step_cpu_s:.2f} s of CPU", flush=True)
    if len(hashes) != 1:
        sys.exit(f"wall_clock: the runs ended with different state hashes: {hashes}")
    a.out.write_text(json.dumps({"robots": a.cars, "settle": a.settle, "seconds": a.seconds, "cores": cores, "runs": runs}, indent=1))


if __name__ == "__main__":
    main()
