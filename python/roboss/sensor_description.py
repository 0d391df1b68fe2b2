"""What the arrays of a sensor are of: its place, its parameters, and unit, frame and shape of each value."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping, Optional

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

#: Frames of values that have a direction or a place, by kind of sensor and name. "parameter": see _frame_of.
_FRAMES = {
    ("laser", "ranges"): "sensor", ("sonar", "range"): "sensor", ("infrared", "range"): "sensor",
    ("gps", "world"): "world", ("gps", "velocity"): "world",
    ("gps", "latitude"): "WGS84", ("gps", "longitude"): "WGS84", ("gps", "altitude"): "WGS84",
    ("compass", "orientation_quat_xyzw"): "world", ("compass", "angular_velocity"): "sensor",
    ("compass", "magnetic_field"): "sensor", ("compass", "heading"): "north",
    ("imu", "specific_force"): "sensor", ("imu", "angular_velocity"): "sensor",
    ("imu", "orientation_quat_xyzw"): "parameter", ("magnetometer", "field"): "sensor",
    ("altimeter", "vertical_position"): "world", ("altimeter", "vertical_velocity"): "world",
    ("altimeter", "reference"): "world", ("air speed", "diff_pressure"): "sensor",
    ("contact", "positions"): "world", ("contact", "normals"): "world", ("contact", "forces"): "world",
    ("force-torque", "force"): "parameter", ("force-torque", "torque"): "parameter",
    ("odometry", "position"): "world", ("odometry", "orientation_quat_xyzw"): "world",
    ("odometry", "linear_velocity"): "parameter", ("odometry", "angular_velocity"): "parameter",
    ("wheel odometry", "x"): "start", ("wheel odometry", "y"): "start", ("wheel odometry", "heading"): "start",
    ("wheel odometry", "linear"): "robot", ("wheel odometry", "angular"): "robot",
    ("link poses", "positions"): "robot", ("link poses", "orientations_quat_xyzw"): "robot",
    ("logical camera", "positions"): "sensor", ("logical camera", "orientations_quat_xyzw"): "sensor",
    ("box camera", "positions"): "camera", ("box camera", "orientations_quat_xyzw"): "camera",
    ("box camera", "boxes"): "image",
}
#: Kinds whose readings have another length each time.
_VARYING = ("contact", "logical camera", "box camera", "radio", "microphone")


@dataclass(frozen=True)
class ValueDescription:
    """What one value of Sensor.read_all() is.

    Attributes:
        name: in Sensor.read_all().
        unit: "m", "rad/s" ...; "" for counts, ratios, rotations.
        frame: in whose axes, or from whose origin: "sensor", "camera", "image" (pixels from its upper left corner),
            "robot", "world", "start" (where the robot was at the start), "north", "WGS84", the name of a frame; "": it has
            no direction.
        shape: of one robot's reading; None: another length each time.
        dtype: of the array; "object": texts.
    """

    name: str
    unit: str
    frame: str
    shape: tuple[Optional[int], ...]
    dtype: str


@dataclass(frozen=True)
class Parameter:
    """A parameter of a sensor: its value, as the world has it, and its unit. Noise is a dict, in the value's unit."""

    value: Any
    unit: str


@dataclass(frozen=True, eq=False)
class SensorDescription:
    """A sensor as the world has it. Sensor.description makes it.

    The sensor looks along x of its frame, y is left, z is up.

    Attributes:
        name: as in the world file.
        kind: "laser", "imu", "camera" ...
        link: name of the link that carries it.
        pose: of the sensor in that link, (7,): x y z in m, quaternion x y z w.
        update_rate: Hz, in the world file; 0: it measures on request.
        values: what Sensor.read_all() has, by name.
        parameters: of its kind, by name (docs/sensors.md): of a laser "range_min", "range_max" ...
        column_angles, row_angles: of a laser: of its columns about z, of its rows above the xy plane, rad; else empty.
    """

    name: str
    kind: str
    link: str
    pose: Floats
    update_rate: float
    values: Mapping[str, ValueDescription]
    parameters: Mapping[str, Parameter]
    column_angles: Floats
    row_angles: Floats

    @property
    def directions(self) -> Floats:
        """Of a laser: unit vectors along the beams in the sensor's frame, (beams, 3), in the order of the ranges."""
        rows, columns = np.meshgrid(self.row_angles, self.column_angles, indexing="ij")
        return np.stack([np.cos(rows) * np.cos(columns), np.cos(rows) * np.sin(columns), np.sin(rows)], axis=-1).reshape(-1, 3)

    @property
    def range(self) -> Optional[tuple[float, float]]:
        """Least and largest distance that it measures, m; None: it measures none."""
        for least, most in (("range_min", "range_max"), ("near", "far")):
            if most in self.parameters:
                return self.parameters[least].value if least in self.parameters else 0.0, self.parameters[most].value
        return None

    @property
    def intrinsics(self) -> Optional[Floats]:
        """Of a pinhole camera: the matrix (3, 3) from a point to pixels; None: it is none.

        A point (x, y, z) of the camera's frame, x ahead, is seen at column u and row v with (u, v, 1) = K (-y, -z, x) / x,
        counted in pixels from the upper left corner of the image; centres of pixels are at .5. Distortion is not in it.
        """
        parameter = {name: entry.value for name, entry in self.parameters.items()}
        if "horizontal_fov" not in parameter or parameter.get("lens", "gnomonical") != "gnomonical":
            return None
        width, height = parameter["width"], parameter["height"]
        if parameter.get("fx", 0) > 0:
            fx, fy, skew = parameter["fx"], parameter["fy"], parameter["skew"]
            return np.array([[fx, skew, parameter["cx"]], [0, fy, parameter["cy"]], [0, 0, 1.0]])
        focal = width / (2 * np.tan(parameter["horizontal_fov"] / 2))
        return np.array([[focal, 0, width / 2], [0, focal, height / 2], [0, 0, 1.0]])


def describe(name: str, facts: Mapping[str, Any], reading: Mapping[str, Any], units: Mapping[str, str]) -> SensorDescription:
    """The description of a sensor from facts of its world (_core.facts_of_sensor) and a reading of one robot."""
    parameters = {name: Parameter(value, unit) for name, unit, value in facts["parameters"]}
    values = {}
    for value_name, value in reading.items():
        array = np.asarray(value[0])
        shape: tuple[Optional[int], ...] = array.shape
        if facts["kind"] in _VARYING and array.ndim > 0 and value_name not in ("intrinsics", "distortion"):
            shape = (None, *array.shape[1:])
        dtype = "object" if array.dtype.kind in "US" or isinstance(value[0], list) else array.dtype.name
        frame = _frame_of(facts["kind"], value_name, parameters)
        values[value_name] = ValueDescription(value_name, units[value_name], frame, shape, dtype)
    return SensorDescription(name, facts["kind"], facts["link"], np.array(facts["pose"]), facts["update_rate"], values,
                             parameters, np.array(facts["columns"]), np.array(facts["rows"]))


def _frame_of(kind: str, name: str, parameters: Mapping[str, Parameter]) -> str:
    frame = _FRAMES.get((kind, name), "")
    if frame != "parameter":
        return frame
    if kind == "imu":
        return str(parameters["localization"].value)
    if kind == "odometry":
        return "world" if parameters["world_axes"].value else "robot"
    return str(parameters["frame"].value)
