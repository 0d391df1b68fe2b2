"""Hosts of a test: network namespaces on one switch, whose cables lose, repeat and delay packets, by seed. Needs root, ip(8) and
/dev/net/tun; all of it is gone when the block ends."""
import fcntl
import heapq
import os
import random
import select
import struct
import subprocess
import threading
import time

TUNSETIFF, IFF_TAP, IFF_NO_PI = 0x400454CA, 0x0002, 0x1000
FRAME_MOST = 1 << 16


def missing():
    """Why namespaces cannot be had here; nothing if they can."""
    if os.geteuid() != 0:
        return "only root can make network namespaces"
    if not os.access("/dev/net/tun", os.R_OK | os.W_OK):
        return "there is no /dev/net/tun"
    probe = f"rbs{os.getpid()}p"
    try:
        if subprocess.run(["ip", "netns", "add", probe], capture_output=True).returncode != 0:
            return "ip netns add is refused"
        subprocess.run(["ip", "netns", "del", probe], capture_output=True)
    except FileNotFoundError:
        return "there is no ip(8)"
    return None


def is_fragment(frame):
    """True if the frame holds a fragment of an IPv4 packet."""
    return frame[12:14] == b"\x08\x00" and int.from_bytes(frame[20:22], "big") & 0x3FFF != 0


def ip(*words):
    subprocess.run(["ip", *map(str, words)], check=True, capture_output=True, text=True)


class Hosts:
    """So many hosts 10.77.0.1, 10.77.0.2 ..., named by name(i)."""

    def __init__(self, count, loss=0.0, repeat=0.0, delay_s=0.0, drops_fragments=False, seed=1):
        self.count, self.loss, self.repeat, self.delay_s, self.drops_fragments = count, loss, repeat, delay_s, drops_fragments
        self.chance = random.Random(seed)
        self.taps, self.passed, self.lost = [], 0, 0
        self.done = threading.Event()

    def name(self, i):
        return f"rbs{os.getpid()}n{i}"

    def address(self, i):
        return f"10.77.0.{i + 1}"

    def inside(self, i):
        """What comes before a command that is to run on host i."""
        return ["ip", "netns", "exec", self.name(i)]

    def __enter__(self):
        for i in range(self.count):
            tap, host = f"rbs{os.getpid() % 10000}t{i}", self.name(i)
            fd = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
            fcntl.ioctl(fd, TUNSETIFF, struct.pack("16sH", tap.encode(), IFF_TAP | IFF_NO_PI))
            self.taps.append(fd)
            ip("netns", "add", host)
            ip("link", "set", tap, "netns", host, "name", "eth0")
            ip("-n", host, "addr", "add", f"{self.address(i)}/24", "dev", "eth0")
            ip("-n", host, "link", "set", "lo", "up")
            ip("-n", host, "link", "set", "eth0", "up")
        self.thread = threading.Thread(target=self.switch, daemon=True)
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.done.set()
        self.thread.join()
        for fd in self.taps:
            os.close(fd)
        for i in range(self.count):
            subprocess.run(["ip", "netns", "del", self.name(i)], capture_output=True)

    def switch(self):
        """Every frame goes to all others, each copy late and perhaps not at all."""
        under_way, serial = [], 0
        while not self.done.is_set():
            wait = max(0.0, under_way[0][0] - time.monotonic()) if under_way else 0.05
            for fd in select.select(self.taps, [], [], min(wait, 0.05))[0]:
                while frame := self.read(fd):
                    for other in self.taps:
                        if other == fd:
                            continue
                        self.passed += 1
                        if self.chance.random() < self.loss or self.drops_fragments and is_fragment(frame):
                            self.lost += 1
                            continue
                        for _ in range(2 if self.chance.random() < self.repeat else 1):
                            serial += 1
                            heapq.heappush(under_way, (time.monotonic() + self.delay_s, serial, other, frame))
            while under_way and under_way[0][0] <= time.monotonic():
                _, _, to, frame = heapq.heappop(under_way)
                try:
                    os.write(to, frame)
                except OSError:
                    pass  # that host is not up yet, or its buffer is full: lost

    @staticmethod
    def read(fd):
        try:
            return os.read(fd, FRAME_MOST)
        except (BlockingIOError, OSError):
            return None
