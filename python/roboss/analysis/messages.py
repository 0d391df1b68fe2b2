"""What is recorded as messages, because it is no fixed list of numbers: contacts, images, what radios heard, readings
whose length changes; and laser scans, so that viewers draw them."""
from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Callable, Mapping, Union

import numpy as np

from ..errors import ArgumentError, SensorError
from ..robots import Robots
from ..run import Run
from ..sensors import Sensor

#: Kinds of sensors whose readings are images, or lists that change their length.
AS_MESSAGES = ("camera", "contact", "radio")
_IMAGES = {("uint8", 3): "rgb8", ("uint8", 2): "mono8", ("uint16", 2): "mono16", ("float32", 2): "32FC1"}
_LONGEST_RADIO_PAUSE = 1.0  # s: a radio shows what arrived within the last second
_CONTACT = {"robot_a": "text", "link_a": "text", "robot_b": "text", "link_b": "text", "position": "vector",
            "normal": "vector", "gap": "number", "force": "vector", "torque": "vector"}
_CONTACT_UNITS = {"position": "m", "gap": "m", "force": "N", "torque": "N m"}
_IMAGE = {"height": "whole", "width": "whole", "encoding": "text", "step": "whole", "data": "bytes"}
_SCAN = {"pose": "pose", "start_angle": "number", "end_angle": "number", "ranges": "numbers", "intensities": "numbers"}
_SCAN_UNITS = {"start_angle": "rad", "end_angle": "rad", "ranges": "m"}
_CLOUD = {"pose": "pose", "point_stride": "whole", "fields": "packed fields", "data": "bytes"}
_FLOAT32 = 7  # among the numeric types of foxglove.PackedElementField
_HEARD = {"sender": "text", "sent": "number", "arrived": "number", "strength": "number", "payload": "bytes"}
_HEARD_UNITS = {"sent": "s", "arrived": "s", "strength": "dBm"}
_Read = Callable[[Robots, float], list]


@dataclass(frozen=True)
class Layout:
    """What a message consists of.

    Attributes:
        name: of its schema: "foxglove.RawImage", "roboss.Contacts".
        fields: type of each field: "text", "whole", "number", "bytes", "vector" (x y z), "pose" (a vector "position", a
            quaternion "orientation"), or a list: "texts", "numbers", "rows" (a list of lists of numbers), "packed fields"
            (the columns of binary data: "name", "offset", "type").
        units: of fields.
        listed: the message is a list of such things, under this name; "": it is one.
    """

    name: str
    fields: Mapping[str, str]
    units: Mapping[str, str] = field(default_factory=dict)
    listed: str = ""


@dataclass(frozen=True)
class MessageVariable:
    """A variable whose values are messages.

    Attributes:
        name: "car_3.eye.color", "contact_points".
        layout: of its values.
        frame: in whose axes vectors are, or whose camera it is.
    """

    name: str
    layout: Layout
    frame: str = "world"


@dataclass(frozen=True)
class MessageKind:
    """A variable that all robots of a type have: its name behind the robot's, and how to read it.

    Attributes:
        name: "eye.color"; "" with the name in `variable` where it is of the whole run.
        layout: of its values.
        read: values of robots, one for each, from the robots and the time of the sample before.
        of_sensor: its frame is that of the sensor.
        longest: time between two samples beyond which something is missing, s.
    """

    name: str
    layout: Layout
    read: _Read
    of_sensor: bool = False
    longest: float = np.inf

    def variable(self, robot: str) -> MessageVariable:
        """That of a robot."""
        name = f"{robot}.{self.name}"
        return MessageVariable(name, self.layout, name.rsplit(".", 1)[0] if self.of_sensor else "world")


_CONTACTS = Layout("roboss.Contacts", _CONTACT, _CONTACT_UNITS, "contacts")
#: All contact points of a run.
WORLD_CONTACTS = MessageVariable("contact_points", _CONTACTS)


def kinds_of(robots: Robots) -> list[MessageKind]:
    """What the robots of a type give as messages."""
    kinds = [MessageKind("contact_points", _CONTACTS, _contacts_of_robots)]
    for number, name in enumerate(sensor_names(robots)):
        sensor = robots[:1]._sensor(number)
        if any(word in sensor.kind for word in AS_MESSAGES):
            kinds += _of_sensor(name, sensor)
        elif sensor.kind == "laser":
            kinds.append(_of_laser(name, sensor))
    return kinds


