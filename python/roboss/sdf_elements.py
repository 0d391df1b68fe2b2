"""Elements of SDFormat with numbers that were checked: what WorldBuilder writes."""
from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from typing import Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import ArgumentError
from .names import numbers, real

Element = ET.Element


def put(parent: Element, tag: str, value: Union[str, float, Sequence[float]]) -> Element:
    """A child with this text; numbers with all their digits."""
    element = ET.SubElement(parent, tag)
    element.text = value if isinstance(value, str) else " ".join(repr(float(x)) for x in np.atleast_1d(value))
    return element


def put_pose(parent: Element, where: str, pose: ArrayLike) -> None:
    """A pose of 3 or 7 numbers, as SDFormat has it."""
    array = numbers(f"{where}: pose", pose).ravel()
    if array.size not in (3, 7) or not np.isfinite(array).all():
        raise ArgumentError(f"{where}: a pose of {array.tolist()}", "give x y z, or x y z and a quaternion x y z w", "bad-pose")
    length = float(np.linalg.norm(array[3:])) if array.size == 7 else 1.0
    if not length > 1e-6:
        raise ArgumentError(f"{where}: a quaternion of length 0", "0 0 0 1 is no rotation", "bad-pose")
    rotation = array[3:] / length if array.size == 7 else (0, 0, 0, 1)
    put(parent, "pose", [*array[:3], *rotation]).set("rotation_format", "quat_xyzw")


def checked_name(kind: str, name: str, taken: Sequence[str]) -> str:
    """The name, if it can be one and is not taken."""
    if not isinstance(name, str) or not name or "::" in name or name != name.strip():
        raise ArgumentError(f"a {kind} called {name!r}", "give a name without '::' and without spaces around it", "bad-name")
    if name in taken:
        raise ArgumentError(f"a {kind} '{name}' is there already", "give each a name of its own", "name-taken")
    return name


def vector(what: str, values: ArrayLike, size: int) -> NDArray[np.float64]:
    """An array of `size` finite numbers."""
    array = numbers(what, values).ravel()
    if array.size != size or not np.isfinite(array).all():
        raise ArgumentError(f"{what} of {array.tolist()}", f"give {size} finite numbers", "bad-shape")
    return array


def unit_vector(what: str, values: ArrayLike) -> NDArray[np.float64]:
    """A direction of length 1."""
    array = vector(what, values, 3)
    length = float(np.linalg.norm(array))
    if not length > 1e-9:
        raise ArgumentError(f"{what} is zero", "give a direction, as [0, 0, 1]", "bad-shape")
    return array / length


def positive(what: str, value: float) -> float:
    """The number, if it is above 0."""
    value = real(what, value)
    if not (math.isfinite(value) and value > 0):
        raise ArgumentError(f"{what} of {value}", "give a number above 0")
    return value


def rgba(where: str, color: Sequence[float]) -> NDArray[np.float64]:
    """Red, green, blue and alpha."""
    array = numbers(f"{where}: color", color).ravel()
    if array.size not in (3, 4) or not ((array >= 0) & (array <= 1)).all():
        raise ArgumentError(f"{where}: a color of {array.tolist()}", "give red, green, blue from 0 to 1, or with alpha",
                            "bad-color")
    return array if array.size == 4 else np.append(array, 1.0)
