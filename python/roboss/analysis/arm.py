"""Analysis of an arm's recording by ISO 9283: commanded and attained poses over time, as figures for each condition.

The recording needs no marks. Where the commanded pose rests, the arm is at a test pose; between two rests it is on a
path. Equal poses and paths are taken together.
"""
from __future__ import annotations

from dataclasses import dataclass, field
from typing import Optional, Sequence

import numpy as np
from numpy.typing import NDArray

from ..errors import ArgumentError
from ..robots import Floats
from . import iso9283

_PLACES = 6  # decimals, m, to which commanded poses are the same
_PATH_POINTS = 50
_LEAST_CORNER, _REVERSAL = np.cos(np.radians([20, 175]))  # of the angle by which a commanded path turns
_SPAN = 1e-3  # m over which its directions are taken, so that rounded positions make no corners
_REST_SHARE = 0.2  # end of a rest over which the attained pose is averaged


@dataclass(frozen=True)
class PoseResult:
    """Figures of one test pose.

    Attributes:
        name: "P1" ..., in the order in which they first come.
        commanded: (7,).
        attained: (n, 7): at the end of each rest.
        score: AP and RP.
        settling_time: largest stabilisation time, s.
        overshoot: largest, m.
        drift: from the first visits to the last ones; None: too few visits.
    """

    name: str
    commanded: Floats
    attained: Floats
    score: iso9283.PoseScore
    settling_time: float
    overshoot: float
    drift: Optional[iso9283.PoseDrift] = None


@dataclass(frozen=True)
class CornerResult:
    """Figures of one corner of the commanded path that is passed without a rest: its place (m), runs, CR and CO (m)."""

    place: Floats
    runs: int
    round_off: float
    overshoot: float


@dataclass(frozen=True)
class PathResult:
    """Figures of one path: from pose to pose, runs, AT and RT in m, and the largest speed, m/s."""

    name: str
    runs: int
    accuracy: float
    repeatability: float
    speed: float


@dataclass(frozen=True)
class Condition:
    """Figures for one load and speed.

    Attributes:
        name: "load 2 kg, speed 100 %", or "" if the recording has one condition.
        poses, paths: figures of each.
        distances: (name, AD, RD) of pairs of poses, m.
        corners: figures of each corner.
        arrivals: (time, distances from the end) of the first arrival at each pose, for pictures: s, m.
    """

    name: str
    poses: list[PoseResult]
    paths: list[PathResult]
    distances: list[tuple[str, float, float]]
    corners: list[CornerResult] = field(default_factory=list)
    arrivals: dict[str, tuple[Floats, Floats]] = field(default_factory=dict)


@dataclass(frozen=True)
class _Rest:
    begin: int
    end: int
    pose: int  # number of the test pose


def analyse_arm(time: Floats, measured: Floats, commanded: Floats, *, name: str = "", band: Optional[float] = None,
                least_rest: float = 0.1, drift_visits: int = 10) -> Condition:
    """Figures of one recording.

    Args:
        time: (T,), s.
        measured, commanded: (T, 7): x y z in m, quaternion x y z w, in the same frame.
        name: of the condition.
        band: limit band of stabilisation and overshoot, m; None: the repeatability at the pose, at least 0.1 mm.
        least_rest: shortest rest of the commanded pose that makes it a test pose, s.
        drift_visits: how many visits to a pose at the begin, and how many at the end, are compared for its drift.

    Raises:
        ArgumentError: no pose is visited twice (code "too-few-cycles").
    """
    commanded = _continuous(commanded)
    rests, targets = _rests(time, commanded, least_rest)
    visits = [[rest for rest in rests if rest.pose == number] for number in range(len(targets))]
    poses, arrivals = [], {}
    for number, some in enumerate(visits):
        if len(some) < 2:
            continue
        attained = np.array([_attained(measured, rest) for rest in some])
        score = iso9283.pose_score(attained, targets[number])
        limit = max(1e-4, score.repeatability) if band is None else band
        settled = [iso9283.settling(time[r.begin:r.end], measured[r.begin:r.end, :3], pose[:3], limit)
                   for r, pose in zip(some, attained)]
        poses.append(PoseResult(f"P{number + 1}", targets[number], attained, score, max(s for s, _ in settled),
                                max(o for _, o in settled), _drift(attained, targets[number], drift_visits)))
        rest = some[-1]
        arrivals[poses[-1].name] = (time[rest.begin:rest.end] - time[rest.begin],
                                    np.linalg.norm(measured[rest.begin:rest.end, :3] - attained[-1, :3], axis=1))
    if not poses:
        raise ArgumentError(f"{len(rests)} rests of the commanded pose, and no pose is visited twice",
                            f"record several cycles that rest for {least_rest} s or more at each pose", "too-few-cycles")
    return Condition(name, poses, _paths(time, measured, commanded, rests), _distances(poses),
                     _corners(measured, commanded, rests), arrivals)


