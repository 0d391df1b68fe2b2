"""JointParameters: numbers of the joints of some robots that may differ from robot to robot and change."""
from __future__ import annotations

from typing import TYPE_CHECKING, Iterable, Iterator, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .errors import ArgumentError
from .names import index_of, text

if TYPE_CHECKING:
    from .robots import Robots

Floats = NDArray[np.float64]
_NAMES: list[str] = [row[0] for row in _core.joint_parameters]


class JointParameters:
    """Numbers of the joints of some robots. Robots.parameters makes it; N is the number of robots.

    A robot has the numbers of its type, those of the file, until it is given own ones. Own numbers are part of its
    state: saves, branches, journals and hashes have them, and a reset of the simulation takes them back.

    What is assigned is in effect at once, as other states are; of a RemoteSimulation, and with `set_joint_targets`,
    from the next tick on. It takes a full array, one row for all robots, or one number for everything; if one robot
    refuses it (OrderError), nothing is changed. Columns are Robots.joints; "rad" and "N m" stand for joints that turn,
    "m" and "N" for those that slide:

    | name | unit | |
    |---|---|---|
    | `damping` | N m s/rad or N s/m | of the joint |
    | `friction` | N m or N | Coulomb friction of the joint |
    | `spring_stiffness`, `spring_reference` | N m/rad or N/m, rad or m | its spring, and where that is relaxed |
    | `armature` | kg m^2 or kg | rotor inertia at the joint |
    | `position_gain`, `velocity_gain` | N m/rad or N/m, N m s/rad or N s/m | kp and kd of its motor, implicit |
    | `max_effort`, `max_velocity` | N m or N, rad/s or m/s | of its motor; infinite: no bound |
    | `lower`, `upper` | rad or m | limits, within those of the file |
    | `limit_stiffness`, `limit_dissipation` | N m/rad or N/m, N m s/rad or N s/m | of limits that give way |

    Arrays are (N, joints), read-only copies: assign them as a whole. Of a Batch they are (simulations, N, joints).

    >>> sim = roboss.Simulation(roboss.example("arm.sdf"))
    >>> parameters = sim.robots("arm").parameters
    >>> parameters["damping"] = 2 * parameters["damping"]
    >>> parameters.set("shoulder", position_gain=800, velocity_gain=40)     # some joints, some numbers
    >>> parameters["position_gain"]
    array([[  0., 800.,   0.,   0.,   0.,   0.]])
    >>> parameters.units("damping")[0]
    'N m s/rad'
    """

    def __init__(self, robots: Robots):
        self._robots = robots

    def __iter__(self) -> Iterator[str]:
        return iter(_NAMES)

    def __len__(self) -> int:
        return len(_NAMES)

    def __contains__(self, name: object) -> bool:
        return name in _NAMES

    def __repr__(self) -> str:
        return f"<roboss.JointParameters of {len(self._robots)} robots: {', '.join(_NAMES)}>"

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return tuple(_NAMES)

    def units(self, name: str) -> tuple[str, ...]:
        """Unit of the parameter in each column: "N m s/rad" of a joint that turns, "N s/m" of one that slides."""
        _, turning, sliding = _core.joint_parameters[_number(name)]
        return tuple(turning if unit == "rad" else sliding for unit in self._robots._joint_facts.units)

    def __getitem__(self, name: str) -> Floats:
        return self._read(name, False)

    def __setitem__(self, name: str, values: ArrayLike) -> None:
        self._set(None, {text("name", name): values})

    def of_file(self, name: str) -> Floats:
        """What the world's file has, (N, joints), whatever own numbers the robots have."""
        return self._read(name, True)

    def set(self, joints: Union[str, Iterable[str], None] = None, /, **values: ArrayLike) -> None:
        """Sets several parameters of some joints in one go: of each robot all, or, if one robot refuses, of none.

        Args:
            joints: names of the columns of the arrays; None: all joints.
            values: by the name of the parameter, (N, joints); one row for all robots; one number.

        >>> arm = roboss.Simulation(roboss.example("arm.sdf")).robots("arm")
        >>> arm.parameters.set(["elbow", "yaw"], lower=-1.0, upper=[0.5, 1.5])
        >>> arm.parameters["upper"][0, :3]
        array([1.5, 1.9, 0.5])
        """
        self._set(joints, values)

    def reset(self, joints: Union[str, Iterable[str], None] = None) -> None:
        """Gives all numbers of some joints back to the file's. Robots that have no own ones left are as if they never
        had any: their hashes are the same.

        Args:
            joints: names; None: all joints.
        """
        self._robots._core.reset_joint_parameters(self._robots._joint_columns(joints))

    def _set(self, joints: Union[str, Iterable[str], None], values: dict[str, ArrayLike]) -> None:
        if not values:
            raise ArgumentError("no parameter is given", f"give some of {', '.join(_NAMES)}", "no-parameter")
        columns = self._robots._joint_columns(joints)
        parameters = [_number(name) for name in values]
        arrays = [self._robots._fill(name, array, len(columns)) for name, array in values.items()]
        self._robots._core.set_joint_parameters(columns, parameters, np.ascontiguousarray(np.stack(arrays, axis=-2)))

    def _read(self, name: str, of_file: bool) -> Floats:
        out = np.empty((*self._robots._rows, len(self._robots._joint_facts.axes)))
        self._robots._core.joint_parameters(_number(name), of_file, out)
        out.setflags(write=False)
        return out


def _number(name: str) -> int:
    return index_of("parameter", text("name", name), _NAMES, " of joints")
