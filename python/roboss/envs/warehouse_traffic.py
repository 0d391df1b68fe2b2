"""A traffic control for the carriers of the warehouse: lanes, of which each carrier reserves the next pieces."""
from __future__ import annotations

import heapq
from typing import Optional

import numpy as np
from numpy.typing import NDArray

from .car import heading
from .warehouse import TOP_SPEED_M_S, TOP_TURN_RAD_S, WarehouseTask
from .warehouse_hall import PITCH_M, SLOTS_M, Hall

_LANE_M, _INNER_M, _OUTER_M = 0.5, 3.6, 4.45  # lanes: x from the middle of an aisle; |y| of those of cross aisles
_SPOT_M = 5.3                                 # |y| of stops at stations and bays
_APART_M, _IN_THE_WAY_M = 0.8, 0.68           # between the middles of two carriers; a carrier reaches 0.37 m
_AHEAD, _PATIENCE = 3, 20                     # nodes that a carrier reserves; steps after which it takes another way
_BRAKE_M_S2, _NEAR_M = 1.5, 0.1
_CORNER_M, _CORNER_M_S = 0.26, 0.34           # turns without a stop begin so far before a node, at this speed
_STRAIGHT, _SHARP = 0.35, 1.8                 # rad: smaller and greater turns of a way


class Lanes:
    """The lanes of a hall, for traffic on the right: nodes, and edges of one direction.

    An aisle has a lane to the north and one to the south, which pass the slots of their side; a cross aisle has two lanes
    and the stops at stations or bays. A carrier can change to the other lane at every node.

    Attributes:
        nodes: (N, 2): x, y, m.
        edges: of each node, those that follow it, with the length of the way, m.
    """

    def __init__(self, hall: Hall):
        self._places: list[tuple[float, float]] = []
        self.edges: list[list[tuple[int, float]]] = []
        south, north = self._cross_aisle(hall, -1), self._cross_aisle(hall, 1)
        for x in hall.aisles:
            up, down = ([self._node(x + side * _LANE_M, y) for y in SLOTS_M] for side in (1, -1))
            for k in range(len(SLOTS_M)):
                self._join(up[k], down[k], both=True)
                if k > 0:
                    self._join(up[k - 1], up[k])
                    self._join(down[k], down[k - 1])
            east, west = (round(x + side * _LANE_M, 6) for side in (1, -1))
            self._join(south[east], up[0])
            self._join(up[-1], north[east])
            self._join(north[west], down[-1])
            self._join(down[0], south[west])
        self.nodes: NDArray[np.float64] = np.array(self._places)

    def _cross_aisle(self, hall: Hall, end: int) -> dict[float, int]:
        """Its lanes and stops; gives the nodes of the inner lane by x."""
        xs = sorted({round(float(x + dx), 6) for x in hall.aisles for dx in (-_LANE_M, _LANE_M, PITCH_M / 2)})[:-1]
        inner, outer = ([self._node(x, end * y) for x in xs] for y in (_INNER_M, _OUTER_M))
        # On the right: in the south the inner lane leads to the west, in the north to the east.
        for lane, step in ((inner, end), (outer, -end)):
            for k in range(len(xs) - 1):
                self._join(*(lane[k], lane[k + 1])[::step])
        for k in range(len(xs)):
            self._join(inner[k], outer[k], both=True)
        for x, _ in hall.stations if end < 0 else hall.bays:
            stop = self._node(float(x), end * _SPOT_M)
            near = sorted(range(len(xs)), key=lambda k: abs(xs[k] - x))[:2 if end < 0 else 1]
            for k in near:
                self._join(outer[k], stop, both=True)
        return dict(zip(xs, inner))

    def _node(self, x: float, y: float) -> int:
        self._places.append((x, y))
        self.edges.append([])
        return len(self._places) - 1

    def _join(self, one: int, other: int, both: bool = False) -> None:
        length = float(np.hypot(*np.subtract(self._places[one], self._places[other]))) + (0.8 if both else 0.0)
        self.edges[one].append((other, length))
        if both:
            self.edges[other].append((one, length))

    def nearest(self, place: NDArray) -> int:
        return int(np.hypot(*(self.nodes - place).T).argmin())

    def way(self, start: int, goal: int, dear: NDArray[np.float64], closed: set[int]) -> list[int]:
        """The cheapest way, without its start. `dear`: what each node costs besides the length, m. `closed`: nodes to which
        one goes from the start only if there is no other way."""
        best, before, queue = {start: 0.0}, {}, [(0.0, start)]
        while queue:
            cost, node = heapq.heappop(queue)
            if node == goal:
                break
            if cost > best[node]:
                continue
            for after, length in self.edges[node]:
                more = cost + length + dear[after] + (50.0 if node == start and after in closed else 0.0)
                if more < best.get(after, np.inf):
                    best[after], before[after] = more, node
                    heapq.heappush(queue, (more, after))
        way = [goal]
        while way[-1] != start and way[-1] in before:
            way.append(before[way[-1]])
        return way[-2::-1]


