"""Offsets of a recorded run that are fitted with the numbers of a world: when its clock began, where the robot stood."""
from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Optional, Sequence

import numpy as np

from ..errors import ArgumentError
from ..simulation import Simulation

SCALE = 0.1  # m, rad, s: a usual offset
_MOST_METRES, _MOST_TURN = 1.0, 1.0  # m, rad: of a start pose


@dataclass(frozen=True)
class Offset:
    """A number of one recorded run.

    Attributes:
        run: its place among the runs.
        kind: "time" (s: of the recording's clock when the orders begin), or of a robot's start "x", "y" (m, world axes) or
            "yaw" (rad), in addition to the pose of the file.
        robot: whose start it is.
        most: its bound, in both directions.
    """

    run: int
    kind: str
    robot: str
    most: float

    def name(self, run: str) -> str:
        """For tables; `run` is what the run is called."""
        return f"{self.kind} of {run}" if self.kind == "time" else f"{self.robot} {self.kind} of {run}"


def offsets_of(runs: int, robots: Sequence[str], time: Optional[float]) -> list[Offset]:
    """All offsets of all runs: start poses of these robots, and the time, if it has a bound (s)."""
    found = []
    for run in range(runs):
        if time is not None:
            found.append(Offset(run, "time", "", time))
        for robot in robots:
            found += [Offset(run, "x", robot, _MOST_METRES), Offset(run, "y", robot, _MOST_METRES),
                      Offset(run, "yaw", robot, _MOST_TURN)]
    return found


class Starts:
    """Where the robots of a world stand at its start.

    Raises:
        ArgumentError: the world has not such a robot, or it is fixed (code "no-free-robot").
    """

    def __init__(self, sim: Simulation, robots: Sequence[str]):
        self._poses = {}
        for robot in robots:
            if robot not in sim.world.robots or not sim.robots([robot])._facts.free_base:
                free = [name for name in sim.world.robots if sim.robots([name])._facts.free_base]
                raise ArgumentError(f"the world has no robot '{robot}' that can be put elsewhere",
                                    f"name one of {', '.join(free[:8])}" if free else "leave its start pose out", "no-free-robot")
            self._poses[robot] = sim.robots([robot]).pose[0].copy()

    def orders(self, shifts: Sequence[tuple[Offset, float]], others: Optional[str], folder: Path) -> Optional[str]:
        """A file of orders that put the robots where the offsets say, before those of another file."""
        moved: dict[str, dict[str, float]] = {}
        for offset, value in shifts:
            if offset.kind != "time":
                moved.setdefault(offset.robot, {})[offset.kind] = value
        if not moved:
            return others
        lines = [json.dumps({"t": 0, "robot": robot, "set_pose": self._moved(robot, by)}) for robot, by in moved.items()]
        text = Path(others).read_text(encoding="utf-8") if others else ""
        path = folder / "orders.jsonl"
        path.write_text("\n".join(lines) + "\n" + text, encoding="utf-8")
        return str(path)

    def _moved(self, robot: str, by: dict[str, float]) -> dict[str, list[float]]:
        x, y, z, *quat = self._poses[robot].tolist()
        turned = _turned(by["yaw"], quat)
        return {"position": [x + by["x"], y + by["y"], z], "orientation": [turned[3], *turned[:3]]}


def _turned(angle: float, quat_xyzw: Sequence[float]) -> list[float]:
    """An orientation, turned about the vertical of the world."""
    s, c = float(np.sin(angle / 2)), float(np.cos(angle / 2))
    x, y, z, w = quat_xyzw
    return [c * x - s * y, c * y + s * x, c * z + s * w, c * w - s * z]
