"""What stand-ins for hardware share: a world of their own, stepped by a clock of their own, which drifts.

A stand-in plays a real robot for `roboss device`. It shares nothing with the control program but the line.
"""
import argparse
import json
import random
import signal
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from imports import needed  # noqa: E402

with needed():
    import roboss


def guarded(main):
    """Runs a stand-in; ends the process with 2 and a clear text where its input is wrong."""
    try:
        main()
    except (roboss.RobossError, OSError) as error:
        print(f"{Path(sys.argv[0]).stem}: {error}", file=sys.stderr)
        sys.exit(2)


def share(text):
    """Type of an option that takes a probability."""
    value = float(text)
    if not 0 <= value <= 1:
        raise argparse.ArgumentTypeError("give a share from 0 to 1")
    return value


class Hardware:
    """A simulated world that plays the real one, in real time by a clock that is `drift` too fast."""

    def __init__(self, world, drift=0.0, seed=1):
        self.simulation = roboss.Simulation(world, threads=1, seed=seed)
        self.drift, self.random = drift, random.Random(seed)
        self.start = time.monotonic()
        self.over = False
        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, lambda *_: setattr(self, "over", True))

    def clock(self):
        """s, by the stand-in's own clock."""
        return (time.monotonic() - self.start) * (1 + self.drift)

    def step(self):
        """Steps the world up to now; the ticks that passed. Late by more than 0.2 s, it lets time pass unsimulated."""
        behind = self.clock() - self.simulation.time
        if behind > 0.2:
            self.start += (behind - 0.2) / (1 + self.drift)
        ticks = max(0, round((self.clock() - self.simulation.time) / self.simulation.dt))
        self.simulation.step(ticks)
        return ticks

    def happens(self, share):
        """True with this probability."""
        return self.random.random() < share


class Diary:
    """What happened to a robot: how far it went, what it touched. The summary is the last line of the output."""

    def __init__(self, robot):
        self.robot, self.distance, self.touches = robot, 0.0, 0
        self.place = robot.pose[0, :2].copy()
        self.lowest, self.highest = robot.joint_position[0].copy(), robot.joint_position[0].copy()
        self.counts = {}

    def note(self):
        pose = self.robot.pose[0]
        self.distance += float(((pose[:2] - self.place) ** 2).sum() ** 0.5)
        self.place = pose[:2].copy()
        self.touches += bool(self.robot.touching[0])
        self.lowest = self.lowest.clip(max=self.robot.joint_position[0])
        self.highest = self.highest.clip(min=self.robot.joint_position[0])

    def count(self, what, by=1):
        self.counts[what] = self.counts.get(what, 0) + by

    def summary(self):
        pose = self.robot.pose[0]
        return {"distance_m": self.distance, "touches": self.touches, "pose": [float(x) for x in pose],
                "joint_position": self.robot.joint_position[0].tolist(),
                "lowest": self.lowest.tolist(), "highest": self.highest.tolist(),
                "joint_velocity": self.robot.joint_velocity[0].tolist(), **self.counts}


def say(**values):
    """One line of JSON on the output, at once."""
    print(json.dumps(values), flush=True)