def sensor_names(robots: Robots) -> list[str]:
    """A name of its own for each sensor: of equal ones the second gets `_2`, the third `_3`, as their topics do.

    A robot whose links have a sensor "scan" each, one of them with a "scan_2" besides, records "scan", "scan_2", "scan_3".
    """
    names: list[str] = []
    for name in robots.sensors:
        numbered = (f"{name}_{number}" for number in range(2, len(robots.sensors) + 2))
        taken = {*names, *robots.sensors}
        names.append(name if name not in names else next(new for new in numbered if new not in taken))
    return names


def contacts_of(run: Run) -> list[dict[str, Any]]:
    """The contact points of a run, as messages have them."""
    world = run.world
    links = {number: world._facts_of(number).links for number in _robots_in(run.contacts)}
    found = []
    for point in run.contacts:
        message: dict[str, Any] = {}
        for side in "ab":
            robot = int(point[f"robot_{side}"])
            message[f"robot_{side}"] = world.robots[robot] if robot >= 0 else ""
            message[f"link_{side}"] = links[robot][point[f"link_{side}"]] if robot >= 0 else ""
        for name, kind in _CONTACT.items():
            if kind == "vector":
                message[name] = dict(zip("xyz", point[name].tolist()))
            elif kind == "number":
                message[name] = float(point[name])
        found.append(message)
    return found


def _robots_in(contacts: Any) -> list[int]:
    numbers = np.unique(np.concatenate([contacts["robot_a"], contacts["robot_b"]]))
    return [int(number) for number in numbers if number >= 0]


def _contacts_of_robots(robots: Robots, _: float) -> list[list[dict[str, Any]]]:
    """For each robot the contact points in which it takes part."""
    points: dict[str, list] = {name: [] for name in robots.names}
    for point in contacts_of(robots.simulation):
        for robot in {point["robot_a"], point["robot_b"]} & points.keys():
            points[robot].append(point)
    return list(points.values())


def _of_sensor(name: str, sensor: Sensor) -> list[MessageKind]:
    try:
        reading, units = sensor.read_all(), sensor.units
    except SensorError:  # it cannot measure in this world
        return []
    number = sensor._number
    if sensor.kind == "radio":
        return [MessageKind(f"{name}.messages", Layout("roboss.RadioMessages", _HEARD, _HEARD_UNITS, "messages"),
                            lambda r, since: _heard(r._sensor(number), since), longest=_LONGEST_RADIO_PAUSE)]
    images = [value for value, array in reading.items() if _encoding(array)]
    kinds = [MessageKind(f"{name}.{value}", Layout("foxglove.RawImage", _IMAGE), _image_reader(number, value), True)
             for value in images]
    if not images:
        fields = {value: _type_of(array[0]) for value, array in reading.items()}
        layout = Layout("roboss." + "".join(word.capitalize() for word in sensor.kind.split()), fields, units)
        kinds.append(MessageKind(f"{name}.reading", layout, lambda r, _: _readings(r._sensor(number)), "camera" in sensor.kind))
    return kinds


def _of_laser(name: str, laser: Sensor) -> MessageKind:
    """A scan of one row with even angles, or else a cloud of the points that the beams meet. Its pose is in the world, so
    that it is drawn in place without the frames of the robot."""
    link, mounted, columns, rows = laser._beams()
    number = laser._number

    def poses(robots: Robots) -> list[dict[str, Any]]:
        return [_pose(composed(pose, mounted)) for pose in robots.link_pose(link)]

    def intensities(values: Mapping[str, Any], robot: int) -> np.ndarray:
        return np.asarray(values["intensities"][robot] if "intensities" in values else [], dtype=float)

    def scans(robots: Robots, _: float) -> list[dict[str, Any]]:
        values = robots._sensor(number).read_all()
        return [{"pose": pose, "start_angle": float(columns[0]), "end_angle": float(columns[-1]),
                 "ranges": values["ranges"][robot].tolist(), "intensities": intensities(values, robot).tolist()}
                for robot, pose in enumerate(poses(robots))]

    def clouds(robots: Robots, _: float) -> list[dict[str, Any]]:
        values = robots._sensor(number).read_all()
        return [_cloud(pose, values["ranges"][robot], directions, intensities(values, robot))
                for robot, pose in enumerate(poses(robots))]

    if len(rows) == 1 and rows[0] == 0 and np.allclose(np.diff(columns, 2), 0):
        return MessageKind(f"{name}.scan", Layout("foxglove.LaserScan", _SCAN, _SCAN_UNITS), scans)
    across, up = np.meshgrid(columns, rows)
    directions = np.stack([np.cos(up) * np.cos(across), np.cos(up) * np.sin(across), np.sin(up)], axis=-1).reshape(-1, 3)
    return MessageKind(f"{name}.points", Layout("foxglove.PointCloud", _CLOUD), clouds)


