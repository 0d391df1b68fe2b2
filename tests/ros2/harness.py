"""Processes and a network of their own for tests with nodes of ROS 2."""
import os
import queue
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

PATIENCE = 20  # s
# Fast DDS 2.9.1 ends its process when it gets this: a flaw in the reading of discovery.
BAD_DATAGRAM = b"RTPS\x02\x03\x01\x0f" + bytes(12) + b"\x80\x01\x38\x00" + bytes(57)
# The configuration that rmw_cyclonedds gives to Cyclone DDS where discovery reaches this host alone.
CYCLONE_OF_HOST = """<CycloneDDS><Domain><General><AllowMulticast>false</AllowMulticast></General><Discovery>
<ParticipantIndex>auto</ParticipantIndex><Peers><Peer address="localhost"/></Peers><MaxAutoParticipantIndex>32
</MaxAutoParticipantIndex></Discovery></Domain></CycloneDDS>"""


def children_of(pid, word=""):
    """Ids of the processes that this one started; with a word, of those that have it on their command line."""
    children = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    return [int(child) for child in children if not word or word.encode() in Path(f"/proc/{child}/cmdline").read_bytes().split(b"\0")]


class Process:
    """A process whose lines of output arrive in a queue."""

    def __init__(self, words, environment=None):
        self.process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1,
                                        env={**os.environ, **(environment or {})})
        self.lines = queue.Queue()
        self.seen = []
        threading.Thread(target=self.read, daemon=True).start()

    def read(self):
        for line in self.process.stdout:
            self.lines.put(line.strip())

    def send(self, line):
        self.process.stdin.write(line + "\n")

    def wait_for(self, start, seconds=PATIENCE):
        """The rest of the next line that starts so; None: there is none in this time."""
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            try:
                line = self.lines.get(timeout=left)
            except queue.Empty:
                break
            self.seen.append(line)
            if line.startswith(start):
                return line[len(start):].strip()
        return None

    def ask(self, line):
        """The answer to a line, which begins with the same word."""
        self.send(line)
        return self.wait_for(line.split()[0])

    def forget(self):
        while not self.lines.empty():
            self.lines.get()

    def end(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGCONT)
            try:
                self.send("quit")
                self.process.wait(timeout=PATIENCE)
            except (OSError, subprocess.TimeoutExpired):
                self.process.kill()
        return self.process.wait()


def python_of(folder):
    """The Python of a client's environment (tools/ros2_clients.sh), and the variables that it needs."""
    return folder / "bin/python", {"LD_LIBRARY_PATH": f"{folder}/lib", "AMENT_PREFIX_PATH": str(folder),
                                   "RMW_IMPLEMENTATION": "rmw_fastrtps_cpp", "ROS_LOG_DIR": "/dev/shm"}


def cannot(why):
    print(f"not tried: {why}", file=sys.stderr)
    sys.exit(77)


def enter_own_network(folder):
    """Starts this program again in a network that has only this host. `folder`: of the client that it needs."""
    if not (folder / "stamp").is_file():
        cannot(f"no {folder} (tools/ros2_clients.sh {folder.parent})")
    if os.environ.get("ROBOSS_OWN_NETWORK") == "1":
        return
    words = ["unshare", *(["-r"] if os.getuid() else []), "-n", "-m", "sh", "-c",
             'ip link set lo up && ip link set lo multicast on && mount -t tmpfs none /dev/shm && exec "$@"', "sh"]
    if subprocess.run([*words, "true"], capture_output=True, check=False).returncode:
        cannot("unshare cannot make a network here (it needs root or user namespaces, and iproute2)")
    os.environ["ROBOSS_OWN_NETWORK"] = "1"
    os.execvp(words[0], [*words, sys.executable, "-B", *sys.argv])
