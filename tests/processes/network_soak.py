#!/usr/bin/env python3
"""Rounds of a run over three hosts (network namespaces) on a bad network, while its members are killed.

The cables lose, repeat and delay packets; Simulators, the Client or the Controller are killed, stopped or cut off. Every round
must end with exit code 0 and the state hash of one process, within three times the undisturbed time. Every wait of more than ten
seconds must be reported. Needs root and ip(8). Not part of the tests: it takes a quarter of an hour.

    tests/processes/network_soak.py build/release/bin/roboss build/release/lib/roboss_city_driver.so worlds --rounds 50

A round depends on its seed alone, but for the moments at which the processes are hit: --seeds 17..18 repeats round 17.
"""
import argparse
import json
import random
import signal
import subprocess
import sys
import time

import bad_cable
from members import DRIVER, FOLDER, ROBOSS, WORLDS, Member, embedded  # takes its own arguments

SILENT_MOST_S, TIMES_MOST = 10, 3
AT_LEAST_S = 20  # a bound for runs that are short when undisturbed: a member is given up and replaced
TROUBLES = ("none", "kill", "stop", "cut", "client", "controller")


class Host(Member):
    """A member of the run on one of the hosts."""

    def __init__(self, hosts, host, *arguments):
        self.host, self.what = host, f"{arguments[0]} on host {host}"
        where = ["--interface", hosts.address(host)] if arguments[0] == "controller" else ["--controller", hosts.address(0), "--patience", 60]
        inside = [*hosts.inside(host), ROBOSS, *map(str, [*arguments, "--simulation", "soak", *where])]
        self.log = open(FOLDER / f"soak-{time.monotonic_ns()}.log", "w+")
        self.process = subprocess.Popen(inside, stdout=self.log, stderr=subprocess.STDOUT)