def exchangeability(conditions: Sequence[Condition]) -> list[tuple[str, float]]:
    """E at each test pose that all arms were commanded to, m: conditions are recordings of several arms of one type.

    Raises:
        ArgumentError: there are no two arms, or they have no pose in common (code "no-common-pose").
    """
    found = []
    for pose in conditions[0].poses:
        same = [[other for other in condition.poses if _same(other.commanded, pose.commanded)] for condition in conditions]
        if len(conditions) > 1 and all(same):
            means = np.array([some[0].attained[:, :3].mean(axis=0) for some in same])
            found.append((pose.name, iso9283.exchangeability(means)))
    if not found:
        raise ArgumentError(f"{len(conditions)} recordings without a commanded pose that all of them have",
                            "record the same program with each arm, in the same frame", "no-common-pose")
    return found


def _drift(attained: Floats, commanded: Floats, visits: int) -> Optional[iso9283.PoseDrift]:
    """Between the first and the last visits, if there are as many."""
    if visits < 2 or len(attained) < 2 * visits:
        return None
    return iso9283.pose_drift(attained[:visits], attained[-visits:], commanded)


def _corners(measured: Floats, commanded: Floats, rests: list[_Rest]) -> list[CornerResult]:
    """Figures of the corners of the commanded paths between rests; the worst of their runs."""
    runs: dict[tuple, list[tuple[float, float]]] = {}
    for before, after in zip(rests[:-1], rests[1:]):
        path = commanded[before.end - 1:after.begin + 1, :3]
        turns, before_turn, behind = _turns(path)
        ends = path[np.concatenate([[0], turns, [len(path) - 1]])]
        for number, (k, first, second) in enumerate(zip(turns, before_turn, behind)):
            if first @ second < _REVERSAL:
                continue  # it goes back on its line
            reach = min(np.linalg.norm(ends[number] - path[k]), np.linalg.norm(ends[number + 2] - path[k])) / 2
            near = _within(measured[before.end - 1:after.end, :3], path[k], reach)
            key = tuple(np.round([*path[k], *first, *second], _PLACES - 2) + 0.0)
            runs.setdefault(key, []).append(iso9283.cornering(near, path[k], first, second))
    return [CornerResult(np.array(key[:3]), len(some), *(max(column) for column in zip(*some))) for key, some in runs.items()]


def _turns(path: Floats) -> tuple[NDArray[np.int_], Floats, Floats]:
    """Points (n,) at which a path turns, and the directions before and behind them, (n, 3).

    Directions are taken over _SPAN, so all points that are nearer to a corner see a part of the turn. Of turns that are
    nearer to each other than twice that, only the sharpest counts: it is the corner.
    """
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    inner = np.flatnonzero((length >= _SPAN) & (length <= length[-1] - _SPAN))
    first = np.searchsorted(length, length[inner] - _SPAN, side="right") - 1
    last = np.minimum(np.searchsorted(length, length[inner] + _SPAN), len(path) - 1)
    before, behind = _units(path[inner] - path[first]), _units(path[last] - path[inner])
    cosine = np.sum(before * behind, axis=1)
    found: list[int] = []
    for n in np.flatnonzero(cosine < _LEAST_CORNER):
        if not found or length[inner[n]] - length[inner[found[-1]]] >= 2 * _SPAN:
            found.append(n)
        elif cosine[n] < cosine[found[-1]]:
            found[-1] = n
    return inner[found], before[found], behind[found]


def _units(vectors: Floats) -> Floats:
    """Unit vectors; 0 stays 0."""
    return vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-12)


def _within(attained: Floats, corner: Floats, reach: float) -> Floats:
    """Those points of an attained path that are within a distance from a corner; at least the nearest one."""
    distances = np.linalg.norm(attained - corner, axis=1)
    return attained[distances <= max(reach, distances.min())]


