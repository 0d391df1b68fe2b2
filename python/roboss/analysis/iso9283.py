"""Performance criteria of manipulating robots by ISO 9283:1998, as functions of arrays.

Positions are in m, orientations unit quaternions x y z w, times in s; results in the same units. The number of the
clause is in each docstring. Spreads are three times the sample standard deviation (n - 1), as the standard wants it.
"""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import ArgumentError
from ..robots import Floats


@dataclass(frozen=True)
class PoseScore:
    """Accuracy and repeatability at one commanded pose.

    Attributes:
        accuracy: AP, m: distance from the commanded position to the mean of those attained.
        accuracy_xyz: (3,), m: its components.
        repeatability: RP, m: mean distance from the mean, and three standard deviations of it.
        accuracy_abc: (3,), rad: mean rotation away from the commanded orientation, about x y z of the base.
        repeatability_abc: (3,), rad: three standard deviations of it.
    """

    accuracy: float
    accuracy_xyz: Floats
    repeatability: float
    accuracy_abc: Floats
    repeatability_abc: Floats


def pose_score(attained: Floats, commanded: Floats) -> PoseScore:
    """AP (7.2.1) and RP (7.2.2) of n attained poses (n, 7) for one commanded pose (7,).

    The standard compares angles of rotation; here they are the components of the rotation vector from the commanded to
    the attained orientation, which are the same for small errors.
    """
    _need("attained poses", attained, 7, 2)
    mean = attained[:, :3].mean(axis=0)
    turns = rotation_vectors(commanded[3:], attained[:, 3:])
    error = mean - commanded[:3]
    return PoseScore(float(np.linalg.norm(error)), error, position_repeatability(attained[:, :3]), turns.mean(axis=0),
                     3 * turns.std(axis=0, ddof=1))


def position_repeatability(positions: Floats) -> float:
    """RP (7.2.2) of n positions (n, 3): mean(l) + 3 S(l), with l the distances from their mean, m."""
    _need("positions", positions, 3, 2)
    distances = np.linalg.norm(positions - positions.mean(axis=0), axis=1)
    return float(distances.mean() + 3 * distances.std(ddof=1))


def distance_score(first: Floats, second: Floats, commanded_first: Floats, commanded_second: Floats) -> tuple[float, float]:
    """Distance accuracy AD (7.3.2) and repeatability RD (7.3.3), m, of n pairs of attained positions (n, 3) each.

    AD is the mean distance less the commanded one, RD three standard deviations of the distances.
    """
    _need("first positions", first, 3, 2)
    distances = np.linalg.norm(second - first, axis=1)
    wanted = np.linalg.norm(np.asarray(commanded_second) - commanded_first)
    return float(distances.mean() - wanted), float(3 * distances.std(ddof=1))


def direction_variation(barycentres: Floats) -> float:
    """Multi-directional pose accuracy variation vAP (7.2.3): the largest distance between the mean positions (k, 3) that
    were attained from k directions, m."""
    _need("barycentres", barycentres, 3, 2)
    return float(np.linalg.norm(barycentres[:, None] - barycentres[None], axis=2).max())


@dataclass(frozen=True)
class PoseDrift:
    """Drift of pose characteristics between two sets of visits to a pose, at the begin and at the end of a time.

    Attributes:
        accuracy: dAP, m: how much AP changed.
        repeatability: dRP, m: how much RP changed.
        accuracy_abc, repeatability_abc: (3,), rad: how much AP abc and RP abc changed.
        moved: m: distance between the two mean positions, which AP may hide. Not a figure of the standard.
    """

    accuracy: float
    repeatability: float
    accuracy_abc: Floats
    repeatability_abc: Floats
    moved: float