class CarrierTraffic:
    """Drives all carriers of a task: call it before each step for the actions, (count, 2).

    It knows where all carriers are and where they are to go, as the control room of a warehouse does; compare
    `fetch_and_carry`, which has only the observation of one carrier. A carrier drives on one-way lanes, and only on pieces
    that it has reserved. Two reservations are nowhere closer than 0.8 m, so carriers that keep their lanes do not touch.
    Who waits longest reserves first. Who has waited for 1 s takes another way, around those that stand.

    Args:
        task: of one world or several; `task.step` is called with what this gives.

    >>> env = roboss.envs.WarehouseVectorEnv(num_envs=8)
    >>> observations, infos = env.reset(seed=1)
    >>> drive = roboss.envs.CarrierTraffic(env.task)
    >>> for _ in range(20):
    ...     observations, rewards, terminated, truncated, infos = env.step(drive())
    >>> bool(terminated.any())
    False
    """

    def __init__(self, task: WarehouseTask):
        self._task, self._lanes = task, Lanes(task.hall)
        self._cars = [_Carrier() for _ in range(task.count)]

    def __call__(self) -> NDArray[np.float64]:
        pose = self._task.robots.pose.reshape(-1, 7)
        cos, sin = heading(pose)
        actions = np.zeros((self._task.count, 2))
        carriers = len(self._task.names)
        for world in range(self._task.worlds):
            rows = [r for r in range(world * carriers, (world + 1) * carriers) if self._task.present[r]]
            self._reserve(rows, pose[:, :2])
            for row in rows:
                actions[row] = self._cars[row].action(self._lanes.nodes, pose[row, :2], np.arctan2(sin[row], cos[row]))
        for row in np.flatnonzero(~self._task.present):
            self._cars[row] = _Carrier()
        return actions

    def _reserve(self, rows: list[int], places: NDArray) -> None:
        """Gives each carrier of a world as much of its way as is free."""
        for row in rows:
            self._cars[row].arrive(self._lanes.nodes, places[row])
            self._cars[row].give_up(self._lanes.nodes, places[row], places[[other for other in rows if other != row]])
        taken = {row: self._cars[row].reserved(self._lanes.nodes, places[row]) for row in rows}
        for row in sorted(rows, key=lambda r: (-self._cars[r].waits, r)):
            car, others = self._cars[row], [taken[other] for other in rows if other != row]
            around = np.concatenate(others) if others else np.zeros((0, 2, 2))
            self._plan(car, row, rows, places, around)
            while car.way and len(car.ahead) < _AHEAD:
                start = self._lanes.nodes[car.ahead[-1]] if car.ahead else places[row]
                piece = np.array([start, self._lanes.nodes[car.way[0]]])
                if len(around) and distances(piece, around).min() < _APART_M:
                    break
                car.ahead.append(car.way.pop(0))
            car.waits = car.waits + 1 if car.way and not car.ahead else 0
            taken[row] = car.reserved(self._lanes.nodes, places[row])

    def _plan(self, car: _Carrier, row: int, rows: list[int], places: NDArray, around: NDArray) -> None:
        goal = self._lanes.nearest(self._task._place_of_goal[row])
        stuck = car.waits > 0 and car.waits % _PATIENCE == 0
        if car.goal == goal and not stuck:
            return
        standing = [places[r] for r in rows if r != row and not self._cars[r].ahead]
        dear = np.zeros(len(self._lanes.nodes))
        for place in standing:
            dear[np.hypot(*(self._lanes.nodes - place).T) < _APART_M] += 3.0
        start = car.ahead[-1] if car.ahead else car.node
        if start is None or stuck and not car.ahead and np.hypot(*(self._lanes.nodes[start] - places[row])) > 2 * _NEAR_M:
            start = self._free_node(places[row], around)  # it is on no lane
            if start is not None:
                car.way, car.goal = [start, *self._lanes.way(start, goal, dear, set())], goal
            return
        closed = {node for node, _ in self._lanes.edges[start] if stuck and self._is_taken(start, node, around)}
        car.way, car.goal = self._lanes.way(start, goal, dear, closed), goal

    def _is_taken(self, start: int, node: int, around: NDArray) -> bool:
        piece = self._lanes.nodes[[start, node]]
        return bool(len(around) and distances(piece, around).min() < _APART_M)

    def _free_node(self, place: NDArray, around: NDArray) -> Optional[int]:
        """The nearest node to which a carrier that is on no lane can drive straight."""
        far = np.hypot(*(self._lanes.nodes - place).T)
        for node in far.argsort()[:8]:
            piece = np.array([place, self._lanes.nodes[node]])
            if far[node] < 1.3 and (not len(around) or distances(piece, around).min() >= _APART_M):
                return int(node)
        return None


