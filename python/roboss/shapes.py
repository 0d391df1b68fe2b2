"""Shapes of WorldBuilder: their geometry, and the inertia of a homogeneous body of each."""
from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from typing import Any, Optional, Sequence

from .errors import ArgumentError
from .names import real, unknown
from .sdf_elements import positive, put, rgba, unit_vector, vector

_LOOK = ["color", "friction", "restitution"]


@dataclass(frozen=True)
class Shape:
    """A shape around its origin.

    Attributes:
        kind: the element of SDFormat.
        sizes: (element, value) of each of its sizes.
        inertia: moments of inertia about its x, y and z axes for a mass of 1 kg, m^2; None: it cannot move.
    """

    kind: str
    sizes: tuple[tuple[str, Any], ...]
    inertia: Optional[tuple[float, float, float]]

    def described(self, where: str, mass: Optional[float], look: dict[str, Any]) -> list[ET.Element]:
        """The parts of a link that has this shape: inertia, what collides, what is drawn.

        Args:
            where: for messages: "link 'a' of model 'b'".
            mass: kg; None: no inertia.
            look: `color`, `friction`, `restitution`.
        """
        for name in look:
            if name not in _LOOK:
                raise unknown("property", name, _LOOK, f" of {where}")
        for kind, value in self.sizes:
            for number in value if isinstance(value, (list, tuple)) else [value]:
                if kind != "normal":
                    positive(f"{where}: {kind}", number)
        parts = [self._collision(where, look.get("friction"), look.get("restitution")), self._visual(where, look.get("color"))]
        return parts if mass is None else [self._inertial(where, mass), *parts]

    def _inertial(self, where: str, mass: float) -> ET.Element:
        if self.inertia is None:
            raise ArgumentError(f"{where}: a {self.kind} has no mass", "leave the mass out: it stands still")
        element = ET.Element("inertial")
        put(element, "mass", positive(f"{where}: mass", mass))
        tensor = ET.SubElement(element, "inertia")
        for axis, moment in zip("xyz", self.inertia):
            put(tensor, f"i{axis}{axis}", mass * moment)
        for pair in ("ixy", "ixz", "iyz"):
            put(tensor, pair, 0.0)
        return element

    def _collision(self, where: str, friction: Optional[float], restitution: Optional[float]) -> ET.Element:
        element = ET.Element("collision", name="collision")
        element.append(self._geometry())
        surface = ET.Element("surface")
        if friction is not None:
            if not math.isfinite(real(f"{where}: friction", friction, 0)):
                raise ArgumentError(f"{where}: friction of {friction}", "give a finite number")
            ode = ET.SubElement(ET.SubElement(surface, "friction"), "ode")
            put(ode, "mu", friction)
            put(ode, "mu2", friction)
        if restitution is not None:
            if not 0 <= real(f"{where}: restitution", restitution) <= 1:
                raise ArgumentError(f"{where}: restitution of {restitution}", "give 0 to 1")
            bounce = ET.SubElement(surface, "bounce")
            put(bounce, "restitution_coefficient", restitution)
            put(bounce, "threshold", 0.0)
        if len(surface):
            element.append(surface)
        return element

    def _visual(self, where: str, color: Optional[Sequence[float]]) -> ET.Element:
        element = ET.Element("visual", name="visual")
        element.append(self._geometry())
        if color is not None:
            values = rgba(where, color)
            material = ET.SubElement(element, "material")
            put(material, "ambient", values)
            put(material, "diffuse", values)
        return element

    def _geometry(self) -> ET.Element:
        element = ET.Element("geometry")
        shape = ET.SubElement(element, self.kind)
        for name, value in self.sizes:
            put(shape, name, value)
        return element


def box(size: Sequence[float]) -> Shape:
    """Edges along x, y and z, m."""
    x, y, z = (float(edge) for edge in vector("size", size, 3))
    return Shape("box", (("size", [x, y, z]),), ((y * y + z * z) / 12, (x * x + z * z) / 12, (x * x + y * y) / 12))


def sphere(radius: float) -> Shape:
    """Radius in m."""
    radius = real("radius", radius)
    return Shape("sphere", (("radius", radius),), (0.4 * radius**2,) * 3)


def cylinder(radius: float, length: float) -> Shape:
    """Along z; m."""
    radius, length = real("radius", radius), real("length", length)
    across = radius**2 / 4 + length**2 / 12
    return Shape("cylinder", (("radius", radius), ("length", length)), (across, across, radius**2 / 2))


def capsule(radius: float, length: float) -> Shape:
    """A cylinder along z of this length, with half a sphere at each end; m.

    The moments are those of the parts, by their shares of the volume. The centre of a half sphere's mass is 3 r / 8 from
    its flat side; about that centre its moment across is 83 / 320 m r^2.
    """
    radius, length = real("radius", radius), real("length", length)
    rod, ball = math.pi * radius**2 * length, 4 / 3 * math.pi * radius**3
    share = rod / (rod + ball) if rod + ball > 0 else 0.0
    across_rod = radius**2 / 4 + length**2 / 12
    across_ball = 83 / 320 * radius**2 + (length / 2 + 3 / 8 * radius) ** 2
    across = share * across_rod + (1 - share) * across_ball
    return Shape("capsule", (("radius", radius), ("length", length)),
                 (across, across, share * radius**2 / 2 + (1 - share) * 0.4 * radius**2))


def plane(normal: Sequence[float], size: Sequence[float]) -> Shape:
    """Endless where it collides; `size`: what is drawn, m."""
    x, y = (float(edge) for edge in vector("size", size, 2))
    return Shape("plane", (("normal", list(unit_vector("normal", normal))), ("size", [x, y])), None)
