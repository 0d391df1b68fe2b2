"""Calibration: numbers of a world file, fitted to trajectories that were recorded of the real robot.

The residuals r are recorded minus simulated values, each divided by the spread s_u of those of its unit. The optimiser
(scipy.optimize.least_squares, trust region reflective) finds the parameters that make the sum of squares least. The
covariance is V = (J^T J)^-1 |r|^2 / (n - p) with the Jacobian J at the end, and the interval of 95 % is the value
+- t(0.975, n - p) sqrt(V_kk): Seber and Wild, Nonlinear Regression, Wiley 1989, sections 2.1 and 5.1.
"""
from __future__ import annotations

import os
import tempfile
import xml.etree.ElementTree as xml
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Iterable, Iterator, Optional, Sequence, Union

import numpy as np

from ..errors import ArgumentError
from ..robots import Floats
from ..simulation import Simulation
from .recorder import journal_of_run, opened_world, record
from .recording import Recording, matches
from .variables import Variables

_STEP = 1e-3  # of finite differences, relative: friction and impacts are not smooth on smaller scales
PATTERNS = ("*.x", "*.y", "*.yaw", "*.*.position")


@dataclass(frozen=True)
class Parameter:
    """A number of a world file that is to be found.

    Attributes:
        name: for tables.
        paths: of the elements that hold it (ElementTree's subset of XPath, from the root of the file): all get the value.
        low, high: its bounds; None: a tenth and ten times the value in the file.
    """

    name: str
    paths: tuple[str, ...]
    low: Optional[float] = None
    high: Optional[float] = None


@dataclass(frozen=True)
class TestRun:
    """A recorded run, and the orders that the robot had in it (a file as of `roboss run --orders`)."""

    recording: Recording
    orders: Optional[str] = None


@dataclass(frozen=True)
class Calibration:
    """What was found.

    Attributes:
        names: of the parameters.
        start, values: (p,), in the file, and found.
        low, high: (p,), 95 % confidence intervals.
        correlation: (p, p), of the errors of the values.
        rms: root mean squares of what is left between recorded and simulated values, by unit.
        rms_before: the same with the values of the file.
        simulations: how many times all runs were simulated.
        converged: whether the optimiser came to a minimum.
        world: text of the file with the values.
    """

    names: tuple[str, ...]
    start: Floats
    values: Floats
    low: Floats
    high: Floats
    correlation: Floats
    rms: dict[str, float]
    rms_before: dict[str, float]
    simulations: int
    converged: bool
    world: str


class WorldFile:
    """A world file (SDFormat or URDF) in which numbers can be set.

    Raises:
        ArgumentError: it is no XML (code "no-xml"); a path names no element, or one that is no number ("no-number").
    """

    def __init__(self, path: Union[str, os.PathLike], parameters: Sequence[Parameter]):
        self.path, self._parameters = Path(path), tuple(parameters)
        try:
            for _, (prefix, uri) in xml.iterparse(path, events=("start-ns",)):
                xml.register_namespace(prefix, uri)
            self._root = xml.parse(path).getroot()
        except xml.ParseError as error:
            raise ArgumentError(f"'{self.path}': {error}", "give an SDFormat or URDF file; prefixes need their xmlns", "no-xml") from error
        self._places = [self._found(parameter) for parameter in self._parameters]
        self.start = np.array([places[0][1] for places in self._places])

    def text(self, values: Iterable[float]) -> str:
        """The file with these values, one for each parameter."""
        for places, value in zip(self._places, values):
            for element, _, attribute in places:
                if attribute:
                    element.set(attribute, repr(float(value)))
                else:
                    element.text = repr(float(value))
        return xml.tostring(self._root, encoding="unicode")

    def _found(self, parameter: Parameter) -> list[tuple[xml.Element, float, str]]:
        """Elements with their numbers; a path may end in /@ATTRIBUTE, as URDF needs."""
        places = []
        for path in parameter.paths:
            where, _, attribute = path.partition("/@")
            try:
                elements = self._root.findall(where)
            except (SyntaxError, TypeError, KeyError) as error:  # as ElementTree says it
                raise ArgumentError(f"parameter '{parameter.name}': the path '{path}' is wrong: {error}",
                                    "write it as ElementTree's XPath, for instance .//joint[@name='left']/axis/limit/effort",
                                    "bad-path") from error
            if not elements:
                raise ArgumentError(f"parameter '{parameter.name}': '{self.path}' has no element {path}",
                                    "the path starts at the root: .//joint[@name='left']/axis/limit/effort", "no-number")
            for element in elements:
                text = element.get(attribute) if attribute else element.text
                try:
                    places.append((element, float(text or ""), attribute))
                except ValueError:
                    raise ArgumentError(f"parameter '{parameter.name}': {path} of '{self.path}' is no number: '{text}'",
                                        "name an element that holds one number", "no-number") from None
        return places


