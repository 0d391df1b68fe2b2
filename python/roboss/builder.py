"""WorldBuilder: worlds made in Python, as SDFormat. Shapes, models of files, joints, lights; no physics here."""
from __future__ import annotations

import math
import os
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any, Optional, Sequence, Union

from numpy.typing import ArrayLike

from .errors import ArgumentError
from .names import file_path, flag, real, unknown
from .outputs import check_output
from .sdf_elements import checked_name, positive, put, put_pose, rgba, unit_vector, vector
from .shapes import Shape, box, capsule, cylinder, plane, sphere
from .world import World, load

Element = ET.Element
#: Types of joints: how many axes each has.
JOINT_AXES = {"fixed": 0, "ball": 0, "revolute": 1, "continuous": 1, "prismatic": 1, "universal": 2}
_LIGHTS = ["directional", "point", "spot"]


class WorldBuilder:
    """A world made in code: SDFormat that `build` gives to `load`.

    Poses are x y z (m), or x y z and a quaternion x y z w. Colours are red, green, blue from 0 to 1, or with alpha. A
    shape with a `mass` (kg) moves, one without stands still. Names are unique in the world.

    Args:
        name: of the world.
        dt: length of a tick, s.
        gravity: m/s^2.

    >>> world = roboss.WorldBuilder("yard")
    >>> _ = world.ground()
    >>> _ = world.box("crate", [0.4, 0.4, 0.4], mass=5, pose=[0, 0, 0.2], color=[1, 0.5, 0])
    >>> _ = world.add("car", roboss.example("models/car/model.sdf"), pose=[3, 0, 0])   # a file of your own
    >>> door = world.model("door", pose=[-2, 0, 1])
    >>> _ = door.box("leaf", [0.9, 0.05, 2], mass=20, pose=[0.45, 0, 0])
    >>> _ = door.joint("hinge", "revolute", "world", "leaf", axis=[0, 0, 1], at=[-0.45, 0, 0], lower=0, upper=1.5)
    >>> sim = roboss.Simulation(world.build())
    >>> sim.world.robots
    ('crate', 'car', 'door')
    """

    def __init__(self, name: str = "world", *, dt: float = 0.002, gravity: ArrayLike = (0, 0, -9.8)):
        self._world = ET.Element("world", name=checked_name("world", name, ()))
        physics = ET.SubElement(self._world, "physics", name="default", type="ignored")
        put(physics, "max_step_size", positive("dt", dt))
        put(self._world, "gravity", vector("gravity", gravity, 3))
        self._names: list[str] = []

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all models and lights so far."""
        return tuple(self._names)

    def add(self, name: str, file: Union[str, os.PathLike], *, pose: ArrayLike = (0, 0, 0), static: bool = False) -> None:
        """Adds the model of an SDFormat or URDF file, as it is there, under this name.

        Args:
            file: path; the SDFormat refers to it by its absolute path.
            pose: of the model's frame in the world.
            static: whether it is welded to the world.

        Raises:
            ArgumentError: there is no such file, or the name is taken. What the file says is checked by `build`.
        """
        path = Path(file_path("file", file)).expanduser().resolve()
        if not path.is_file():
            raise ArgumentError(f"model '{name}': there is no file '{path}'", "give the path of an SDFormat or URDF file",
                                "no-file")
        include = ET.SubElement(self._world, "include")
        put(include, "name", self._new("model", name))
        put(include, "uri", path.as_uri())
        put_pose(include, f"model '{name}'", pose)
        if flag("static", static):
            put(include, "static", "true")

    def model(self, name: str, *, pose: ArrayLike = (0, 0, 0), static: bool = False) -> ModelBuilder:
        """Adds an empty model, whose links and joints the result adds. `pose`: of its frame in the world."""
        element = ET.SubElement(self._world, "model", name=self._new("model", name))
        put_pose(element, f"model '{name}'", pose)
        if flag("static", static):
            put(element, "static", "true")
        return ModelBuilder(element, name, static)

    def ground(self, name: str = "ground", *, size: Sequence[float] = (100, 100), **look: Any) -> ModelBuilder:
        """Adds a plane at z = 0. It is endless for what collides; `size`: what is drawn, m. `look`: as of `box`."""
        return self.plane(name, size=size, **look)

    def plane(self, name: str, *, normal: Sequence[float] = (0, 0, 1), size: Sequence[float] = (100, 100),
              pose: ArrayLike = (0, 0, 0), **look: Any) -> ModelBuilder:
        """Adds an endless plane that stands still. `size`: what is drawn, m; `look`: as of `box`."""
        return self._single(name, plane(normal, size), None, pose, look)

    def box(self, name: str, size: Sequence[float], *, mass: Optional[float] = None, pose: ArrayLike = (0, 0, 0),
            **look: Any) -> ModelBuilder:
        """Adds a box. `size`: its edges, m; `mass`: kg; None: it stands still.

        `look`: `color`, `friction` (Coulomb's coefficient), `restitution` (0 to 1).
        """
        return self._single(name, box(size), mass, pose, look)

    def sphere(self, name: str, radius: float, *, mass: Optional[float] = None, pose: ArrayLike = (0, 0, 0),
               **look: Any) -> ModelBuilder:
        """Adds a sphere, as `box`. `radius`: m."""
        return self._single(name, sphere(radius), mass, pose, look)

    def cylinder(self, name: str, radius: float, length: float, *, mass: Optional[float] = None, pose: ArrayLike = (0, 0, 0),
                 **look: Any) -> ModelBuilder:
        """Adds a cylinder along its z axis, as `box`. `radius`, `length`: m."""
        return self._single(name, cylinder(radius, length), mass, pose, look)

    def capsule(self, name: str, radius: float, length: float, *, mass: Optional[float] = None, pose: ArrayLike = (0, 0, 0),
                **look: Any) -> ModelBuilder:
        """Adds a capsule along its z axis, as `box`. `length`: m, of the cylinder between the half spheres."""
        return self._single(name, capsule(radius, length), mass, pose, look)

    def light(self, name: str, kind: str = "directional", *, pose: ArrayLike = (0, 0, 10),
              direction: Sequence[float] = (0.3, 0.2, -1), color: Sequence[float] = (1, 1, 1)) -> None:
        """Adds a light for views: "directional", "point" or "spot"."""
        if kind not in _LIGHTS:
            raise unknown("kind of light", kind, _LIGHTS)
        element = ET.SubElement(self._world, "light", name=self._new("light", name), type=kind)
        put_pose(element, f"light '{name}'", pose)
        put(element, "diffuse", rgba(f"light '{name}'", color))
        if kind != "point":
            put(element, "direction", unit_vector(f"light '{name}': direction", direction))

    def to_sdf(self) -> str:
        """The world as SDFormat 1.9."""
        root = ET.Element("sdf", version="1.9")
        root.append(self._world)
        ET.indent(root)
        return ET.tostring(root, encoding="unicode", xml_declaration=False) + "\n"

    def save(self, path: Union[str, os.PathLike]) -> None:
        """Writes `to_sdf` to a file, for `roboss run` and others. Raises OSError where that fails, ArgumentError
        where it would replace a file of another kind."""
        check_output(path, "world")
        Path(path).write_text(self.to_sdf(), encoding="utf-8")

    def build(self, **options: Any) -> World:
        """Compiles the world. `options`: those of `load`. Raises WorldError, with lines of `to_sdf`."""
        return load(self.to_sdf(), **options)

    def _new(self, kind: str, name: str) -> str:
        """A name that is not taken; it is taken from now on."""
        checked_name(kind, name, self._names)
        self._names.append(name)
        return name

    def _single(self, name: str, shape: Shape, mass: Optional[float], pose: ArrayLike, look: dict) -> ModelBuilder:
        """A model of one link."""
        checked = shape.described(f"model '{name}'", mass, look)  # before anything is added
        model = self.model(name, pose=pose, static=mass is None)
        model._add_link("link", checked, (0, 0, 0))
        return model

    def __repr__(self) -> str:
        return f"<roboss.WorldBuilder '{self._world.get('name')}': {len(self._names)} models and lights>"


class ModelBuilder:
    """A model of a WorldBuilder: links of one shape each, and joints between them. WorldBuilder.model makes it.

    A model's links are connected by joints; those that are not move as robots of their own.

    >>> world = roboss.WorldBuilder()
    >>> pendulum = world.model("pendulum", pose=[0, 0, 2])
    >>> _ = pendulum.sphere("bob", 0.1, mass=1, pose=[0, 0, -1])
    >>> _ = pendulum.joint("pivot", "revolute", "world", "bob", axis=[0, 1, 0], at=[0, 0, 1])
    >>> sim = roboss.Simulation(world.build())
    >>> sim.robots("pendulum").joints
    ('pivot',)
    """

    def __init__(self, element: Element, name: str, static: bool):
        self.name: str = name  #: in the world
        self._element, self._static = element, static
        self._links: list[str] = []
        self._joints: list[str] = []

    @property
    def links(self) -> tuple[str, ...]:
        """Names of the links so far."""
        return tuple(self._links)

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the joints so far."""
        return tuple(self._joints)

    def box(self, name: str, size: Sequence[float], *, mass: Optional[float] = None, pose: ArrayLike = (0, 0, 0),
            **look: Any) -> ModelBuilder:
        """Adds a link that is a box, as WorldBuilder.box. `pose`: in the model. Returns this model."""
        return self._shape(name, box(size), mass, pose, look)

    def sphere(self, name: str, radius: float, *, mass: Optional[float] = None, pose: ArrayLike = (0, 0, 0),
               **look: Any) -> ModelBuilder:
        """Adds a link that is a sphere. Returns this model."""
        return self._shape(name, sphere(radius), mass, pose, look)

    def cylinder(self, name: str, radius: float, length: float, *, mass: Optional[float] = None, pose: ArrayLike = (0, 0, 0),
                 **look: Any) -> ModelBuilder:
        """Adds a link that is a cylinder along its z axis. Returns this model."""
        return self._shape(name, cylinder(radius, length), mass, pose, look)

    def capsule(self, name: str, radius: float, length: float, *, mass: Optional[float] = None, pose: ArrayLike = (0, 0, 0),
                **look: Any) -> ModelBuilder:
        """Adds a link that is a capsule along its z axis. Returns this model."""
        return self._shape(name, capsule(radius, length), mass, pose, look)

    def joint(self, name: str, kind: str, parent: str, child: str, *, axis: Optional[Sequence[float]] = None,
              axis2: Optional[Sequence[float]] = None, at: ArrayLike = (0, 0, 0), lower: float = -math.inf,
              upper: float = math.inf, effort: float = math.inf, velocity: float = math.inf, damping: float = 0.0,
              friction: float = 0.0) -> ModelBuilder:
        """Joins two links of this model. Returns this model.

        Args:
            kind: "fixed", "ball", "revolute", "continuous", "prismatic" or "universal".
            parent, child: names of links; the parent may be "world".
            axis, axis2: directions in the joint's frame; None: z (of `axis2`: y).
            at: pose of the joint's frame in the child's frame.
            lower, upper: limits, rad or m.
            effort, velocity: bounds of its motor, N m or N, rad/s or m/s.
            damping, friction: N m s/rad or N s/m; N m or N.

        Raises:
            UnknownNameError: there is no such link or type of joint.
            ArgumentError: the name is taken, both links are one, the limits cross, an axis is zero or not wanted.
        """
        where = f"joint '{name}' of model '{self.name}'"
        if kind not in JOINT_AXES:
            raise unknown("type of joint", kind, JOINT_AXES)
        checked_name("joint", name, self._joints)
        for link in (parent, child):
            if link not in self._links and not (link == "world" and link is parent):
                raise unknown("link", link, ["world", *self._links] if link is parent else self._links,
                              f" in model '{self.name}'")
        if parent == child:
            raise ArgumentError(f"{where}: parent and child are both '{child}'", "join two links")
        given = [axis, axis2]
        for number in range(JOINT_AXES[kind], 2):
            if given[number] is not None:
                raise ArgumentError(f"{where}: a {kind} joint has no {'axis2' if number else 'axis'}", "leave it out")
        if not real(f"{where}: lower", lower) <= real(f"{where}: upper", upper):
            raise ArgumentError(f"{where}: limits from {lower} to {upper}", "the lower one comes first")
        element = ET.Element("joint", name=name, type=kind)
        put(element, "parent", parent)
        put(element, "child", child)
        put_pose(element, where, at)
        for number, usual in enumerate([(0, 0, 1), (0, 1, 0)][:JOINT_AXES[kind]]):
            values = {"lower": lower, "upper": upper, "effort": effort, "velocity": velocity}
            dynamics = {"damping": damping, "friction": friction}
            _put_axis(element, where, "axis2" if number else "axis", given[number] if given[number] is not None else usual,
                      values, dynamics)
        self._element.append(element)
        self._joints.append(name)
        return self

    def _shape(self, name: str, shape: Shape, mass: Optional[float], pose: ArrayLike, look: dict) -> ModelBuilder:
        where = f"link '{name}' of model '{self.name}'"
        if mass is None and not self._static:
            raise ArgumentError(f"{where} has no mass, but the model moves", "give a mass in kg, or make the model static")
        return self._add_link(name, shape.described(where, mass, look), pose)

    def _add_link(self, name: str, parts: list[Element], pose: ArrayLike) -> ModelBuilder:
        link = ET.Element("link", name=checked_name("link", name, ("world", *self._links)))
        put_pose(link, f"link '{name}' of model '{self.name}'", pose)
        link.extend(parts)
        self._element.append(link)
        self._links.append(name)
        return self

    def __repr__(self) -> str:
        return f"<roboss.ModelBuilder '{self.name}': {len(self._links)} links, {len(self._joints)} joints>"


def _put_axis(joint: Element, where: str, tag: str, direction: Sequence[float], limits: dict, dynamics: dict) -> None:
    axis = ET.SubElement(joint, tag)
    put(axis, "xyz", unit_vector(f"{where}: {tag}", direction))
    limit = ET.SubElement(axis, "limit")
    for name, value in limits.items():
        if math.isfinite(real(f"{where}: {name}", value)):
            put(limit, name, value)
    place = ET.SubElement(axis, "dynamics")
    for name, value in dynamics.items():
        if not math.isfinite(real(f"{where}: {name}", value, 0)):
            raise ArgumentError(f"{where}: {name} of {value}", "give a finite number")
        put(place, name, value)