def _rests(time: Floats, commanded: Floats, least: float) -> tuple[list[_Rest], list[Floats]]:
    """Where the commanded pose rests, and the different poses."""
    moves = np.any(np.abs(np.diff(commanded, axis=0)) > 1e-12, axis=1)
    edges = np.flatnonzero(np.diff(np.concatenate([[True], moves, [True]]).astype(int)))
    rests: list[_Rest] = []
    targets: list[Floats] = []
    for begin, end in zip(edges[::2], edges[1::2]):
        if time[end] - time[begin] < least:
            continue
        number = next((n for n, target in enumerate(targets) if _same(target, commanded[begin])), len(targets))
        if number == len(targets):
            targets.append(commanded[begin])
        rests.append(_Rest(int(begin), int(end) + 1, number))
    return rests, targets


def _continuous(poses: Floats) -> Floats:
    """The same poses, with signs of their quaternions that do not jump."""
    jumps = np.sum(poses[1:, 3:] * poses[:-1, 3:], axis=1) < 0
    signs = np.where(np.cumsum(np.concatenate([[False], jumps])) % 2, -1.0, 1.0)
    return np.column_stack([poses[:, :3], signs[:, None] * poses[:, 3:]])


def _same(one: Floats, other: Floats) -> bool:
    """Whether two poses are the same; the quaternions q and -q are one rotation."""
    sign = -1.0 if one[3:] @ other[3:] < 0 else 1.0
    return bool(np.allclose(one, [*other[:3], *(sign * other[3:])], rtol=0, atol=10.0**-_PLACES))


def _attained(measured: Floats, rest: _Rest) -> Floats:
    """The mean pose at the end of a rest."""
    last = measured[rest.end - max(1, int(_REST_SHARE * (rest.end - rest.begin))):rest.end]
    turns = np.where((last[:, 3:] @ last[-1, 3:])[:, None] < 0, -last[:, 3:], last[:, 3:])
    turn = turns.mean(axis=0)
    return np.concatenate([last[:, :3].mean(axis=0), turn / np.linalg.norm(turn)])


def _paths(time: Floats, measured: Floats, commanded: Floats, rests: list[_Rest]) -> list[PathResult]:
    """Figures of the straight paths between poses that are run twice or more."""
    runs: dict[tuple[int, int], list[slice]] = {}
    for before, after in zip(rests[:-1], rests[1:]):
        if before.pose != after.pose:
            runs.setdefault((before.pose, after.pose), []).append(slice(before.end - 1, after.begin + 1))
    results = []
    for (first, second), some in runs.items():
        if len(some) < 2:
            continue
        points = _along(commanded[some[0], :3])
        crossings = np.array([iso9283.path_crossings(measured[part.start:_later(part, rests), :3], points) for part in some])
        if np.isnan(crossings[:, :, 0]).any(axis=0).all():
            continue
        accuracy, repeatability = iso9283.path_score(crossings, points)
        speed = np.linalg.norm(np.gradient(measured[some[0], :3], time[some[0]], axis=0), axis=1).max()
        results.append(PathResult(f"P{first + 1} to P{second + 1}", len(some), accuracy, repeatability, float(speed)))
    return results


def _later(part: slice, rests: list[_Rest]) -> int:
    """End of the rest that follows a path: the arm arrives after its command does."""
    return next(rest.end for rest in rests if rest.begin >= part.stop - 1)


def _along(path: Floats) -> Floats:
    """Points at equal distances along a commanded path, without its ends, (_PATH_POINTS, 3)."""
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    keep = np.concatenate([[True], np.diff(length) > 0])
    at = np.linspace(0.05, 0.95, _PATH_POINTS) * length[-1]
    return np.column_stack([np.interp(at, length[keep], path[keep, axis]) for axis in range(3)])


def _distances(poses: list[PoseResult]) -> list[tuple[str, float, float]]:
    """AD and RD between P2 and P4, as the standard wants it, or else between the first two poses."""
    by_name = {pose.name: pose for pose in poses}
    pair = ("P2", "P4") if "P2" in by_name and "P4" in by_name else tuple(list(by_name)[:2])
    if len(pair) < 2:
        return []
    first, second = (by_name[name] for name in pair)
    n = min(len(first.attained), len(second.attained))
    accuracy, repeatability = iso9283.distance_score(first.attained[:n, :3], second.attained[:n, :3], first.commanded[:3],
                                                     second.commanded[:3])
    return [(f"{pair[0]} to {pair[1]}", accuracy, repeatability)]