def calibrate(world: Union[str, os.PathLike], parameters: Sequence[Parameter], runs: Sequence[TestRun], *,
              compare: Union[str, Iterable[str]] = PATTERNS, clients: Sequence[str] = (),
              progress: Optional[Callable[[str], None]] = None) -> Calibration:
    """Fits numbers of a world file to recorded runs.

    Args:
        world: path of the file; its robots start where the recorded ones did.
        parameters: which numbers.
        runs: recordings with the orders of each; times start with the run.
        compare: patterns of the variables that are compared; columns without a recorded or simulated partner do not count.
        clients: control programs that drive the robots, besides the orders.
        progress: is called with a line after each simulation.

    Raises:
        ArgumentError: nothing can be compared (code "nothing-to-compare"), a parameter has no influence ("no-influence"),
            a number is not there ("no-number") or not between its bounds ("bad-bounds").
        RobossError: a run failed.
    """
    from scipy import optimize, stats
    if not parameters or not runs:
        raise ArgumentError("no parameter, or no recorded run", "give one of each, or more", "nothing-to-compare")
    file = WorldFile(world, parameters)
    low, high = _bounds(parameters, file.start)
    fit = _Comparison(file, runs, (compare,) if isinstance(compare, str) else tuple(compare), clients, progress)
    before = fit.differences(file.start)
    spread, values, found, weights = _spread(fit.units, before), file.start, None, None
    for _ in range(2):  # the second time by what the first left: each unit counts by its own noise
        weights = np.array([1 / spread[unit] for unit in fit.units])
        found = optimize.least_squares(lambda x: fit.differences(x) * weights, values, bounds=(low, high), x_scale=file.start,
                                       diff_step=_STEP, xtol=1e-5, ftol=1e-8, gtol=1e-10, max_nfev=60)
        values, spread = found.x, _spread(fit.units, found.fun / weights)
    count = len(found.fun)
    idle = np.linalg.norm(found.jac * values, axis=0) < 1e-9 * np.sqrt(count)
    if idle.any():
        names = ", ".join(parameter.name for parameter, none in zip(parameters, idle) if none)
        raise ArgumentError(f"these parameters change nothing in the runs: {names}", "leave them out, or record a run in which they count "
                            "(of two surfaces the smaller friction does)", "no-influence")
    freedom = max(1, count - len(values))
    covariance = np.linalg.pinv(found.jac.T @ found.jac) * (found.fun @ found.fun) / freedom
    deviation = np.sqrt(np.diagonal(covariance))
    half = stats.t.ppf(0.975, freedom) * deviation
    return Calibration(tuple(parameter.name for parameter in parameters), file.start, values, values - half, values + half,
                       covariance / np.outer(deviation, deviation), spread, _spread(fit.units, before), fit.simulations,
                       bool(found.success), file.text(values))


class _Comparison:
    """Recorded against simulated values, at the recorded times."""

    def __init__(self, file: WorldFile, runs: Sequence[TestRun], patterns: Sequence[str], clients: Sequence[str],
                 progress: Optional[Callable[[str], None]]):
        self._file, self._runs, self._clients, self._progress = file, runs, clients, progress
        self.simulations = 0
        self._known: dict[tuple[float, ...], Floats] = {}
        there = {column.name: column for column in Variables(Simulation(opened_world(file.path))).columns}
        self._columns = [[column for column in run.recording.columns
                          if column.name in there and any(matches(pattern, column) for pattern in patterns)] for run in runs]
        if not all(self._columns):
            names = ", ".join(list(dict.fromkeys(column.variable for column in there.values()))[:8])
            raise ArgumentError("a recording has no variable of the world that is to be compared",
                                f"record some of {names} ..., or name others (--compare)", "nothing-to-compare")
        self.units = [there[column.name].unit for run, columns in zip(runs, self._columns) for column in columns
                      for _ in run.recording.time]

    def differences(self, values: Floats) -> Floats:
        """Recorded minus simulated, column by column of each run."""
        key = tuple(values)
        if key not in self._known:
            self.simulations += 1
            if self._progress:
                self._progress(f"simulation {self.simulations}: " + ", ".join(f"{value:.5g}" for value in values))
            self._known[key] = np.concatenate(list(self._rows(values)))
        return self._known[key]

    def _rows(self, values: Floats) -> Iterator[Floats]:
        with tempfile.TemporaryDirectory(prefix="roboss_calibrate_") as folder, \
                tempfile.NamedTemporaryFile("w", dir=self._file.path.parent, prefix=".calibrate_", suffix=self._file.path.suffix,
                                            encoding="utf-8") as world:  # beside the file, for paths in it are relative
            world.write(self._file.text(values))
            world.flush()
            for number, (run, columns) in enumerate(zip(self._runs, self._columns)):
                at = Path(folder) / str(number)
                at.mkdir()
                journal = journal_of_run(world.name, float(run.recording.time[-1]) + 0.1, at, orders=run.orders, clients=self._clients)
                copy = record(journal, sorted({column.variable for column in columns}), every=0.0)
                for column in columns:
                    yield _difference(run.recording, copy, column.name)


def _difference(recorded: Recording, simulated: Recording, name: str) -> Floats:
    turns = name.endswith(".yaw")
    values = np.unwrap(simulated[name]) if turns else simulated[name]
    difference = recorded[name] - np.interp(recorded.time, simulated.time, values)
    return (difference + np.pi) % (2 * np.pi) - np.pi if turns else difference


def _spread(units: Sequence[str], differences: Floats) -> dict[str, float]:
    """Root mean squares by unit."""
    kinds = np.array(units)
    return {unit: float(max(np.sqrt(np.mean(differences[kinds == unit]**2)), 1e-12)) for unit in dict.fromkeys(units)}


def _bounds(parameters: Sequence[Parameter], start: Floats) -> tuple[Floats, Floats]:
    low = np.array([0.1 * value if parameter.low is None else parameter.low for parameter, value in zip(parameters, start)])
    high = np.array([10 * value if parameter.high is None else parameter.high for parameter, value in zip(parameters, start)])
    for parameter, value, lowest, highest in zip(parameters, start, low, high):
        if not lowest < value < highest or value == 0:
            raise ArgumentError(f"parameter '{parameter.name}' is {value:g} in the file, which is not between {lowest:g} and {highest:g}",
                                "give bounds around a value above or below 0: NAME=PATH@LOW..HIGH", "bad-bounds")
    return low, high
