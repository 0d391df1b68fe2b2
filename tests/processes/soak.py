#!/usr/bin/env python3
"""Starts a run of many processes again and again and checks each: all join within a time, nobody is lost, the state hash is
that of one process. Not part of the tests: it takes minutes and measures the machine it runs on.

    tests/processes/soak.py build/release/bin/roboss --processes 64 --times 20
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

WORLDS = Path(__file__).resolve().parents[2] / "worlds"


def memory_of(pid):
    """Private and shared memory by its share (PSS), MiB, and threads of the children of a process."""
    pss, threads = [], []
    for child in Path(f"/proc/{pid}/task/{pid}/children").read_text().split():
        try:
            lines = Path(f"/proc/{child}/smaps_rollup").read_text().splitlines()
            pss.append(next(int(line.split()[1]) for line in lines if line.startswith("Pss:")) / 1024)
            threads.append(len(os.listdir(f"/proc/{child}/task")))
        except (OSError, StopIteration):
            pass  # it has just ended
    return pss, threads


class Soak:
    def __init__(self, options, folder):
        self.options = options
        self.summary = Path(folder) / "summary.json"
        self.world = [options.world, *(["--orders", options.orders] if options.orders else []), "--duration", options.duration, "--headless"]

    def run(self, *arguments):
        self.summary.unlink(missing_ok=True)
        return [self.options.roboss, "run", *map(str, [*self.world, *arguments]), "--json", str(self.summary)]

    def expected(self):
        subprocess.run(self.run("--quiet"), check=True, stdout=subprocess.DEVNULL)
        return json.loads(self.summary.read_text())["state_hash"]

    def once(self, expected):
        """Seconds until all had joined and until the end; an error, or nothing."""
        began, joined_s, joined, said = time.monotonic(), None, 0, []
        process = subprocess.Popen(self.run("--processes", self.options.processes), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        for line in process.stderr:
            said.append(line)
            joined += " joined at tick " in line
            if joined == self.options.processes and joined_s is None:
                joined_s = time.monotonic() - began
                pss, threads = memory_of(process.pid)
                if pss:
                    print(f"    {max(threads)} threads and {statistics.mean(pss):.1f} MiB (PSS) a process", flush=True)
        code, took = process.wait(), time.monotonic() - began
        found = json.loads(self.summary.read_text()) if self.summary.exists() else {}
        if code != 0 or joined_s is None:
            return joined_s, took, f"exit code {code}:\n{''.join(said[-15:])}"
        if found["state_hash"] != expected:
            return joined_s, took, f"hash {found['state_hash']} instead of {expected}"
        late = f"all had joined after {joined_s:.1f} s only" if joined_s > self.options.within else None
        return joined_s, took, late


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("roboss")
    parser.add_argument("--processes", type=int, default=64)
    parser.add_argument("--times", type=int, default=20)
    parser.add_argument("--within", type=float, default=20, help="until all have joined, s")
    parser.add_argument("--world", default=str(WORLDS / "crossroads.sdf"))
    parser.add_argument("--orders", default=str(WORLDS / "crossroads.jsonl"), help="'' for none")
    parser.add_argument("--duration", type=float, default=1.2)
    options = parser.parse_args()
    starts, failures = [], 0
    with tempfile.TemporaryDirectory() as folder:
        soak = Soak(options, folder)
        expected = soak.expected()
        for i in range(options.times):
            joined_s, took, error = soak.once(expected)
            starts += [] if joined_s is None else [joined_s]
            failures += error is not None
            print(f"{i + 1:3}  joined {joined_s or 0:5.1f} s  ended {took:5.1f} s  load {os.getloadavg()[0]:.1f}  {error or 'fine'}", flush=True)
    if starts:
        print(f"all {options.processes} had joined after {min(starts):.1f} to {max(starts):.1f} s, median {statistics.median(starts):.1f} s")
    print(f"{failures} of {options.times} failed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
