"""A run over hosts of their own (network namespaces) and a network that loses some packets and takes five milliseconds: the
same state hash as in one process. `roboss cluster` makes keys, and starts, shows and ends such a run."""
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import bad_cable
from members import DRIVER, FOLDER, ROBOSS, WORLDS, Member, embedded  # takes its own arguments

CITY = [WORLDS / "city.sdf", "--until", 0.4, "--seed", 7]
PILE = [WORLDS / "pile.sdf", "--until", 2.0]


class HostMember(Member):
    """A member of the run on one of the hosts."""

    def __init__(self, hosts, host, *arguments):
        self.log = tempfile.TemporaryFile(mode="w+", dir=FOLDER)
        self.process = subprocess.Popen([*hosts.inside(host), ROBOSS, *map(str, arguments)], stdout=self.log, stderr=subprocess.STDOUT)


@unittest.skipIf(bad_cable.missing(), bad_cable.missing())
class Network(unittest.TestCase):
    def place(self, hosts, host, role):
        """Network options: the Controller is on host 0. Members find its keys by its name, since all are one computer's."""
        return ["--simulation", "net", *(["--interface", hosts.address(host)] if role == "controller" else ["--controller", hosts.address(0)])]

    def run_on(self, hosts, members):
        """The summary of a run whose Controller is on host 0."""
        summary = FOLDER / f"network-{time.monotonic_ns()}.json"
        started = []
        try:
            for host, *arguments in members:
                more = ["--json", summary] if arguments[0] == "controller" else []
                started.append(HostMember(hosts, host, *arguments, *more, *self.place(hosts, host, arguments[0])))
            code = started[0].end(150)
            self.assertEqual(code, 0, started[0].said())
            for member in started[1:]:
                member.end(20)
            return json.loads(summary.read_text())
        finally:
            for member in started:
                member.kill()

    def city(self, hosts):
        return self.run_on(hosts, [
            (0, "controller", *CITY, "--simulators", 2, "--await-client", "driver"),
            (1, "simulator", "--patience", 60), (2, "simulator", "--patience", 60), (2, "client", DRIVER, "--name", "driver", "--patience", 60)])

    def test_a_bad_network_changes_no_bit(self):
        expected = embedded(*CITY, "--client", DRIVER)["state_hash"]
        for loss in (0.01, 0.05):
            with self.subTest(loss=loss), bad_cable.Hosts(3, loss=loss, delay_s=0.005, seed=3) as hosts:
                self.assertEqual(self.city(hosts)["state_hash"], expected)
                self.assertGreater(hosts.lost, 20, "the network lost nothing")

    def test_a_simulator_cut_off_by_its_host_is_done_without_and_comes_back(self):
        world = [WORLDS / "pile.sdf", "--until", 3.0]
        expected = embedded(*world)["state_hash"]
        with bad_cable.Hosts(3, loss=0.01, delay_s=0.002, seed=4) as hosts:
            summary = FOLDER / "cut.json"
            controller = HostMember(hosts, 0, "controller", *world, "--simulators", 2, "--speed", 0.25, "--json", summary, *self.place(hosts, 0, "controller"))
            simulators = [HostMember(hosts, i, "simulator", "--patience", 30, *self.place(hosts, i, "simulator")) for i in (1, 2)]
            try:
                controller.hears("joined", 2)
                time.sleep(1.0)
                bad_cable.ip("-n", hosts.name(2), "link", "set", "eth0", "down")
                controller.hears("given up", 1, 5)
                simulators[1].hears("[reconnecting]")
                bad_cable.ip("-n", hosts.name(2), "link", "set", "eth0", "up")
                controller.hears("joined", 3)
                self.assertEqual(controller.end(100), 0, controller.said())
                told = json.loads(summary.read_text())
                self.assertEqual(told["state_hash"], expected)
                for simulator in simulators:
                    self.assertEqual(simulator.end(20), 0, simulator.said())
            finally:
                for member in [controller, *simulators]:
                    member.kill()

    def cluster(self, action, file, code=0):
        done = subprocess.run([ROBOSS, "cluster", *action, file], capture_output=True, text=True, timeout=100)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def test_the_cluster_command_starts_shows_and_ends_a_run_on_many_hosts(self):
        with bad_cable.Hosts(3) as hosts:
            file = FOLDER / "hosts.toml"
            file.write_text(f"""
simulation = "cluster-test"
program = "{ROBOSS}"
reach = ["ip", "netns", "exec", "{{host}}", "sh", "-s"]
[controller]
host = "{hosts.name(0)}"
world = "{WORLDS / 'pile.sdf'}"
interface = "{hosts.address(0)}"
options = ["--simulators", "3", "--speed", "0.5", "--headless"]
address = "{hosts.address(0)}"
[[simulators]]
host = "{hosts.name(1)}"
count = 2
[[simulators]]
host = "{hosts.name(2)}"
threads = 2
""")
            said = self.cluster(["up"], file)
            try:
                self.assertEqual(said.count("process "), 4, said)
                self.assertIn("[already-running]", self.cluster(["up"], file, 3))
                end = time.monotonic() + 30
                while time.monotonic() < end:
                    told = json.loads(subprocess.run([*hosts.inside(0), ROBOSS, "cluster", "status", "--json", file], capture_output=True, text=True).stdout or "{}")
                    if told.get("tick", 0) > 50:
                        break
                    time.sleep(0.3)
                # on a busy machine one may have been missed for a moment, and be back with another number
                self.assertEqual(sorted(m["threads"] for m in told["members"] if m["state"] == "active"), [1, 1, 2], told)
                self.assertTrue(all(p["runs"] for p in told["processes"]))
                self.cluster(["status"], file)
            finally:
                self.assertIn('"ended": 4', self.cluster(["down", "--json"], file))
            self.assertIn("[not-started]", self.cluster(["down"], file, 1))


