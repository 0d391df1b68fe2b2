#!/usr/bin/env python3
"""Starts a run of many processes again and again and checks each: all join within a time, nobody is lost, the state hash is
that of one process. Not part of the tests: it takes minutes and measures the machine it runs on.

    tests/processes/soak.py build/release/bin/roboss --processes 64 --times 20
    tests/processes/soak.py build/release/bin/roboss --processes 64 --times 5 --duration 20 --kill 10

With --kill N, N of the processes are killed at random moments, and as many others join. It prints the Controller's memory
and CPU time for each member.
"""
import argparse
import json
import os
import random
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
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


def cost_of(pid):
    """Private memory of a process (MiB) and the CPU time that it has taken (s)."""
    lines = Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines()
    mib = sum(int(line.split()[1]) for line in lines if line.startswith("Private")) / 1024
    ticks = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return mib, (int(ticks[11]) + int(ticks[12])) / os.sysconf("SC_CLK_TCK")


class Killer(threading.Thread):
    """Kills a process of a run now and then, and has another one join."""

    def __init__(self, roboss, run, count, seed):
        super().__init__(daemon=True)
        self.roboss, self.run_pid, self.count, self.chance = roboss, run.pid, count, random.Random(seed)
        self.killed = 0

    def run(self):
        while self.killed < self.count:
            time.sleep(self.chance.uniform(0.05, 1.0))
            try:
                children = Path(f"/proc/{self.run_pid}/task/{self.run_pid}/children").read_text().split()
                if len(children) < 2:
                    continue
                os.kill(int(self.chance.choice(children)), signal.SIGKILL)
                self.killed += 1
                subprocess.run([self.roboss, "control", "--simulation", str(self.run_pid), "simulators", "add"], capture_output=True, timeout=60)
            except (OSError, subprocess.TimeoutExpired):
                return  # the run has ended


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

    def report(self, pid):
        """Prints the cost of a process, and that of the Controller for each."""
        pss, threads = memory_of(pid)
        mib, cpu_s = cost_of(pid)
        count = self.options.processes
        if pss:
            print(f"    {max(threads)} threads and {statistics.mean(pss):.1f} MiB (PSS) a process; the Controller: {mib / count:.2f} MiB and "
                  f"{1e3 * cpu_s / count:.1f} ms of CPU time for each that joined", flush=True)

    def once(self, expected):
        """Seconds until all had joined and until the end; an error, or nothing."""
        began, joined_s, joined, said = time.monotonic(), None, 0, []
        process = subprocess.Popen(self.run("--processes", self.options.processes), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        for line in process.stderr:
            said.append(line)
            joined += " joined at tick " in line
            if joined == self.options.processes and joined_s is None:
                joined_s = time.monotonic() - began
                self.report(process.pid)
                killer = Killer(self.options.roboss, process, self.options.kill, len(said))
                killer.start()
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
    parser.add_argument("--kill", type=int, default=0, help="number of processes that are killed at random moments; as many others join")
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
