"""Numbers of some robots that may differ from robot to robot and change: of joints and links, gravity and wind."""
from __future__ import annotations

from typing import TYPE_CHECKING, Iterable, Iterator, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .errors import ArgumentError
from .names import index_of, names_of, text

if TYPE_CHECKING:
    from .robots import Robots

Floats = NDArray[np.float64]
Names = Union[str, Iterable[str], None]


class _Parameters:
    """The common part of JointParameters, LinkParameters and Surroundings. `_part`: "joints", "links", "surroundings"."""
    _part: str
    _names: list[str]

    def __init__(self, robots: Robots):
        self._robots = robots

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __contains__(self, name: object) -> bool:
        return name in self._names

    def __repr__(self) -> str:
        return f"<roboss.{type(self).__name__} of {len(self._robots)} robots: {', '.join(self._names)}>"

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return tuple(self._names)

    def __getitem__(self, name: str) -> Floats:
        return self._read(name, False)

    def __setitem__(self, name: str, values: ArrayLike) -> None:
        self._set(None, {text("name", name): values})

    def of_file(self, name: str) -> Floats:
        """The numbers of the world's file, an array as of `parameters[name]`, whatever own numbers the robots have."""
        return self._read(name, True)

    def _number(self, name: str) -> int:
        return index_of("parameter", text("name", name), self._names, f" of {self._part}")

    def _set(self, parts: Names, values: dict[str, ArrayLike]) -> None:
        if not values:
            raise ArgumentError("no parameter is given", f"give some of {', '.join(self._names)}", "no-parameter")
        columns = self._columns(parts)
        numbers = [self._number(name) for name in values]
        arrays = [self._robots._fill(name, array, len(columns)) for name, array in values.items()]
        if parts is None:
            arrays = [self._for_all(name, array) for name, array in zip(values, arrays)]
        self._put(columns, numbers, np.ascontiguousarray(np.stack(arrays, axis=-2)))

    def _read(self, name: str, of_file: bool) -> Floats:
        out = np.empty((*self._robots._rows, self._width()))
        self._fill_in(self._number(name), of_file, out)
        out.setflags(write=False)
        return out

    def _for_all(self, name: str, values: Floats) -> Floats:
        """The values that an assignment to all columns gives."""
        return values

    def _width(self) -> int:
        raise NotImplementedError

    def _columns(self, parts: Names) -> list[int]:
        raise NotImplementedError

    def _fill_in(self, number: int, of_file: bool, out: Floats) -> None:
        raise NotImplementedError

    def _put(self, columns: list[int], numbers: list[int], values: Floats) -> None:
        raise NotImplementedError


class JointParameters(_Parameters):
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
    _part = "joints"
    _names: list[str] = [row[0] for row in _core.joint_parameters]

    def units(self, name: str) -> tuple[str, ...]:
        """Unit of the parameter in each column: "N m s/rad" of a joint that turns, "N s/m" of one that slides."""
        _, turning, sliding = _core.joint_parameters[self._number(name)]
        return tuple(turning if unit == "rad" else sliding for unit in self._robots._joint_facts.units)

    def set(self, joints: Names = None, /, **values: ArrayLike) -> None:
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

    def reset(self, joints: Names = None) -> None:
        """Gives all numbers of some joints back to the file's. Robots that have no own ones left are as if they never
        had any: their hashes are the same.

        Args:
            joints: names; None: all joints.
        """
        self._robots._core.reset_joint_parameters(self._robots._joint_columns(joints))

    def _width(self) -> int:
        return len(self._robots._joint_facts.axes)

    def _columns(self, parts: Names) -> list[int]:
        return self._robots._joint_columns(parts)

    def _fill_in(self, number: int, of_file: bool, out: Floats) -> None:
        self._robots._core.joint_parameters(number, of_file, out)

    def _put(self, columns: list[int], numbers: list[int], values: Floats) -> None:
        self._robots._core.set_joint_parameters(columns, numbers, values)