class ClusterFile(unittest.TestCase):
    def refused(self, code, text):
        file = FOLDER / "wrong.toml"
        file.write_text(text)
        done = subprocess.run([ROBOSS, "cluster", "up", file], capture_output=True, text=True, timeout=30)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn(f"[{code}]", done.stderr)
        return done.stderr

    def test_a_wrong_file_is_refused_with_line_and_remedy(self):
        good = '[controller]\nworld = "a.sdf"\n'
        self.assertIn("wrong.toml:3: ", self.refused("unknown-key", good + 'wrld = "b.sdf"\n'))
        self.refused("no-controller", 'simulation = "x"\n')
        self.refused("no-world", '[controller]\nhost = "a"\n')
        self.assertIn("wrong.toml:4: ", self.refused("wrong-type", good + '[[simulators]]\ncount = "two"\n'))
        self.refused("no-program", good + '[[clients]]\nhost = "a"\n')
        self.assertIn("wrong.toml:1:", self.refused("bad-toml", "= 3\n"))

    def test_a_process_that_does_not_start_is_named(self):
        file = FOLDER / "absent.toml"
        file.write_text('program = "/nowhere/roboss"\n[controller]\nworld = "a.sdf"\n')
        done = subprocess.run([ROBOSS, "cluster", "up", file], capture_output=True, text=True, timeout=30)
        self.assertEqual(done.returncode, 3)
        self.assertIn("[no-program]", done.stderr)
        file.write_text('program = "absent-roboss"\n[controller]\nworld = "a.sdf"\n')
        done = subprocess.run([ROBOSS, "cluster", "up", file], capture_output=True, text=True, timeout=30)
        self.assertIn("[no-program]", done.stderr)


STAND_IN = """import os, signal, sys, time
if "status" in sys.argv:
    sys.exit(print('{"members": [], "robots": []}'))
over = os.path.join(os.path.dirname(sys.argv[0]), "over")
signal.signal(signal.SIGINT, lambda *_: sys.exit(open(over, "w").close()))  # the Controller dismisses all
while not os.path.exists(over):
    time.sleep(0.1)
"""


class Reach(unittest.TestCase):
    """Shells on hosts as ssh gives them: with greetings, one at a time, and not always."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(dir=FOLDER))
        self.program = self.folder / "stands for roboss"
        self.program.write_text(f"#!{sys.executable}\n" + STAND_IN)
        self.program.chmod(0o755)
        self.way = self.folder / "way"
        self.way.touch()
        reach = f"[ -e '{self.way}' ] || {{ echo no way; exit 255; }}; mkdir '{self.folder}/shell-on-'$0 || exit 255; echo be welcome; sh -s; code=$?; rmdir '{self.folder}/shell-on-'$0; exit $code"
        self.file = self.folder / "hosts.toml"
        self.file.write_text(f"simulation = 'reach-{os.getpid()}'\nprogram = {json.dumps(str(self.program))}\nreach = ['sh', '-c', {json.dumps(reach)}, '{{host}}']\n"
                             "[controller]\nhost = 'one'\nworld = 'a b.sdf'\n[[simulators]]\nhost = 'two'\ncount = 12\n")

    def cluster(self, action, code):
        done = subprocess.run([ROBOSS, "cluster", action, self.file], capture_output=True, text=True, timeout=100, env={**os.environ, "HOME": str(self.folder)})
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stderr + done.stdout

    def test_one_shell_a_host_and_a_host_that_is_away_is_not_taken_for_ended(self):
        self.assertEqual(self.cluster("up", 0).count("process "), 13)
        ids = [process["pid"] for process in json.loads(Path(f"{self.file}.running").read_text())["processes"]]
        try:
            os.kill(ids[3], signal.SIGKILL)
            said = self.cluster("status", 0)
            self.assertEqual(said.count("[process-ended]"), 1, said)
            self.way.unlink()
            self.assertIn("two does not answer: no way [no-answer]", self.cluster("up", 3))
            said = self.cluster("down", 3)
            self.assertEqual(said.count("[may-run]"), 13, said)
        finally:
            self.way.touch()
            self.cluster("down", 0)
        self.assertFalse(Path(f"{self.file}.running").exists())
        for i in ids:
            self.assertFalse(Path(f"/proc/{i}/cmdline").exists() and Path(f"/proc/{i}/cmdline").read_bytes(), "it runs on")

    def test_logs_are_for_their_owner_alone(self):
        logs = self.folder / ".roboss" / "logs"
        logs.mkdir(parents=True)
        old = logs / f"reach-{os.getpid()}-controller.log"
        old.write_text("of an earlier run")
        old.chmod(0o644)
        self.cluster("up", 0)
        try:
            modes = {log.name: oct(log.stat().st_mode & 0o777) for log in logs.iterdir()}
            self.assertEqual(len(modes), 13, modes)
            self.assertEqual(set(modes.values()), {"0o600"}, modes)
            self.assertNotIn("earlier", old.read_text())
        finally:
            self.cluster("down", 0)


if __name__ == "__main__":
    unittest.main()
