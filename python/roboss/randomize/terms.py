"""Terms: what is drawn, from which distribution, and when."""
from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from fnmatch import fnmatchcase
from typing import Iterable, Literal, Optional, Sequence, Union

import numpy as np

from ..errors import ArgumentError
from ..names import flag, listed, names_of, real, text, unknown, whole
from ..parameters import JointParameters, LinkParameters, Surroundings
from ..robots import Robots
from .distributions import Distribution, Floats

Moment = Literal["start", "reset", "step"]
When = Union[Moment, float, tuple[float, float]]  #: a moment; or an interval in s: its length, or least and most
Operation = Literal["set", "scale", "add"]
Kind = Literal["joint", "link", "surroundings"]
_MOMENTS: dict[str, Moment] = {"start": "start", "reset": "reset", "step": "step"}
_OPERATIONS: dict[str, Operation] = {"set": "set", "scale": "scale", "add": "add"}
_TWIST = (("linear_x", "m/s"), ("linear_y", "m/s"), ("linear_z", "m/s"),
          ("angular_x", "rad/s"), ("angular_y", "rad/s"), ("angular_z", "rad/s"))
_WRENCH = (("force_x", "N"), ("force_y", "N"), ("force_z", "N"),
           ("torque_x", "N m"), ("torque_y", "N m"), ("torque_z", "N m"))
Columns = Sequence[tuple[str, str]]  # names and units
MOST_STEPS = 10_000                  # of latency


@dataclass(frozen=True, eq=False)
class Term(ABC):
    """One row of a randomisation. `joint`, `link`, `surroundings`, `kick`, `push`, `noise` and `latency` make one.

    Attributes:
        name: under which it is drawn and can be read back.
        distribution: of the numbers.
        when: "start", "reset", "step", or the least and most seconds between two draws.
    """

    name: str
    distribution: Distribution
    when: Union[Moment, tuple[float, float]]

    @property
    def acts(self) -> bool:
        """True if it acts at a moment, and does not last until the next draw."""
        return False

    @property
    def shared(self) -> bool:
        """True if all columns get one and the same number."""
        return False

    def draw(self, numbers: np.random.Generator, rows: int, columns: int) -> Floats:
        """The numbers that a robot gets in some draws, (rows, columns), or (rows, 1) for all columns."""
        return self.distribution.sample(numbers, rows, 1 if self.shared else columns)

    @abstractmethod
    def columns(self, robots: Robots, observation: Optional[int]) -> Columns:
        """Names and units of what is drawn for each robot. `observation`: columns of an observation."""


@dataclass(frozen=True, eq=False)
class NumberTerm(Term):
    """A number of joints or links, gravity or wind."""

    kind: Kind
    parameter: str
    operation: Operation
    parts: tuple[str, ...]  # patterns of names
    is_shared: bool

    @property
    def shared(self) -> bool:
        return self.is_shared

    def applied(self, values: Floats, draws: Floats) -> Floats:
        """The numbers with what was drawn, (robots, columns)."""
        return draws if self.operation == "set" else values * draws if self.operation == "scale" else values + draws

    def columns(self, robots: Robots, observation: Optional[int]) -> Columns:
        names, own = parts_of(robots, self.kind), numbers_of(robots, self.kind)
        units = own.units(self.parameter)  # raises: there is no such number
        for pattern in self.parts:
            if not any(fnmatchcase(name, pattern) for name in names):
                raise unknown(_part_of(self.kind), pattern, names, f" (term '{self.name}')")
        return [(name, "1" if self.operation == "scale" else unit) for name, unit in zip(names, units)
                if any(fnmatchcase(name, pattern) for pattern in self.parts)]


@dataclass(frozen=True, eq=False)
class KickTerm(Term):
    """A change of the velocity of the base."""

    @property
    def acts(self) -> bool:
        return True

    def columns(self, robots: Robots, observation: Optional[int]) -> Columns:
        return _TWIST


@dataclass(frozen=True, eq=False)
class PushTerm(Term):
    """A wrench on a link."""

    link: Optional[str]
    duration: float  # s

    @property
    def acts(self) -> bool:
        return True

    def columns(self, robots: Robots, observation: Optional[int]) -> Columns:
        if self.link is not None and self.link not in robots.links:
            raise unknown("link", self.link, robots.links, f" (term '{self.name}')")
        return _WRENCH


