"""What is recorded as messages, because it is no fixed list of numbers: contacts, images, what radios heard, readings
whose length changes."""
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
_HEARD = {"sender": "text", "sent": "number", "arrived": "number", "strength": "number", "payload": "bytes"}
_HEARD_UNITS = {"sent": "s", "arrived": "s", "strength": "dBm"}
_Read = Callable[[Robots, float], list]


@dataclass(frozen=True)
class Layout:
    """What a message consists of.

    Attributes:
        name: of its schema: "foxglove.RawImage", "roboss.Contacts".
        fields: type of each field: "text", "whole", "number", "bytes", "vector" (x y z), or a list: "texts", "numbers",
            "rows" (a list of lists of numbers).
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
    for name in dict.fromkeys(robots.sensors):  # of equal names the first
        sensor = robots[:1][name]
        if isinstance(sensor, Sensor) and any(word in sensor.kind for word in AS_MESSAGES):
            kinds += _of_sensor(name, sensor)
    return kinds


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
    if sensor.kind == "radio":
        return [MessageKind(f"{name}.messages", Layout("roboss.RadioMessages", _HEARD, _HEARD_UNITS, "messages"),
                            lambda r, since: _heard(r[name], since), longest=_LONGEST_RADIO_PAUSE)]
    images = [value for value, array in reading.items() if _encoding(array)]
    kinds = [MessageKind(f"{name}.{value}", Layout("foxglove.RawImage", _IMAGE), _image_reader(name, value), True)
             for value in images]
    if not images:
        fields = {value: _type_of(array[0]) for value, array in reading.items()}
        layout = Layout("roboss." + "".join(word.capitalize() for word in sensor.kind.split()), fields, units)
        kinds.append(MessageKind(f"{name}.reading", layout, lambda r, _: _readings(r[name]), "camera" in sensor.kind))
    return kinds


def _encoding(array: Any) -> str:
    """Name of the encoding of images, as foxglove.RawImage and ROS have it; "": they are none."""
    return _IMAGES.get((array.dtype.name, array.ndim - 1), "") if isinstance(array, np.ndarray) else ""


def _image_reader(name: str, value: str) -> _Read:
    def read(robots: Robots, _: float) -> list[dict[str, Any]]:
        array = robots[name].read_all()[value]
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
