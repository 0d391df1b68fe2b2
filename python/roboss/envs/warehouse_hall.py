"""The hall of the warehouse task: racks with aisles between them, stations, charging bays, carriers and loads; ways
through it.

Aisles run along y, with a rack on both sides, whose slots hold loads. Both ends open into a cross aisle: the one in the
south (-y) has the stations, the one in the north the charging bays.
"""
from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..builder import WorldBuilder
from ..world import World, load

AISLE_M, RACK_M, PITCH_M = 2.2, 1.0, 3.2     # widths of aisle and rack; from aisle to aisle
RACK_HALF_LENGTH_M, RACK_HEIGHT_M = 3.0, 0.5
DOOR_M, LANE_M, PASSED_M = 3.7, 0.4, 0.6     # ways through an aisle: y of its ends, x from its middle, near enough
STATION_M, BAY_M = -5.0, 5.2                 # y of stations and bays
HALF_WIDTH_M = 6.0                           # y of the walls
SLOTS_M = (-2.5, -1.5, -0.5, 0.5, 1.5, 2.5)  # y of the slots of a side
ASIDE_M = 0.5                                # from the middle of the aisle, of a carrier in front of a slot
LOAD_M, DECK_M = (0.36, 0.36, 0.3), 0.25     # edges of a load; height of a carrier's deck
BEAMS, RANGE_M = 21, 8.0                     # of a carrier's laser
_WALL_M, _GAP_M = 0.2, 0.001

_CARRIER = """<model name="{name}"><pose>{x} {y} 0 0 0 0</pose>
<link name="chassis"><pose>0 0 0.17 0 0 0</pose>
<inertial><mass>25</mass><inertia><ixx>0.39</ixx><iyy>0.8</iyy><izz>1.08</izz></inertia></inertial>
<collision name="hull"><geometry><box><size>0.6 0.4 0.16</size></box></geometry></collision>
{sliders}<sensor name="laser" type="lidar"><pose>0.305 0 0.02 0 0 0</pose><update_rate>20</update_rate><lidar>
<scan><horizontal><samples>21</samples><resolution>1</resolution><min_angle>-1.5707963</min_angle>
<max_angle>1.5707963</max_angle></horizontal></scan><range><min>0.02</min><max>8</max><resolution>0.001</resolution></range>
<noise><type>gaussian</type><mean>0</mean><stddev>0.01</stddev></noise></lidar></sensor>
</link>
{wheels}<plugin filename="gz-sim-diff-drive-system" name="gz::sim::systems::DiffDrive">
<left_joint>left_wheel</left_joint><right_joint>right_wheel</right_joint>
<wheel_separation>0.46</wheel_separation><wheel_radius>0.1</wheel_radius>
<max_linear_acceleration>1.5</max_linear_acceleration><min_linear_acceleration>-3</min_linear_acceleration>
<max_angular_acceleration>6</max_angular_acceleration><min_angular_acceleration>-6</min_angular_acceleration></plugin></model>
"""
_SLIDER = """<collision name="{name}"><pose>{x} 0 -0.118 0 0 0</pose><geometry><sphere><radius>0.05</radius></sphere></geometry>
<surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface></collision>
"""
_WHEEL = """<link name="{side}_tyre"><pose>0 {y} 0.1 0 0 0</pose>
<inertial><mass>1.5</mass><inertia><ixx>0.006</ixx><iyy>0.0075</iyy><izz>0.006</izz></inertia></inertial>
<collision name="tyre"><geometry><sphere><radius>0.1</radius></sphere></geometry>
<surface><friction><ode><mu>1</mu><mu2>1</mu2></ode></friction></surface></collision></link>
<joint name="{side}_wheel" type="continuous"><parent>chassis</parent><child>{side}_tyre</child>
<axis><xyz>0 1 0</xyz><limit><effort>8</effort></limit></axis></joint>
"""