@dataclass(frozen=True, eq=False)
class NoiseTerm(Term):
    """A row that is added to observations."""

    places: Optional[tuple[int, ...]]  # of the columns; None: all

    def columns(self, robots: Robots, observation: Optional[int]) -> Columns:
        if observation is None:
            raise ArgumentError(f"term '{self.name}' without a number of columns of the observations",
                                "give Randomizer(..., observation_columns=...)", "no-observation")
        for place in self.places or ():
            if place >= observation:
                raise ArgumentError(f"term '{self.name}': column {place} of an observation of {observation} columns",
                                    f"give columns from 0 to {observation - 1}", "bad-column")
        places = range(observation) if self.places is None else self.places
        return [(f"observation[{place}]", "") for place in places]


@dataclass(frozen=True, eq=False)
class LatencyTerm(Term):
    """The number of steps after which an action is carried out."""

    def draw(self, numbers: np.random.Generator, rows: int, columns: int) -> Floats:
        return np.rint(self.distribution.sample(numbers, rows, columns))

    def columns(self, robots: Robots, observation: Optional[int]) -> Columns:
        return [("latency", "steps")]


def joint(parameter: str, distribution: Distribution, operation: str = "set", *,
          joints: Union[str, Iterable[str]] = "*", when: When = "reset", shared: bool = False,
          name: Optional[str] = None) -> Term:
    """A number of joints: `Robots.parameters` has their names and units.

    Args:
        parameter: "damping", "friction", "armature", "position_gain", "max_effort" ...
        distribution: of the new number, or of what the file's number is multiplied with, or of what is added to it.
        operation: "set", "scale" or "add". Several terms for one number apply in the order of the list.
        joints: names, or patterns (`*`, `?`, `[...]`).
        when: "start": once, for all episodes; "reset": at the start of each episode; "step": at each step, too; or also
            after intervals, in s, from the start of the episode on: one length, or a least and a most.
        shared: one number for all joints of a robot, instead of one for each.
        name: of the term; None: "joint_PARAMETER".

    Raises:
        ArgumentError: a factor that can be negative (code "negative-scale"), bad intervals ("bad-interval").
    """
    return _number("joint", parameter, distribution, operation, joints, when, shared, name)


def link(parameter: str, distribution: Distribution, operation: str = "set", *, links: Union[str, Iterable[str]] = "*",
         when: When = "reset", shared: bool = False, name: Optional[str] = None) -> Term:
    """A number of links: `Robots.link_parameters` has their names and units. Links that do not have it stay as they
    are.

    Args:
        parameter: "mass", "centre_x", "inertia_xx", "friction", "restitution" ...
        links: names, or patterns (`*`, `?`, `[...]`).
        name: of the term; None: "link_PARAMETER".

    All others, and errors: as `joint`.
    """
    return _number("link", parameter, distribution, operation, links, when, shared, name)


def surroundings(parameter: str, distribution: Distribution, operation: str = "set", *,
                 components: Union[str, Iterable[str]] = "*", when: When = "reset", shared: bool = False,
                 name: Optional[str] = None) -> Term:
    """Gravity in m/s^2 or steady wind in m/s of each robot, world axes, as `Robots.surroundings` has them.

    Args:
        parameter: "gravity" or "wind".
        components: "x", "y", "z", or patterns; all others stay.
        shared: one number for all these components: a factor of the whole vector.
        name: of the term; None: "gravity" or "wind".

    All others, and errors: as `joint`.

    >>> term = roboss.randomize.surroundings("gravity", roboss.randomize.uniform(0.9, 1.1), "scale", shared=True)
    """
    return _number("surroundings", parameter, distribution, operation, components, when, shared,
                   text("parameter", parameter) if name is None else name)


def kick(distribution: Distribution, *, when: When = (5.0, 15.0), name: str = "kick") -> Term:
    """Adds to the velocities of the bases, at once.

    Args:
        distribution: 6 columns: linear velocity in m/s, angular velocity in rad/s, world axes.
        when: "reset", or after intervals in s: one length, or a least and a most.
        name: of the term.
    """
    return KickTerm(text("name", name), _distribution(distribution), _acting(when))


def push(distribution: Distribution, *, link: Optional[str] = None, duration: float = 0.1, when: When = (5.0, 15.0),
         name: str = "push") -> Term:
    """Pushes a link of each robot, as Robots.apply_wrench.

    Args:
        distribution: 6 columns: force in N at the link's centre of mass, torque in N m, world axes.
        link: name; None: the first link of each robot.
        duration: s, at least a tick.
        when: "reset", or after intervals in s: one length, or a least and a most.
        name: of the term.
    """
    seconds = real("duration", duration)
    if not 0 < seconds < np.inf:
        raise ArgumentError(f"a push of {seconds} s", "give a finite duration above 0", "bad-value")
    return PushTerm(text("name", name), _distribution(distribution), _acting(when),
                    None if link is None else text("link", link), seconds)


