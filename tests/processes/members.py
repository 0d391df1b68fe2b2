"""Starts the processes of a run for tests, on the loopback interface, and ends them by their ids."""
import json
import os
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROBOSS, DRIVER, WORLDS = sys.argv[1], sys.argv[2], Path(sys.argv[3])
del sys.argv[1:4]
FOLDER = Path(tempfile.mkdtemp(prefix="roboss_test_"))


def as_fast_as_possible(arguments):
    """The option for it, unless a speed is given: with a viewer the default is real time."""
    return [] if "--speed" in arguments else ["--speed", "max"]


def free_port():
    """A TCP port of this computer that nobody uses now."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Member:
    """A process of the run; what it says goes to a file, so that nobody waits for a reader."""

    def __init__(self, *arguments, **how):
        self.log = tempfile.TemporaryFile(mode="w+", dir=FOLDER)
        self.process = subprocess.Popen([ROBOSS, *map(str, arguments)], stdout=self.log, stderr=subprocess.STDOUT, **how)

    def said(self):
        self.log.flush()
        return os.pread(self.log.fileno(), 1 << 20, 0).decode()

    def hears(self, words, count=1, timeout_s=20):
        """Waits until these words have been said so often; the time it took."""
        start = time.monotonic()
        while self.said().count(words) < count:
            if time.monotonic() - start > timeout_s or self.process.poll() is not None and self.said().count(words) < count:
                raise AssertionError(f"'{words}' was not said {count} times:\n{self.said()}")
            time.sleep(0.01)
        return time.monotonic() - start

    def end(self, timeout_s=60):
        """Its exit code, when it has ended by itself."""
        try:
            return self.process.wait(timeout=timeout_s)
        except subprocess.TimeoutExpired:
            raise AssertionError(f"it does not end:\n{self.said()}") from None

    def kill_only(self):
        """Kills it; what it said is still there."""
        self.process.kill()
        self.process.wait()

    def kill(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.log.close()


class Cluster:
    """Members of one run, by a name of its own; all are gone when the block ends."""

    serial = 0

    def __init__(self):
        Cluster.serial += 1
        self.name = f"test-{os.getpid()}-{Cluster.serial}"
        self.port = free_port()
        self.json = FOLDER / f"{self.name}.json"
        self.members = []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for member in self.members:
            member.kill()

    def start(self, *arguments, **how):
        where = ["--port", self.port] if arguments[0] in ("controller", "run") else self.place
        self.members.append(Member(*arguments, "--simulation", self.name, *where, **how))
        return self.members[-1]

    @property
    def place(self):
        """The options by which members, and `control` like them, reach the Controller over the network."""
        return ["--controller", f"127.0.0.1:{self.port}"]

    def start_plain(self, *arguments):
        """A process that makes its own network."""
        self.members.append(Member(*arguments))
        return self.members[-1]

    def controller(self, *arguments, **how):
        return self.start("controller", *arguments, *as_fast_as_possible(arguments), "--json", self.json, **how)

    def simulator(self, *arguments, **how):
        return self.start("simulator", "--patience", 20, *arguments, **how)

    def summary(self, controller):
        code = controller.end()
        if code != 0:
            raise AssertionError(f"the controller ended with {code}:\n{controller.said()}")
        return json.loads(self.json.read_text())


def embedded(*arguments):
    """The summary of the same run in one process."""
    file = FOLDER / "embedded.json"
    done = subprocess.run([ROBOSS, "run", *map(str, [*arguments, *as_fast_as_possible(arguments)]), "--quiet", "--json", file], capture_output=True, text=True, timeout=300)
    if done.returncode != 0:
        raise AssertionError(f"roboss run {arguments} ended with {done.returncode}:\n{done.stderr}")
    return json.loads(file.read_text())