def pose_drift(first: Floats, last: Floats, commanded: Floats) -> PoseDrift:
    """dAP and dRP (7.6): |AP(T) - AP(0)| and |RP(T) - RP(0)| of attained poses (n, 7) at the begin and at the end, for one
    commanded pose (7,). The standard takes ten visits for each, over eight hours."""
    begin, end = pose_score(first, commanded), pose_score(last, commanded)
    return PoseDrift(abs(end.accuracy - begin.accuracy), abs(end.repeatability - begin.repeatability),
                     np.abs(end.accuracy_abc - begin.accuracy_abc), np.abs(end.repeatability_abc - begin.repeatability_abc),
                     float(np.linalg.norm(end.accuracy_xyz - begin.accuracy_xyz)))


def exchangeability(barycentres: Floats) -> float:
    """Exchangeability E (7.7): the largest distance between the mean positions (k, 3) that k robots of the same type attained
    at one commanded pose, with the same program and mounting, m. The standard takes five robots."""
    return direction_variation(barycentres)


def cornering(path: Floats, corner: Floats, before: Floats, after: Floats) -> tuple[float, float]:
    """Cornering round-off error CR and overshoot CO (8.5) of one run along a path with a corner, m.

    Args:
        path: (T, 3), m: attained, from the straight line before the corner to that behind it.
        corner: (3,), m.
        before, after: (3,): commanded directions on the lines before and behind the corner, of any length.

    CR is the least distance of the path from the corner. CO is the largest distance from the second line of those points that
    are beyond it, as seen from the first line; 0 if none is. With the unit vector z along the second line, and y the part of
    the first direction that is normal to it, p is beyond if (p - corner) . y > 0. The standard takes the worst of three runs.

    Raises:
        ArgumentError: the directions are parallel (code "no-corner").
    """
    _need("points of a path", path, 3, 1)
    z = np.asarray(after, dtype=float) / np.linalg.norm(after)
    y = np.asarray(before, dtype=float) / np.linalg.norm(before)
    y -= (y @ z) * z
    if not np.linalg.norm(y) > 1e-9:
        raise ArgumentError("a corner between parallel lines", "give the directions of two lines that meet at an angle",
                            "no-corner")
    offset = path - corner
    beyond = offset[offset @ y > 0]
    across = beyond - np.outer(beyond @ z, z)
    return float(np.linalg.norm(offset, axis=1).min()), float(np.linalg.norm(across, axis=1).max(initial=0.0))


def settling(time: Floats, position: Floats, final: Floats, band: float) -> tuple[float, float]:
    """Pose stabilisation time (7.4), s, and overshoot (7.5), m, of one arrival.

    Args:
        time: (T,), s.
        position: (T, 3), m: from before the arrival until it is at rest.
        final: (3,), m: where it comes to rest.
        band: limit band: a distance from `final`, m. By the standard it is the repeatability, or what is agreed.

    The time is that from the first entry into the band to the last one. The overshoot is the largest distance from
    `final` after the first entry; 0 where the band is never left again.
    """
    distance = np.linalg.norm(position - final, axis=1)
    inside = distance <= band
    if not inside.any() or not inside[-1]:
        return float("nan"), float("nan")  # it does not come to rest
    first = int(np.argmax(inside))
    outside = np.flatnonzero(~inside[first:])
    if len(outside) == 0:
        return 0.0, 0.0
    last = first + int(outside[-1]) + 1
    return float(time[last] - time[first]), float(distance[first:].max())