def noise(distribution: Distribution, *, columns: Optional[Iterable[int]] = None, when: When = "step",
          name: str = "noise") -> Term:
    """Noise of observations, in their units: Randomizer.noisy adds it.

    Args:
        columns: places of the observation's columns, from 0 on; None: all.
        when: "step": new at each step; "reset": a bias that stays for an episode; or as `joint`.
        name: of the term.
    """
    places = None if columns is None else tuple(whole("columns", place) for place in listed("columns", columns))
    if places is not None and (not places or len(set(places)) < len(places)):
        raise ArgumentError(f"noise of columns {list(places)}", "give one or more columns, each once", "bad-column")
    return NoiseTerm(text("name", name), _distribution(distribution), _moment(when), places)


def latency(distribution: Distribution, *, when: When = "reset", name: str = "latency") -> Term:
    """Latency of actions: Randomizer.delayed gives those of some steps before. Several terms add up.

    Args:
        distribution: of the number of steps, rounded to a whole one; bounded, 0 or more.
        when: "reset": the same for an episode; "step": jitter; or as `joint`.
        name: of the term.
    """
    steps = _distribution(distribution)
    if not (steps.low >= 0).all() or not (steps.high <= MOST_STEPS).all():
        raise ArgumentError(f"a latency from {steps.low.tolist()} to {steps.high.tolist()} steps",
                            f"give a distribution with bounds from 0 to {MOST_STEPS}", "bad-latency")
    return LatencyTerm(text("name", name), steps, _moment(when))


def parts_of(robots: Robots, kind: str) -> tuple[str, ...]:
    """Names of the joints, of the links, or of the components of gravity and wind."""
    return Surroundings.components if kind == "surroundings" else robots.joints if kind == "joint" else robots.links


def numbers_of(robots: Robots, kind: str) -> Union[JointParameters, LinkParameters, Surroundings]:
    """The numbers of the joints, or of the links; or gravity and wind."""
    if kind == "surroundings":
        return robots.surroundings
    return robots.parameters if kind == "joint" else robots.link_parameters


def _part_of(kind: Kind) -> str:
    """The word for a part of such a number."""
    return "component" if kind == "surroundings" else kind


def _number(kind: Kind, parameter: str, distribution: Distribution, operation: str,
            parts: Union[str, Iterable[str]], when: When, shared: bool, name: Optional[str]) -> Term:
    parameter = text("parameter", parameter)
    own = f"{kind}_{parameter}" if name is None else text("name", name)
    if text("operation", operation) not in _OPERATIONS:
        raise unknown("operation", operation, _OPERATIONS)
    if operation == "scale" and not (_distribution(distribution).low >= 0).all():
        raise ArgumentError(f"term '{own}': a factor that can be {distribution.low.tolist()}",
                            "give a distribution from 0 on, as normal(1, 0.1, low=0)", "negative-scale")
    part = _part_of(kind)
    patterns = tuple(names_of(f"{part}s", parts))
    if not patterns:
        raise ArgumentError(f"term '{own}' for no {part}", "give names or patterns", "no-part")
    return NumberTerm(own, _distribution(distribution), _moment(when), kind, parameter, _OPERATIONS[operation],
                      patterns, flag("shared", shared))


def _distribution(given: object) -> Distribution:
    if not isinstance(given, Distribution):
        raise ArgumentError(f"distribution: {given!r}",
                            "give uniform(...), log_uniform(...), normal(...) or choice(...)", "bad-type")
    return given


def _acting(when: When) -> Union[Moment, tuple[float, float]]:
    moment = _moment(when)
    if moment in ("start", "step"):
        raise ArgumentError(f"pushes at each '{moment}'", "give when=\"reset\", or an interval in s", "bad-interval")
    return moment


def _moment(when: object) -> Union[Moment, tuple[float, float]]:
    """The moment, or the least and most length of an interval."""
    if isinstance(when, str):
        if when not in _MOMENTS:
            raise unknown("moment", when, _MOMENTS)
        return _MOMENTS[when]
    bounds = list(when) if isinstance(when, (tuple, list)) else [when, when]
    seconds = [real("when", bound) for bound in bounds]
    if len(seconds) != 2 or not 0 < seconds[0] <= seconds[1] < np.inf:
        raise ArgumentError(f"an interval of {seconds} s", "give seconds above 0, or a least and a most",
                            "bad-interval")
    return seconds[0], seconds[1]