class _Carrier:
    """Where a carrier is on the lanes, and what it has reserved."""

    def __init__(self) -> None:
        self.node: Optional[int] = None  # where it was last; None: on no lane yet
        self.ahead: list[int] = []       # nodes that are reserved
        self.way: list[int] = []         # those behind them, up to the goal
        self.goal: Optional[int] = None
        self.waits = 0                   # steps
        self._rolls = False              # through a turn
        self._place: Optional[NDArray] = None

    def arrive(self, nodes: NDArray, place: NDArray) -> None:
        """Takes off what it has passed. One that was put elsewhere begins anew."""
        if self._place is not None and np.hypot(*(place - self._place)) > 0.5:
            self.__init__()  # type: ignore[misc]
        self._place = place.copy()
        while self.ahead:
            turn = _turn(place, nodes[self.ahead[0]], nodes[self.ahead[1]]) if len(self.ahead) > 1 else np.pi
            near = 0.3 if turn < _STRAIGHT else _CORNER_M if turn < _SHARP else _NEAR_M
            if np.hypot(*(nodes[self.ahead[0]] - place)) > near:
                break
            self.node = self.ahead.pop(0)
            self._rolls = _STRAIGHT <= turn < _SHARP

    def give_up(self, nodes: NDArray, place: NDArray, others: NDArray) -> None:
        """What it has reserved from where somebody stands on: one that was just put there."""
        points = np.array([place, *(nodes[node] for node in self.ahead)])
        for k in range(len(self.ahead)):
            if len(others) and _to_piece(others, points[k], points[k + 1]).min() < _IN_THE_WAY_M:
                self.ahead, self.way = self.ahead[:k], self.ahead[k:] + self.way
                break

    def reserved(self, nodes: NDArray, place: NDArray) -> NDArray[np.float64]:
        """Pieces, (P, 2, 2), from where it is on."""
        points = np.array([place, *(nodes[node] for node in self.ahead)])
        return np.stack([points[:-1], points[1:]], axis=1) if len(points) > 1 else np.array([[place, place]])

    def action(self, nodes: NDArray, place: NDArray, yaw: float) -> NDArray[np.float64]:
        """Towards the next node; it can stop at the next turn and at the end of what is reserved."""
        if not self.ahead:
            return np.zeros(2)
        away = nodes[self.ahead[0]] - place
        error = float(np.remainder(np.arctan2(away[1], away[0]) - yaw + np.pi, 2 * np.pi) - np.pi)
        free, last, slow = float(np.hypot(*away)), place, 0.0
        for one, other in zip(self.ahead, self.ahead[1:]):
            turn = _turn(last, nodes[one], nodes[other])
            if turn >= _STRAIGHT:
                slow = _CORNER_M_S if turn < _SHARP else 0.0
                break
            free, last = free + float(np.hypot(*(nodes[other] - nodes[one]))), nodes[one]
        free -= _CORNER_M if slow > 0 else 0.03
        speed = min(TOP_SPEED_M_S, np.sqrt(slow**2 + 2 * _BRAKE_M_S2 * max(0.0, free)))
        if abs(error) > 0.25:
            speed = min(speed, _CORNER_M_S) if self._rolls and abs(error) < _SHARP else 0.0  # or on the spot
        else:
            self._rolls = False
        return np.array([speed / TOP_SPEED_M_S, np.clip(4 * error / TOP_TURN_RAD_S, -1, 1)])


def _turn(before: NDArray, at: NDArray, after: NDArray) -> float:
    """By how much a way turns at a point, rad."""
    one, other = at - before, after - at
    return abs(float(np.arctan2(one[0] * other[1] - one[1] * other[0], one @ other)))


def distances(piece: NDArray, others: NDArray) -> NDArray[np.float64]:
    """From a piece of way, (2, 2), to each of others, (P, 2, 2), m."""
    (a, b), c, d = piece, others[:, 0], others[:, 1]
    ends = [_to_pieces(a, c, d), _to_pieces(b, c, d), _to_piece(c, a, b), _to_piece(d, a, b)]

    def side(p: NDArray, q: NDArray, r: NDArray) -> NDArray:
        return (q[..., 0] - p[..., 0]) * (r[..., 1] - p[..., 1]) - (q[..., 1] - p[..., 1]) * (r[..., 0] - p[..., 0])

    crossing = (side(a, b, c) * side(a, b, d) < 0) & (side(c, d, a) * side(c, d, b) < 0)
    return np.where(crossing, 0.0, np.min(ends, axis=0))


def _to_pieces(point: NDArray, starts: NDArray, ends: NDArray) -> NDArray[np.float64]:
    along = ends - starts
    share = ((point - starts) * along).sum(axis=1) / np.maximum((along * along).sum(axis=1), 1e-12)
    return np.hypot(*(point - starts - share.clip(0, 1)[:, None] * along).T)


def _to_piece(points: NDArray, start: NDArray, end: NDArray) -> NDArray[np.float64]:
    along = end - start
    share = ((points - start) @ along) / max(float(along @ along), 1e-12)
    return np.hypot(*(points - start - share.clip(0, 1)[:, None] * along).T)