class LinkParameters(_Parameters):
    """Numbers of the links of some robots. Robots.link_parameters makes it; N is the number of robots.

    As JointParameters: a robot has the numbers of the file until it is given own ones, which are part of its state; what
    is assigned is in effect at once (of a RemoteSimulation from the next tick on); if one robot refuses it (OrderError),
    nothing is changed. Columns are Robots.links:

    | name | unit | |
    |---|---|---|
    | `mass` | kg | of the link; until the inertia is given, it grows in proportion |
    | `centre_x`, `centre_y`, `centre_z` | m | its centre of mass, in the link's frame |
    | `inertia_xx`, `inertia_yy`, `inertia_zz`, `inertia_xy`, `inertia_xz`, `inertia_yz` | kg m^2 | about its centre of mass, in axes of the link |
    | `friction`, `friction_across` | | coefficients of friction of its collision shapes; the second one counts where the file gives a direction |
    | `restitution` | | bounce of these shapes, 0 to 1 |
    | `torsional_friction` | | coefficient of friction of turning about the normal |
    | `rolling_friction` | m | torque of rolling friction per N of normal force |

    Arrays are (N, links), read-only copies: assign them as a whole. Of a Batch they are (simulations, N, links). A link
    without collision shapes has no friction, one without mass no numbers of mass: these read NaN. NaN that is assigned
    leaves a number as it is, and what is assigned to all links leaves out those that have none. On-board controllers
    know the masses of the file, as makers of real ones do.

    >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
    >>> cars = sim.robots("car_*")
    >>> cars.link_parameters["friction"] = np.linspace(0.4, 1.2, 16)[:, None]   # another in each car
    >>> cars.link_parameters.set("chassis", mass=6.0, centre_z=0.02)            # a payload
    >>> cars.link_parameters["mass"][0, cars.links.index("chassis")]
    6.0
    """
    _part = "links"
    _names: list[str] = [row[0] for row in _core.link_parameters]

    def units(self, name: str) -> tuple[str, ...]:
        """Unit of the parameter in each column; empty: it has none."""
        return (_core.link_parameters[self._number(name)][1],) * self._width()

    def set(self, links: Names = None, /, **values: ArrayLike) -> None:
        """Sets several parameters of some links in one go: of each robot all, or, if one robot refuses, of none.

        Args:
            links: names of the columns of the arrays; None: all links that have the parameters. Numbers of an inertia
                that are not given beside others of it stay as they are, also beside a new mass.
            values: by the name of the parameter, (N, links); one row for all robots; one number.

        >>> arm = roboss.Simulation(roboss.example("arm.sdf")).robots("arm")
        >>> arm.link_parameters.set(arm.links[-1], mass=2.5)
        >>> arm.link_parameters["mass"][0, -1]
        2.5
        """
        self._set(links, values)

    def reset(self, links: Names = None) -> None:
        """Gives all numbers of some links back to the file's. Robots that have no own ones left are as if they never
        had any: their hashes are the same.

        Args:
            links: names; None: all links.
        """
        self._robots._core.reset_link_parameters(self._columns(links))

    def _for_all(self, name: str, values: Floats) -> Floats:
        return np.where(np.isnan(self.of_file(name)), np.nan, values)

    def _width(self) -> int:
        return len(self._robots.links)

    def _columns(self, parts: Names) -> list[int]:
        if parts is None:
            return list(range(self._width()))
        return [self._robots._link(name) for name in names_of("links", parts)]

    def _fill_in(self, number: int, of_file: bool, out: Floats) -> None:
        self._robots._core.link_parameters(number, of_file, out)

    def _put(self, columns: list[int], numbers: list[int], values: Floats) -> None:
        self._robots._core.set_link_parameters(columns, numbers, values)


class Surroundings(_Parameters):
    """Gravity and steady wind at some robots. Robots.surroundings makes it; N is the number of robots.

    As JointParameters: a robot has those of the world's file until it is given own ones, which are part of its state;
    what is assigned is in effect at once (of a RemoteSimulation from the next tick on); if one robot refuses it
    (OrderError: not finite, or more than 1000 in a component), nothing is changed. Robots that are added later, and
    all after a reset of the simulation, have those of the file. Columns are x, y and z of the world:

    | name | unit | |
    |---|---|---|
    | `gravity` | m/s^2 | in the dynamics, and in what IMUs and the multicopter's controller measure |
    | `wind` | m/s | on links with `<enable_wind>`, wings, rotors, sensors of air speed; the aim of Gazebo's WindEffects |

    Arrays are (N, 3), read-only copies: assign them as a whole, or one row for all robots. Of a Batch they are
    (simulations, N, 3).

    >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
    >>> cars = sim.robots("car_*")
    >>> cars.surroundings["gravity"] = [0, 0, -1.62]                    # on the moon
    >>> cars[0].surroundings.set("z", gravity=-3.71)                    # one of them on Mars
    >>> cars[:2].surroundings["gravity"]
    array([[ 0.  ,  0.  , -3.71],
           [ 0.  ,  0.  , -1.62]])
    """
    _part = "surroundings"
    _names: list[str] = [row[0] for row in _core.surroundings]
    components = ("x", "y", "z")  #: names of the columns

    def units(self, name: str) -> tuple[str, ...]:
        """Unit of gravity or wind in each column."""
        return (_core.surroundings[self._number(name)][1],) * len(self.components)

    def set(self, components: Names = None, /, **values: ArrayLike) -> None:
        """Sets gravity, wind or both, or some components: of each robot all, or, if one robot refuses, of none.

        Args:
            components: some of "x", "y" and "z", the columns of the arrays; None: all.
            values: by the name, (N, components); one row for all robots; of named components also one number.

        Raises:
            ArgumentError: one number for a whole vector (code "bad-shape").
        """
        self._set(components, values)

    def reset(self, components: Names = None) -> None:
        """Gives gravity and wind, or some components of both, back to the file's. Robots that have no own numbers left
        are as if they never had any: their hashes are the same.

        Args:
            components: some of "x", "y" and "z"; None: all.
        """
        self._robots._core.reset_surroundings(self._columns(components))

    def _set(self, parts: Names, values: dict[str, ArrayLike]) -> None:
        for name, value in values.items():
            if parts is None and np.ndim(value) == 0:
                raise ArgumentError(f"{name}: one number", "give x, y and z, or name the component", "bad-shape")
        super()._set(parts, values)

    def _width(self) -> int:
        return len(self.components)

    def _columns(self, parts: Names) -> list[int]:
        if parts is None:
            return list(range(self._width()))
        return [index_of("component", name, list(self.components)) for name in names_of("components", parts)]

    def _fill_in(self, number: int, of_file: bool, out: Floats) -> None:
        self._robots._core.surroundings(number, of_file, out)

    def _put(self, columns: list[int], numbers: list[int], values: Floats) -> None:
        self._robots._core.set_surroundings(columns, numbers, values)
