"""Shapes, cameras and lasers of a world, as Rerun draws them."""
from __future__ import annotations

import io
import json
import math
from pathlib import Path
from typing import Any, Mapping, Optional

import numpy as np
import rerun as rr
from numpy.typing import NDArray
from PIL import Image

from ..errors import RobossError
from ..robots import Robots
from ..world import World
from .messages import composed

_SIDES = 32  # of a cone that is drawn as a mesh


class Scene:
    """The looks of a world: the scene that the viewer's page has, too (docs/viewer-protocol.md).

    Attributes:
        statics: shapes of the scenery.
    """

    def __init__(self, world: World, looks: Any):
        text, self._meshes, self._textures = looks.scene(world._model)
        scene = json.loads(text)
        self.statics: list[dict[str, Any]] = scene["statics"]
        self._types: list[dict[str, Any]] = scene["types"]
        self._type_of = [robot["type"] for robot in scene["robots"]]

    def type_of(self, robot: int) -> dict[str, Any]:
        """The type of a robot of this number: "links" and "sensors"."""
        number: int = self._type_of[robot]
        return self._types[number]

    def drawn(self, shape: Mapping[str, Any]) -> list[Any]:
        """A shape, and where it is in its link or in the world."""
        color = [round(255 * part) for part in (*shape["rgb"], shape["alpha"])]
        return [placed(pose_of(shape["frame"])), self._body(shape, color)]

    def _body(self, shape: Mapping[str, Any], color: list[int]) -> Any:
        kind: str = shape["shape"]
        look: dict[str, Any] = {"colors": [color], "fill_mode": "solid"}
        if kind == "box":
            return rr.Boxes3D(sizes=[shape["size"]], **look)
        if kind == "plane":
            return rr.Boxes3D(sizes=[[*shape["size"], 0]], **look)
        if kind == "sphere":
            return rr.Ellipsoids3D(radii=[shape["radius"]], **look)
        if kind == "ellipsoid":
            return rr.Ellipsoids3D(half_sizes=[shape["radii"]], **look)
        if kind == "cylinder":
            return rr.Cylinders3D(lengths=[shape["length"]], radii=[shape["radius"]], **look)
        if kind == "capsule":  # Rerun's begins at the centre of its lower end
            return rr.Capsules3D(lengths=[shape["length"]], radii=[shape["radius"]], translations=[[0, 0, -shape["length"] / 2]],
                                 **look)
        if kind == "cone":
            return rr.Mesh3D(**_cone(shape["radius"], shape["length"]), albedo_factor=color)
        return rr.Mesh3D(**self._mesh(shape), albedo_factor=color)

    def _mesh(self, shape: Mapping[str, Any]) -> dict[str, Any]:
        data: bytes = self._meshes[shape["mesh"]]
        vertices, triangles = np.frombuffer(data, "<u4", 2).tolist()
        corners = 8 + 12 * vertices
        mesh: dict[str, Any] = {"vertex_positions": np.frombuffer(data, "<f4", 3 * vertices, 8).reshape(-1, 3),
                                "triangle_indices": np.frombuffer(data, "<u4", 3 * triangles, corners).reshape(-1, 3)}
        picture = self._textures.get(shape.get("finish", {}).get("colour", ""))
        if picture is not None and len(data) > corners + 12 * triangles:
            uv = np.frombuffer(data, "<f4", 2 * vertices, corners + 12 * triangles).reshape(-1, 2)
            mesh["vertex_texcoords"] = np.column_stack([uv[:, 0], 1 - uv[:, 1]])  # Rerun counts from the upper left corner
            mesh["albedo_texture"] = np.asarray(Image.open(io.BytesIO(picture)).convert("RGB"))
        return mesh


def looks_of_journal(world: World) -> Any:
    """The looks of the world of a journal, from its world file. None if that is gone or has changed: a journal has no visuals,
    so collision shapes stand in."""
    from .recorder import quietly_loaded
    if not Path(world.file).is_file():
        return None
    try:
        loaded = quietly_loaded(world.file)
    except RobossError:
        return None
    return loaded._looks if loaded.hash == world.hash else None


def mount_of(robots: Robots, number: int, kind: Mapping[str, Any]) -> Optional[tuple[str, list[Any]]]:
    """The link of a camera or laser of a robot, and where it is there, with its lens; None: another kind of sensor.

    Args:
        robots: one.
        number: of the sensor among those of the robots.
        kind: the type of the robot in the scene.
    """
    sensor = robots._sensor(number)
    if sensor.kind == "laser":
        link, pose, _, _ = sensor._beams()
        return link, [placed(pose)]
    if "camera" not in sensor.kind:
        return None
    facts = kind["sensors"][sensor._numbers[0]]
    pose = pose_of(facts["frame"])
    if "pose" in facts:
        pose = composed(pose, pose_of(facts["pose"]))
    lens = [_lens(facts)] if facts.get("lens") == "gnomonical" else []
    return kind["links"][facts["link"]]["name"], [placed(pose), *lens]


def _lens(facts: Mapping[str, Any]) -> rr.Pinhole:
    """A camera that looks along x, with z up. Rerun has no distortion."""
    width, height = facts["width"], facts["height"]
    fx, fy, cx, cy = (facts[name] for name in ("fx", "fy", "cx", "cy"))
    if not fx > 0:
        fx = fy = width / (2 * math.tan(facts["horizontal_fov"] / 2))
        cx, cy = width / 2, height / 2
    return rr.Pinhole(image_from_camera=[[fx, facts["skew"], cx], [0, fy, cy], [0, 0, 1]], width=width, height=height,
                      camera_xyz=rr.ViewCoordinates.FLU)


def pose_of(numbers: list[float]) -> NDArray[np.float64]:
    """x y z qx qy qz qw of a pose of the scene, x y z qw qx qy qz."""
    x, y, z, qw, qx, qy, qz = numbers
    return np.array([x, y, z, qx, qy, qz, qw])


def placed(pose: NDArray[np.float64]) -> rr.Transform3D:
    """A pose x y z qx qy qz qw as Rerun has it."""
    return rr.Transform3D(translation=pose[:3], quaternion=rr.Quaternion(xyzw=pose[3:]))


def _cone(radius: float, length: float) -> dict[str, Any]:
    """A mesh of a cone along z, its point up, its origin halfway."""
    angles = 2 * math.pi * np.arange(_SIDES) / _SIDES
    ring = np.column_stack([radius * np.cos(angles), radius * np.sin(angles), np.full(_SIDES, -length / 2)])
    here = np.arange(_SIDES)
    after = (here + 1) % _SIDES
    side = np.column_stack([here, after, np.full(_SIDES, _SIDES)])
    floor = np.column_stack([after, here, np.full(_SIDES, _SIDES + 1)])
    return {"vertex_positions": np.vstack([ring, [0, 0, length / 2], [0, 0, -length / 2]]),
            "triangle_indices": np.vstack([side, floor])}