def path_crossings(path: Floats, commanded: Floats) -> Floats:
    """Where an attained path crosses the planes that are normal to the commanded path at its points, (m, columns).

    Args:
        path: (T, 3 or more), in the order in which it is run: m, further columns are interpolated too.
        commanded: (m, 3), m: points of the commanded path.

    Rows are NaN where a plane is not crossed (the beginning and end of a path).
    """
    _need("commanded points", commanded, 3, 2)
    tangents = np.gradient(commanded, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    out = np.full((len(commanded), path.shape[1]), np.nan)
    begin = 0
    for number, (point, tangent) in enumerate(zip(commanded, tangents)):
        ahead = (path[begin:, :3] - point) @ tangent
        crossed = np.flatnonzero((ahead[:-1] <= 0) & (ahead[1:] > 0))
        if len(crossed) == 0:
            continue
        k = begin + int(crossed[0])
        share = -ahead[crossed[0]] / (ahead[crossed[0] + 1] - ahead[crossed[0]])
        out[number] = path[k] + share * (path[k + 1] - path[k])
        begin = k
    return out


def path_score(crossings: Floats, commanded: Floats) -> tuple[float, float]:
    """Path accuracy AT (8.2) and repeatability RT (8.3), m.

    Args:
        crossings: (n, m, 3), m: of n runs, as path_crossings gives them.
        commanded: (m, 3), m.

    AT is the largest distance from a commanded point to the mean of the crossings, RT the largest mean(l) + 3 S(l) of
    their distances l from the mean. Points that a run did not cross are left out.
    """
    crossed = ~np.isnan(crossings[:, :, 0]).any(axis=0)
    if len(crossings) < 2 or not crossed.any():
        raise ArgumentError("a path that was run less than twice", "record two runs or more", "too-few-runs")
    some = crossings[:, crossed, :3]
    mean = some.mean(axis=0)
    distances = np.linalg.norm(some - mean, axis=2)
    accuracy = np.linalg.norm(mean - commanded[crossed], axis=1).max()
    return float(accuracy), float((distances.mean(axis=0) + 3 * distances.std(axis=0, ddof=1)).max())


def path_velocity_score(speeds: Floats, commanded: float) -> tuple[float, float, float]:
    """Path velocity accuracy AV, repeatability RV and fluctuation FV (8.6) of speeds (n runs, m points), m/s.

    AV and RV are shares of the commanded speed, FV is in m/s: the largest range of speeds within a run.
    """
    means = speeds.mean(axis=1)
    accuracy = (means.mean() - commanded) / commanded
    return float(accuracy), float(3 * means.std(ddof=1) / commanded), float(np.ptp(speeds, axis=1).max())


def compliance(forces: Floats, displacements: Floats) -> float:
    """Static compliance (10), m/N: slope of the displacements (k,) along a direction over the forces (k,) along it, by
    least squares through the origin."""
    return float(forces @ displacements / (forces @ forces))


def rotation_vectors(commanded: Floats, attained: Floats) -> Floats:
    """Rotations from one orientation (4,) to others (n, 4), in axes of the base: rotation vectors (n, 3), rad."""
    v0, w0 = commanded[:3], commanded[3]
    v, w = attained[:, :3], attained[:, 3:]
    vector = w0 * v - w * v0 - np.cross(v, v0)  # attained * conjugate(commanded)
    scalar = w[:, 0] * w0 + v @ v0
    vector = np.where(scalar[:, None] < 0, -vector, vector)
    sine = np.linalg.norm(vector, axis=1)
    angle = 2 * np.arctan2(sine, np.abs(scalar))
    return vector * np.where(sine > 1e-12, angle / np.maximum(sine, 1e-300), 2.0)[:, None]


def cube_poses(center: Floats, side: float) -> Floats:
    """Positions P1 to P5, (5, 3), m, in a cube of this side with its edges along the axes (6.8).

    They lie in the plane through the corners C1 C2 C7 C8: P1 in the middle, P2 to P5 at a tenth of the diagonal from its
    ends. P2 and P4 are on one diagonal, P3 and P5 on the other.
    """
    corners = np.array([[-1, -1, -1], [-1, 1, -1], [1, 1, 1], [1, -1, 1]]) / 2
    return np.asarray(center) + side * np.vstack([[0, 0, 0], 0.8 * corners])


def _need(what: str, array: Floats, columns: int, rows: int) -> None:
    if array.ndim != 2 or array.shape[1] != columns or len(array) < rows:
        raise ArgumentError(f"{what}: an array of shape {array.shape}", f"give {rows} rows or more of {columns} numbers",
                            "bad-shape")
