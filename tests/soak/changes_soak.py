#!/usr/bin/env python3
"""Adds 1000 robots to a running world and removes them again, then resets the run, many times. Checks that the other robots do
not notice (changes_program.cpp compares their state hashes with an undisturbed run at every tick), that memory and journal do
not grow, and reports the times.

    tests/soak/changes_soak.py build/release/bin/roboss build/release/lib/libroboss_changes_program.so \\
        --rounds 100 --resets 10000 --existing 2000
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

BOX = """<link name="box"><inertial><mass>1</mass><inertia><ixx>.02</ixx><iyy>.02</iyy><izz>.02</izz></inertia></inertial>
<collision name="c"><geometry><box><size>.4 .4 .4</size></box></geometry></collision></link>"""


def world_of(existing):
    """Boxes on a plane, a little above it, so that something happens."""
    boxes = "".join(f'<model name="box_{i}"><pose>{i % 50} {i // 50} .{25 + i % 7} 0 0 0</pose>{BOX}</model>\n' for i in range(existing))
    return f"""<sdf version="1.9"><world name="soak"><physics type="ode"><max_step_size>0.001</max_step_size></physics>
<model name="ground"><static>1</static><link name="l"><collision name="c"><geometry><plane/></geometry></collision></link></model>
{boxes}</world></sdf>"""


def report_times(name, found):
    seconds, cpu = found[f"{name}_s"], found[f"{name}_cpu_s"]
    if seconds:
        print(f"{name:7} {len(seconds):6} times, ms: median {1e3 * statistics.median(seconds):8.2f}, longest {1e3 * max(seconds):8.2f}; "
              f"CPU: median {1e3 * statistics.median(cpu):7.2f}, longest {1e3 * max(cpu):7.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("roboss")
    parser.add_argument("program")
    parser.add_argument("--rounds", type=int, default=100, help="of adding and removing")
    parser.add_argument("--robots", type=int, default=1000, help="that come and go")
    parser.add_argument("--resets", type=int, default=10_000)
    parser.add_argument("--existing", type=int, default=20, help="robots of the world")
    parser.add_argument("--ticks-each", type=int, default=5, help="between two changes")
    parser.add_argument("--simulators", type=int, default=1)
    parser.add_argument("--journal", action="store_true")
    parser.add_argument("--within", type=float, default=1.0, help="CPU time of an addition or removal, s (wall time depends on what else runs)")
    parser.add_argument("--grows-at-most", type=float, default=10, help="MiB of memory, from a tenth of the rounds or resets on")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        world, model, report, journal = (Path(folder) / name for name in ("world.sdf", "box.sdf", "report.json", "run.journal"))
        world.write_text(world_of(options.existing))
        model.write_text(f'<sdf version="1.9"><model name="box">{BOX}</model></sdf>')
        environment = dict(os.environ, SOAK_MODEL=str(model), SOAK_REPORT=str(report), SOAK_TICKS="200", SOAK_ROUNDS=str(options.rounds),
                           SOAK_ROBOTS=str(options.robots), SOAK_RESETS=str(options.resets), SOAK_TICKS_EACH=str(options.ticks_each))
        command = [options.roboss, "run", world, "--client", options.program, "--headless", "--quiet", "--duration", "60",
                   "--simulators", options.simulators, *(["--journal", journal] if options.journal else [])]
        done = subprocess.run(list(map(str, command)), env=environment, capture_output=True, text=True)
        if done.returncode != 0 or not report.exists():
            sys.exit(f"exit code {done.returncode}:\n{done.stdout[-2000:]}{done.stderr[-4000:]}")
        found = json.loads(report.read_text())
        print(f"{options.existing} robots in the world, {options.robots} come and go, {options.simulators} Simulators"
              f"{', with a journal' if options.journal else ''}")
        report_times("add", found)
        report_times("remove", found)
        report_times("reset", found)
        faults = []
        for name in ("add", "remove"):
            if found[f"{name}_cpu_s"] and max(found[f"{name}_cpu_s"]) > options.within:
                faults.append(f"{name} took {max(found[f'{name}_cpu_s']):.2f} s of CPU time")
        for name, mib in (("rounds", found["mib"][:options.rounds]), ("resets", found["mib"][options.rounds:])):
            if not mib:
                continue
            grown = mib[-1] - mib[len(mib) // 10]
            print(f"{name:7} memory, MiB: first {mib[0]:.1f}, last {mib[-1]:.1f}, most {max(mib):.1f}")
            if grown > options.grows_at_most:
                faults.append(f"memory grew by {grown:.1f} MiB over the {name}")
        if options.journal:
            kib = journal.stat().st_size / 1024
            print(f"journal {kib:.0f} KiB, {kib / max(1, options.resets + 2 * options.rounds):.1f} KiB a change")
        if faults:
            sys.exit("; ".join(faults))


if __name__ == "__main__":
    main()