class Round:
    def __init__(self, seed, options):
        self.chance = random.Random(seed)
        self.options, self.seed = options, seed
        self.trouble = TROUBLES[seed % len(TROUBLES)]
        self.network = {"loss": self.chance.uniform(0, 0.1), "repeat": self.chance.uniform(0, 0.05),
                        "delay_s": self.chance.uniform(0, 0.005), "drops_fragments": seed % 2 == 1}
        self.members, self.silent_s, self.hits = [], 0.0, 0

    def start(self, hosts, host, *arguments):
        self.members.append(Host(hosts, host, *arguments))
        return self.members[-1]

    def hit(self, hosts):
        """One of the members is hit; later it is back, or another one is there for it."""
        running = [m for m in self.members[1:] if m.process.poll() is None]
        simulators = [m for m in running if m.kind == "simulator"]
        clients = [m for m in running if m.kind == "client"]
        if self.trouble == "kill" and simulators:
            member = self.chance.choice(simulators)
            member.process.kill()
            self.simulator(hosts, member.host)
        elif self.trouble == "client" and clients:
            clients[0].process.kill()
            self.client(hosts)
        elif self.trouble == "stop" and simulators:
            member = self.chance.choice(simulators)
            member.process.send_signal(signal.SIGSTOP)
            self.wait(self.chance.uniform(0.3, 3))
            member.process.send_signal(signal.SIGCONT)
        elif self.trouble == "controller":
            self.members[0].process.kill()
            self.members[0].process.wait()
            self.members[0] = Host(hosts, 0, *self.command)  # from its journal
        elif self.trouble == "cut":
            host = self.chance.choice((1, 2))
            bad_cable.ip("-n", hosts.name(host), "link", "set", "eth0", "down")
            self.wait(self.chance.uniform(0.3, 3))
            bad_cable.ip("-n", hosts.name(host), "link", "set", "eth0", "up")
        else:
            return
        self.hits += 1

    def simulator(self, hosts, host):
        self.start(hosts, host, "simulator").kind = "simulator"

    def client(self, hosts):
        self.start(hosts, 2, "client", DRIVER, "--name", "driver").kind = "client"

    def wait(self, for_s):
        """Lets time pass, and measures how long no member reports anything while the world does not advance."""
        end = time.monotonic() + for_s
        while time.monotonic() < end and self.members[0].process.poll() is None:
            time.sleep(0.05)
            said = sum(member.log.seek(0, 2) for member in self.members), self.summary_ticks()
            if said != self.heard:
                self.heard, self.heard_at = said, time.monotonic()
            if not self.members[0].said().rstrip().endswith("[standstill]"):  # it said whom it waits for
                self.silent_s = max(self.silent_s, time.monotonic() - self.heard_at)

    def all_said(self):
        return "\n".join(f"-- {member.what}, {member.process.poll()}\n{member.said()}" for member in self.members)

    def summary_ticks(self):
        return self.progress.stat().st_size if self.progress.exists() else 0

    def run(self, world, network, trouble, most_s):
        """Seconds until the Controller ended with exit code 0, and the state hash."""
        self.trouble, self.heard, self.heard_at = trouble, None, time.monotonic()
        summary, self.progress, journal = (FOLDER / f"soak-{time.monotonic_ns()}.{kind}" for kind in ("json", "csv", "journal"))
        with bad_cable.Hosts(3, seed=self.seed, **network) as hosts:
            start = time.monotonic()
            try:
                self.command = ["controller", *world, "--simulators", 2, "--await-client", "driver", "--json", summary, "--headless",
                                "--journal", journal, "--journal-every", 0.1, "--trace", self.progress, "--trace-every", 0.02]
                self.start(hosts, 0, *self.command)
                for host in (1, 2):
                    self.simulator(hosts, host)
                self.client(hosts)
                while self.members[0].process.poll() is None:
                    if time.monotonic() - start > most_s:
                        raise AssertionError(f"not over after {most_s:.0f} s:\n{self.all_said()}")
                    self.wait(self.chance.uniform(0.5, 1.5))
                    if self.hits < self.options.hits and self.members[0].process.poll() is None:
                        self.hit(hosts)
                took = time.monotonic() - start
                if code := self.members[0].process.returncode:
                    raise AssertionError(f"the Controller ended with {code}:\n{self.all_said()}")
                return took, json.loads(summary.read_text())["state_hash"], hosts.lost
            finally:
                for member in self.members:
                    member.process.send_signal(signal.SIGCONT)
                    member.kill()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], usage="%(prog)s ROBOSS DRIVER WORLDS [--rounds N] ...")
    parser.add_argument("--rounds", type=int, default=50)
    parser.add_argument("--seeds", help="FIRST..LAST instead of 0..ROUNDS, without the last")
    parser.add_argument("--hits", type=int, default=2, help="at most, in a round")
    parser.add_argument("--until", type=float, default=1.0, help="simulated seconds of the city")
    options = parser.parse_args()
    if why := bad_cable.missing():
        parser.error(why)
    first, last = map(int, options.seeds.split("..")) if options.seeds else (0, options.rounds)
    world = [WORLDS / "city.sdf", "--until", options.until, "--seed", 7]
    expected = embedded(*world, "--client", DRIVER)["state_hash"]
    quiet_s, found, _ = Round(0, options).run(world, {}, "none", 300)
    most_s = max(TIMES_MOST * quiet_s, AT_LEAST_S)
    print(f"undisturbed: {quiet_s:.1f} s, {found}; bound {most_s:.1f} s", flush=True)
    failures = 0 if found == expected else 1
    slowest = silent = 0.0
    for seed in range(first, last):
        this = Round(seed, options)
        words = f"{seed:3} {this.trouble:6} loss {this.network['loss']:.3f} repeat {this.network['repeat']:.3f} delay {1e3 * this.network['delay_s']:.1f} ms" \
                f"{' no fragments' if this.network['drops_fragments'] else ''}"
        try:
            took, found, lost = this.run(world, this.network, this.trouble, 3 * most_s)
            bad = [*(["another hash"] if found != expected else []), *(["too slow"] if took > most_s else []),
                   *(["a silent wait"] if this.silent_s > SILENT_MOST_S else [])]
            slowest, silent = max(slowest, took), max(silent, this.silent_s)
            print(f"{words}: {took:.1f} s, {lost} lost, {this.hits} hits, silent {this.silent_s:.1f} s {' '.join(bad) or 'good'}", flush=True)
            failures += bool(bad)
        except AssertionError as error:
            failures += 1
            print(f"{words}: {this.hits} hits, silent {this.silent_s:.1f} s, FAILED: {error}", flush=True)
    print(f"{last - first} rounds, {failures} failed; slowest {slowest:.1f} s ({slowest / quiet_s:.1f} times undisturbed), longest silence {silent:.1f} s")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