def _cloud(pose: dict[str, Any], ranges: np.ndarray, directions: np.ndarray, intensities: np.ndarray) -> dict[str, Any]:
    """A foxglove.PointCloud of the beams that met something."""
    met = np.isfinite(ranges)
    points = (ranges[:, None] * directions)[met]
    names = ["x", "y", "z"]
    if intensities.size:
        names.append("intensity")
        points = np.column_stack([points, intensities[met]])
    fields = [{"name": field, "offset": 4 * place, "type": _FLOAT32} for place, field in enumerate(names)]
    return {"pose": pose, "point_stride": 4 * len(names), "fields": fields, "data": points.astype("<f4").tobytes()}


def composed(outer: np.ndarray, inner: np.ndarray) -> np.ndarray:
    """The pose `inner`, given in the axes of `outer`, where `outer` is given: (7,) each, x y z and a quaternion x y z w."""
    u, w, v, s = outer[3:6], outer[6], inner[3:6], inner[6]
    turned = inner[:3] + 2 * np.cross(u, np.cross(u, inner[:3]) + w * inner[:3])
    return np.concatenate([outer[:3] + turned, w * v + s * u + np.cross(u, v), [w * s - u @ v]])


def _pose(pose: np.ndarray) -> dict[str, Any]:
    numbers = pose.tolist()
    return {"position": dict(zip("xyz", numbers[:3])), "orientation": dict(zip("xyzw", numbers[3:]))}


def _encoding(array: Any) -> str:
    """Name of the encoding of images, as foxglove.RawImage and ROS have it; "": they are none."""
    return _IMAGES.get((array.dtype.name, array.ndim - 1), "") if isinstance(array, np.ndarray) else ""


def _image_reader(number: int, value: str) -> _Read:
    def read(robots: Robots, _: float) -> list[dict[str, Any]]:
        array = robots._sensor(number).read_all()[value]
        encoding = _encoding(array)
        return [{"height": image.shape[0], "width": image.shape[1], "encoding": encoding, "step": image.strides[0],
                 "data": image.tobytes()} for image in np.ascontiguousarray(array)]
    return read


def _type_of(value: Any) -> str:
    if isinstance(value, list):
        return "texts"
    return ("number", "numbers", "rows")[np.ndim(value)]


def _readings(sensor: Sensor) -> list[dict[str, Any]]:
    values = sensor.read_all()
    return [{name: value[row] if isinstance(value[row], list) else np.asarray(value[row], dtype=float).tolist()
             for name, value in values.items()} for row in range(len(sensor.robots))]


def _heard(radio: Sensor, since: float) -> list[list[dict[str, Any]]]:
    """For each radio what arrived after a time."""
    values = radio.read_all()
    rows = []
    for columns in zip(*(values[name] for name in ("senders", "sent", "arrived", "strengths", "payloads"))):
        rows.append([{"sender": sender, "sent": float(sent), "arrived": float(arrived), "strength": float(strength),
                      "payload": bytes.fromhex(payload)}
                     for sender, sent, arrived, strength, payload in zip(*columns) if arrived > since + 1e-9])
    return rows


class Messages:
    """The messages of a run that were chosen; `read` gives their values at the present tick."""

    def __init__(self, run: Run):
        self.variables: list[MessageVariable] = []  #: of the lists of read()
        self._run, self._since, self._longest = run, -np.inf, np.inf
        self._parts: list[tuple[Union[Robots, None], Union[_Read, None]]] = []

    def add_world_contacts(self) -> None:
        """Adds all contact points."""
        self.variables.append(WORLD_CONTACTS)
        self._parts.append((None, None))

    def add(self, robots: Robots, kind: MessageKind) -> None:
        """Adds a variable of each of the robots."""
        self.variables += [kind.variable(robot) for robot in robots.names]
        self._parts.append((robots, kind.read))
        self._longest = min(self._longest, kind.longest)

    def read(self) -> list[Any]:
        """Values at the present tick, one for each variable. Radios give what arrived since the call before.

        Raises ArgumentError if that was too long ago (code "bad-value").
        """
        now = self._run.time
        if now - self._since > self._longest + 1e-9 and self._since >= 0:
            raise ArgumentError(f"{now - self._since:g} s between two samples of a radio, which keeps messages for "
                                f"{self._longest:g} s", f"sample at least every {self._longest:g} s (--every)", "bad-value")
        values: list[Any] = []
        for robots, read in self._parts:
            values += [contacts_of(self._run)] if robots is None else read(robots, self._since)
        self._since = now
        return values
