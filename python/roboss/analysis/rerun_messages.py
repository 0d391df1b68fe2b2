"""Messages of a recording as Rerun has them: images, scans, contact points, texts."""
from __future__ import annotations

import json
from typing import Any, Mapping

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from .messages import MessageVariable

_ENCODINGS: dict[str, tuple[str, int]] = {"rgb8": ("u1", 3), "mono8": ("u1", 1), "mono16": ("<u2", 1), "32FC1": ("<f4", 1)}
_CONTACT_RGB, _DOT = (230, 120, 20), rr.Radius.ui_points(2.5)
_FORCE_SCALE = 0.01  # m per N


def is_image(variable: MessageVariable) -> bool:
    """True if the values are images."""
    return variable.layout.name == "foxglove.RawImage"


def is_text(variable: MessageVariable) -> bool:
    """True if the values are texts, not things in space."""
    return variable.layout.name not in ("foxglove.RawImage", "foxglove.LaserScan", "foxglove.PointCloud", "roboss.Contacts")


def drawn_message(variable: MessageVariable, value: Any) -> list[Any]:
    """Archetypes of Rerun for a value, to be logged one after the other at one entity path."""
    name = variable.layout.name
    if is_image(variable):
        return [_image(variable.name.rsplit(".", 1)[-1], value)]
    if name == "foxglove.LaserScan":
        return [_points(_scan(value))]
    if name == "foxglove.PointCloud":
        fields = value["point_stride"] // 4
        return [_points(np.frombuffer(value["data"], "<f4").reshape(-1, fields)[:, :3])]
    if name == "roboss.Contacts":
        return [_contacts(value)]
    if name == "roboss.RadioMessages":
        return [rr.TextLog(_heard(message), level="INFO") for message in value]
    return [rr.TextDocument(json.dumps(value, indent=1))]


def _image(kind: str, value: Mapping[str, Any]) -> Any:
    dtype, channels = _ENCODINGS[value["encoding"]]
    shape = (value["height"], value["width"]) + ((channels,) if channels > 1 else ())
    image: NDArray[Any] = np.frombuffer(value["data"], dtype).reshape(shape)
    if kind == "depth":
        return rr.DepthImage(image, meter=1.0)
    if kind in ("labels", "instances"):
        return rr.SegmentationImage(image)
    return rr.Image(image, color_model="RGB" if channels > 1 else "L")


def _scan(value: Mapping[str, Any]) -> NDArray[np.float64]:
    """The points that the beams of a scan of one row meet, in the axes of the laser."""
    ranges = np.array(value["ranges"])
    angles = np.linspace(value["start_angle"], value["end_angle"], len(ranges))
    met = np.isfinite(ranges)
    directions = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(len(angles))])
    points: NDArray[np.float64] = ranges[met, None] * directions[met]
    return points


def _points(points: NDArray[Any]) -> rr.Points3D:
    return rr.Points3D(points, radii=_DOT)


def _contacts(points: list[Mapping[str, Any]]) -> rr.Arrows3D:
    """Arrows of the forces on A, 1 m for 100 N, from the points."""
    vectors = {name: np.array([list(point[name].values()) for point in points]).reshape(-1, 3) for name in ("position", "force")}
    return rr.Arrows3D(origins=vectors["position"], vectors=_FORCE_SCALE * vectors["force"], colors=[_CONTACT_RGB],
                       labels=[" - ".join(filter(None, (point["robot_a"], point["robot_b"]))) for point in points],
                       show_labels=False)


def _heard(message: Mapping[str, Any]) -> str:
    payload: bytes = message["payload"]
    text = payload.decode("ascii", "replace")
    shown = text if text.isprintable() and "\ufffd" not in text else payload.hex()
    return f"from {message['sender']}, sent at {message['sent']:g} s, {message['strength']:.1f} dBm: {shown}"