class Hall:
    """A hall for some carriers: places, and ways between them.

    Args:
        carriers: how many; the hall grows with them.

    Attributes:
        aisles: (A,): x of their middles, m.
        slots: (S, 2): x, y where a carrier stands in front of each slot, m.
        shelves: (S, 2): x, y of the load in each slot, m.
        stations: (A, 2): x, y, m.
        bays: (carriers, 2): x, y, m.
        starts: (P, 3): x, y in m and yaw in rad, where carriers can start.
        half_length: x of the walls, m.
    """

    def __init__(self, carriers: int):
        count = -(-carriers // 3) + 1
        self.aisles = (np.arange(count) - (count - 1) / 2) * PITCH_M
        self.half_length = count / 2 * PITCH_M + RACK_M / 2
        sides = [(x, y, side) for x in self.aisles for side in (-1, 1) for y in SLOTS_M]
        self.slots = np.array([(x + side * ASIDE_M, y) for x, y, side in sides])
        self.shelves = np.array([(x + side * (AISLE_M / 2 + 0.25), y) for x, y, side in sides])
        self.stations = np.column_stack([self.aisles, np.full(count, STATION_M)])
        step = 2 * self.half_length / carriers
        self.bays = np.column_stack([(np.arange(carriers) + 0.5) * step - self.half_length, np.full(carriers, BAY_M)])
        inside = [(x, y, turn) for x in self.aisles for y in (-2.2, 0.0, 2.2) for turn in (np.pi / 2, -np.pi / 2)]
        across = np.arange(-self.half_length + 1.2, self.half_length - 1.1, 1.6)
        ends = [(x, y, turn) for x in across for y in (-3.9, 3.9) for turn in (0.0, np.pi)]
        self.starts = np.array(inside + ends)

    def ways(self, here: NDArray[np.float64], goals: NDArray[np.float64]) -> tuple[NDArray, NDArray]:
        """Shortest ways from places to goals, (N, 2) each, around the racks: lengths (N,), m, and next points (N, 2).

        Straight within an aisle, and within a cross aisle; else through the right-hand sides of the ends of aisles.
        """
        best, nearest = np.full(len(here), np.inf), goals.copy()
        open_here, open_goal = (np.abs(place[:, 1]) > RACK_HALF_LENGTH_M for place in (here, goals))
        of_here, of_goal = self._aisle(here), self._aisle(goals)
        same_end = open_here & open_goal & (here[:, 1] * goals[:, 1] > 0)
        straight = same_end | (~open_here & ~open_goal & (of_here == of_goal))
        for end in (-1, 1):
            door = np.full(len(here), end * DOOR_M)
            leave = np.column_stack([self.aisles[of_here] + end * LANE_M, door])
            enter = np.column_stack([self.aisles[of_goal] - end * LANE_M, door])
            # From a cross aisle the way begins at its own end, and from an aisle it leaves by this one.
            first = np.where(open_here[:, None], here, leave)
            impossible = open_here & (here[:, 1] * end < 0)
            # To a place in the other cross aisle it goes through the aisle next to it, and is led on from its end.
            through = open_goal & (goals[:, 1] * end < 0)
            points = np.where((open_goal & ~through)[:, None], first, enter)
            lengths = _far(here, first) + _far(first, points) + _far(points, goals)
            shorter = ~straight & ~impossible & (lengths < best)
            best = np.where(shorter, lengths, best)
            onward = np.where(_far(here, points)[:, None] > PASSED_M, points, goals)
            onward = np.where(_far(here, first)[:, None] > PASSED_M, first, onward)
            nearest = np.where(shorter[:, None], onward, nearest)
        return np.where(straight, _far(here, goals), best), nearest

    def _aisle(self, places: NDArray[np.float64]) -> NDArray[np.int64]:
        """The aisle next to each place."""
        return np.abs(places[:, :1] - self.aisles).argmin(axis=1)

    def outside(self, count: int) -> NDArray[np.float64]:
        """Poses, (count, 7), behind the south wall, where carriers wait; the loads are 0.8 m further."""
        poses = np.zeros((count, 7))
        poses[:, 0] = (np.arange(count) % 20 - 10) * 1.2
        poses[:, 1] = -HALF_WIDTH_M - RANGE_M - 2 - 2 * (np.arange(count) // 20)
        poses[:, 6] = 1
        return poses

    def world(self, carriers: int) -> World:
        """The hall with "carrier_0" ... and "load_0" ..., which wait outside."""
        builder = WorldBuilder("warehouse")
        builder.ground(friction=1.0, color=[0.72, 0.72, 0.7])
        for number, (center, size) in enumerate(self._solids()):
            builder.box(f"solid_{number}", size, pose=center, color=[0.35, 0.45, 0.6])
        outside = self.outside(carriers)
        for number, (x, y) in enumerate(outside[:, :2]):
            builder.box(f"load_{number}", LOAD_M, mass=8, pose=[x, y - 0.8, LOAD_M[2] / 2], color=[0.8, 0.6, 0.3])
        sliders = "".join(_SLIDER.format(name=name, x=x) for name, x in (("front", 0.24), ("rear", -0.24)))
        wheels = "".join(_WHEEL.format(side=side, y=y) for side, y in (("left", 0.23), ("right", -0.23)))
        models = [_CARRIER.format(name=f"carrier_{number}", x=x, y=y, sliders=sliders, wheels=wheels)
                  for number, (x, y) in enumerate(outside[:, :2])]
        scenery = builder.to_sdf()
        end = scenery.rindex("</world>")
        return load(scenery[:end] + "".join(models) + scenery[end:])

    def _solids(self) -> list[tuple[list[float], list[float]]]:
        """Centres and sizes of racks and walls."""
        edges = np.append(self.aisles - PITCH_M / 2, self.aisles[-1] + PITCH_M / 2)
        solids = [([x, 0, RACK_HEIGHT_M / 2], [RACK_M, 2 * RACK_HALF_LENGTH_M, RACK_HEIGHT_M]) for x in edges]
        length, width = self.half_length + _WALL_M / 2, HALF_WIDTH_M + _WALL_M / 2
        for side in (-1, 1):
            solids.append(([side * length, 0, 0.25], [_WALL_M, 2 * width + _WALL_M, 0.5]))
            solids.append(([0, side * width, 0.25], [2 * length - _WALL_M, _WALL_M, 0.5]))
        return solids


def on_shelf(place: NDArray[np.float64]) -> NDArray[np.float64]:
    """Pose, (7,), of a load in the slot with this x, y."""
    return np.array([*place, RACK_HEIGHT_M + LOAD_M[2] / 2 + _GAP_M, 0, 0, 0, 1])


def on_deck(carrier: NDArray[np.float64]) -> NDArray[np.float64]:
    """Pose, (7,), of a load on a carrier with this pose, which is upright."""
    return np.array([*carrier[:2], carrier[2] + DECK_M + LOAD_M[2] / 2 + _GAP_M, *carrier[3:]])


def _far(one: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.hypot(*(other - one).T)
