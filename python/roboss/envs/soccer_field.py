"""The world of the soccer task: a field with walls and two goals, cars of two teams, and a ball."""
from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..world import World, example, load

HALF_LENGTH_M, HALF_WIDTH_M = 6.0, 4.0
HALF_GOAL_M, GOAL_DEPTH_M = 1.2, 0.8
BALL_RADIUS_M = 0.15
_WALL_M, _HEIGHT_M = 0.2, 0.4

_HEAD = """<sdf version="1.9" xmlns:roboss="https://roboss.org/sdf"><world name="soccer">
<physics name="p" type="ode"><max_step_size>0.002</max_step_size></physics>
<model name="field"><static>true</static><link name="l">
<collision name="ground"><geometry><plane/></geometry><surface><friction><ode><mu>1</mu><mu2>1</mu2></ode></friction></surface>
</collision>
"""
_WALL = '<collision name="wall_{}"><pose>{} {} {} 0 0 0</pose><geometry><box><size>{} {} {}</size></box></geometry></collision>\n'
_CAR = "<include><uri>model://car</uri><name>{}</name><pose>{} {} 0 0 0 0</pose></include>\n"
_BALL = """<model name="ball"><pose>0 0 {r} 0 0 0</pose><link name="l"><inertial><mass>0.3</mass>
<inertia><ixx>0.0045</ixx><iyy>0.0045</iyy><izz>0.0045</izz></inertia></inertial><collision name="c"><geometry><sphere>
<radius>{r}</radius></sphere></geometry><surface><roboss:rolling_friction>0.003</roboss:rolling_friction>
<bounce><restitution_coefficient>0.6</restitution_coefficient></bounce></surface></collision></link></model>
"""


def soccer_world(names: tuple[str, ...]) -> World:
    """The field with cars of these names, which wait outside."""
    text = [_HEAD, *(_WALL.format(number, *wall) for number, wall in enumerate(_walls())), "</link></model>\n"]
    text += [_CAR.format(name, x, y) for name, (x, y) in zip(names, outside(len(names))[:, :2])]
    text.append(_BALL.format(r=BALL_RADIUS_M) + "</world></sdf>")
    return load("".join(text), search_paths=[Path(example("city.sdf")).parent / "models"])


def outside(count: int) -> NDArray[np.float64]:
    """Poses, (count, 7), beside the field, where cars wait."""
    poses = np.zeros((count, 7))
    poses[:, 0], poses[:, 1], poses[:, 6] = np.arange(count) - count / 2, -HALF_WIDTH_M - 3, 1
    return poses


def _walls() -> list[tuple[float, ...]]:
    """x, y, z and size of each wall: two sides, and at each end two pieces and the box of the goal."""
    def wall(low_x, high_x, low_y, high_y):
        return ((low_x + high_x) / 2, (low_y + high_y) / 2, _HEIGHT_M / 2, high_x - low_x, high_y - low_y, _HEIGHT_M)

    length, width, back = HALF_LENGTH_M, HALF_WIDTH_M, HALF_LENGTH_M + GOAL_DEPTH_M
    walls = [wall(-length, length, width, width + _WALL_M), wall(-length, length, -width - _WALL_M, -width)]
    for end in (-1, 1):
        for side in (-1, 1):
            x, y = sorted((end * length, end * back)), sorted((side * HALF_GOAL_M, side * (width + _WALL_M)))
            walls.append(wall(*x, *y))  # as thick as the goal is deep
        walls.append(wall(*sorted((end * back, end * (back + _WALL_M))), -width, width))
    return walls
