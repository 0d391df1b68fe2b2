"""Calibration: numbers of a world file, fitted to trajectories that were recorded of the real robot.

The residuals r are recorded minus simulated values, each divided by the root mean square of its unit. The optimiser
(scipy.optimize.least_squares, trust region reflective) minimizes the sum of their squares. The covariance is V = (J^T J)^-1 |r|^2 / (n - p) with the Jacobian J at the end, and the interval of 95 % is the value
+- t(0.975, n - p) sqrt(V_kk): Seber and Wild, Nonlinear Regression, Wiley 1989, sections 2.1 and 5.1.
"""
from __future__ import annotations

import os
import tempfile
import xml.etree.ElementTree as xml
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Iterable, Iterator, Mapping, Optional, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from ..errors import ArgumentError, RobossError
from ..robots import Floats
from ..simulation import Simulation
from .offsets import SCALE, Offset, Starts, offsets_of
from .recorder import journal_of_run, opened_world, record
from .recording import Column, Recording, matches
from .variables import Variables

_STEP = 1e-3  # of finite differences, relative: friction and impacts are not smooth on smaller scales
_ALIKE = 1e-6  # ratio of the singular values of the Jacobian below which parameters are not identifiable
_FINEST = 1e-6  # m, rad: a unit that is left with less counts as if it were left with this
_SPARE = 0.1   # s that a run is simulated beyond its recording
PATTERNS = ("*.x", "*.y", "*.yaw", "*.*.position")


@dataclass(frozen=True)
class Parameter:
    """A number of a world file that is to be found.

    Attributes:
        name: for tables.
        paths: of the elements that hold it (ElementTree's subset of XPath, from the root of the file): all get the value.
        low, high: its bounds; None: between a tenth and ten times the value in the file.
    """

    name: str
    paths: tuple[str, ...]
    low: Optional[float] = None
    high: Optional[float] = None


@dataclass(frozen=True)
class TestRun:
    """A recorded run, the orders that the robot had in it (a file as of `roboss run --orders`), and a name for errors."""

    recording: Recording
    orders: Optional[str] = None
    name: str = "recording"


@dataclass(frozen=True)
class Calibration:
    """What was found.

    Attributes:
        names: of the parameters.
        start, values: (p,), in the file, and found.
        low, high: (p,), 95 % confidence intervals; NaN where a value is at its bound.
        at_bound: (p,) bool, whether a value is at its bound: the minimum is beyond it.
        correlation: (p, p), of the errors of the values; NaN where there is none, as without noise.
        compared: names of the columns that were compared.
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
    at_bound: NDArray[np.bool_]
    correlation: Floats
    compared: tuple[str, ...]
    rms: dict[str, float]
    rms_before: dict[str, float]
    simulations: int
    converged: bool
    world: str


class WorldFile:
    """A world file (SDFormat or URDF) in which numbers can be set.

    Raises:
        ArgumentError: there is no such file (code "no-file"), or it is no XML ("no-xml"); a path names no element, or
            one that is no number ("no-number"), or several with different numbers ("different-numbers").
    """

    def __init__(self, path: Union[str, os.PathLike], parameters: Sequence[Parameter]):
        self.path, self._parameters = Path(path), tuple(parameters)
        if not self.path.is_file():
            raise ArgumentError(f"there is no file '{self.path}'", "give an SDFormat or URDF file", "no-file")
        try:
            for _, (prefix, uri) in xml.iterparse(path, events=("start-ns",)):
                xml.register_namespace(prefix, uri)
            self._root = xml.parse(path, xml.XMLParser(target=xml.TreeBuilder(insert_comments=True))).getroot()
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
        return '<?xml version="1.0"?>\n' + xml.tostring(self._root, encoding="unicode") + "\n"

    def _found(self, parameter: Parameter) -> list[tuple[xml.Element, float, str]]:
        """Elements with their numbers; a path may end in /@ATTRIBUTE, as URDF needs."""
        places = []
        for path in parameter.paths:
            where, _, attribute = path.partition("/@")
            try:
                elements = self._root.findall(where)
            except (SyntaxError, TypeError, KeyError) as error:  # as ElementTree says it
                reason = f": {error}" if isinstance(error, SyntaxError) else ", or not complete"
                raise ArgumentError(f"parameter '{parameter.name}': the path '{path}' is wrong{reason}",
                                    "write it as ElementTree's XPath, for instance .//joint[@name='left']/axis/limit/effort",
                                    "bad-path") from error
            if not elements:
                raise ArgumentError(f"parameter '{parameter.name}': '{self.path}' has no element {path}",
                                    "the path starts at the root: .//joint[@name='left']/axis/limit/effort; files that "
                                    "are included are not searched: give that file", "no-number")
            for element in elements:
                text = element.get(attribute) if attribute else element.text
                try:
                    places.append((element, float(text or ""), attribute))
                except ValueError:
                    raise ArgumentError(f"parameter '{parameter.name}': {path} of '{self.path}' is no number: '{text}'",
                                        "name an element that holds one number", "no-number") from None
        numbers = sorted({number for _, number, _ in places})
        if len(numbers) > 1:
            raise ArgumentError(f"parameter '{parameter.name}': its {len(places)} elements in '{self.path}' hold different "
                                f"numbers: {', '.join(f'{number:g}' for number in numbers[:6])}",
                                "all of them would get one value: name those that belong together, for instance "
                                ".//model[@name='robot']//...", "different-numbers")
        return places


def calibrate(world: Union[str, os.PathLike], parameters: Sequence[Parameter], runs: Sequence[TestRun], *,
              compare: Union[str, Iterable[str]] = PATTERNS, clients: Sequence[str] = (),
              options: Optional[Mapping[str, Any]] = None, fit_start: Sequence[str] = (), fit_time: Optional[float] = None,
              progress: Optional[Callable[[str], None]] = None) -> Calibration:
    """Fits numbers of a world file to recorded runs.

    Args:
        world: path of the file; its robots start where the recorded ones did, but for `fit_start`.
        parameters: which numbers.
        runs: recordings with the orders of each; times start with the run.
        compare: patterns of the variables that are compared; columns that the world does not have do not count, and
            neither do samples that are not finite.
        clients: control programs that drive the robots, besides the orders.
        options: of load(), for a URDF: ground, fixed_base, dt, search_paths.
        fit_start: robots whose start x, y (at most 1 m off) and yaw (1 rad) are found, too, for each run.
        fit_time: if given, the time of the recording's clock at which the run began is found, too, for each run; s, at most
            this much in either direction.
        progress: is called with a line after each simulation.

    Raises:
        ArgumentError: nothing can be compared (code "nothing-to-compare"), times do not ascend from 0 ("bad-times"),
            units differ ("bad-unit"), a parameter has no influence ("no-influence"), two have the same ("same-influence"),
            a number is not there ("no-number") or not between its bounds ("bad-bounds"), a robot of
            fit_start is not there or fixed ("no-free-robot").
        RobossError: a run failed.
    """
    from scipy import optimize, stats
    if not parameters or not runs:
        raise ArgumentError("no parameter, or no recorded run", "give one of each, or more", "nothing-to-compare")
    file = WorldFile(world, parameters)
    low, high = _bounds(parameters, file.start)
    offsets = offsets_of(len(runs), fit_start, fit_time)
    most = np.array([offset.most for offset in offsets])
    start, low, high = (np.concatenate(parts) for parts in ((file.start, 0 * most), (low, -most), (high, most)))
    size = np.concatenate([np.abs(file.start), np.full(len(offsets), SCALE)])
    least = np.concatenate([0.1 * np.abs(file.start), np.full(len(offsets), SCALE)])
    fit = _Comparison(file, runs, (compare,) if isinstance(compare, str) else tuple(compare), clients, options or {}, offsets, progress)
    before = fit.differences(start)
    spread, values, found, weights = _spread(fit.units, before), start, None, None
    for _ in range(2):  # the second time by what the first left: each unit counts by its own noise
        weights = np.array([1 / max(spread[unit], _FINEST) for unit in fit.units])
        found = optimize.least_squares(lambda x: fit.differences(x) * weights, values, bounds=(low, high), x_scale=size,
                                       jac=lambda x: fit.jacobian(x, least, low, high) * weights[:, None],
                                       xtol=1e-5, ftol=1e-8, gtol=1e-10, max_nfev=60)
        values, spread = found.x, _spread(fit.units, found.fun / weights)
    names = [parameter.name for parameter in parameters] + [offset.name(runs[offset.run].name) for offset in offsets]
    _check_influence(names, found.jac * np.concatenate([values[:len(parameters)], size[len(parameters):]]),
                     any(run.orders for run in runs))
    at_bound = found.active_mask != 0
    freedom = max(1, len(found.fun) - len(values))
    covariance = np.linalg.inv(found.jac.T @ found.jac) * (found.fun @ found.fun) / freedom
    deviation = np.sqrt(np.diagonal(covariance))
    half = np.where(at_bound, np.nan, stats.t.ppf(0.975, freedom) * deviation)
    with np.errstate(invalid="ignore", divide="ignore"):
        correlation = covariance / np.outer(deviation, deviation)
    return Calibration(tuple(names), start, values, values - half, values + half, at_bound, correlation, fit.compared, spread,
                       _spread(fit.units, before), fit.simulations, bool(found.success), file.text(values[:len(parameters)]))


def _check_influence(names: Sequence[str], jacobian: Floats, with_orders: bool) -> None:
    """Refuses parameters that cannot be found; the Jacobian is by relative changes."""
    lengths = np.linalg.norm(jacobian, axis=0)
    idle = [name for name, length in zip(names, lengths) if length < 1e-9 * np.sqrt(len(jacobian))]
    if idle:
        raise ArgumentError(f"these parameters change nothing in the runs: {', '.join(idle)}",
                            ("" if with_orders else "give the orders of the run (--run FILE=ORDERS), ")
                            + "leave them out, or record a run in which they count (of two surfaces the smaller friction does)",
                            "no-influence")
    _, sizes, directions = np.linalg.svd(jacobian / lengths, full_matrices=False)
    if sizes[-1] < _ALIKE * sizes[0]:
        alike = [name for name, share in zip(names, np.abs(directions[-1])) if share > 0.1]
        raise ArgumentError(f"these parameters are not separately identifiable: {', '.join(alike)}",
                            "leave one of them out, or record a run in which they differ", "same-influence")


class _Comparison:
    """Recorded against simulated values, at the recorded times."""

    def __init__(self, file: WorldFile, runs: Sequence[TestRun], patterns: Sequence[str], clients: Sequence[str],
                 options: Mapping[str, Any], offsets: Sequence[Offset], progress: Optional[Callable[[str], None]]):
        self._file, self._runs, self._clients, self._options, self._progress = file, runs, clients, options, progress
        self._offsets = offsets
        self.simulations = 0
        self._known: dict[tuple[float, ...], Floats] = {}
        sim = Simulation(opened_world(file.path, **options))
        self._starts = Starts(sim, list(dict.fromkeys(offset.robot for offset in offsets if offset.robot)))
        there = {column.name: column for column in Variables(sim).columns}
        self._columns = [[column for column in run.recording.columns
                          if column.name in there and any(matches(pattern, column) for pattern in patterns)] for run in runs]
        self._finite = [[np.isfinite(run.recording[column.name]) for column in columns] for run, columns in zip(runs, self._columns)]
        for run, columns in zip(runs, self._columns):
            _check_run(run, columns, there, patterns)
        self.units = [there[column.name].unit for columns, finite in zip(self._columns, self._finite)
                      for column, rows in zip(columns, finite) for _ in range(rows.sum())]
        self.compared = tuple(dict.fromkeys(column.name for columns in self._columns for column in columns))

    def differences(self, values: Floats) -> Floats:
        """Recorded minus simulated, column by column of each run."""
        key = tuple(values)
        if key not in self._known:
            self.simulations += 1
            if self._progress:
                self._progress(f"simulation {self.simulations}: " + ", ".join(f"{value:.5g}" for value in values))
            self._known[key] = np.concatenate(list(self._rows(values)))
        return self._known[key]

    def jacobian(self, values: Floats, least: Floats, low: Floats, high: Floats) -> Floats:
        """Derivatives of differences() by finite differences between the bounds, (n, p). Steps are relative to the values, but
        to `least` where these are smaller: offsets may be 0."""
        step = _STEP * np.maximum(np.abs(values), least)
        step = np.where(values + step <= high, step, -np.minimum(step, values - low))
        here = self.differences(values)
        return np.column_stack([(self.differences(values + by) - here) / by.sum() for by in np.diag(step)])

    def _rows(self, values: Floats) -> Iterator[Floats]:
        with tempfile.TemporaryDirectory(prefix="roboss_calibrate_") as folder, \
                tempfile.NamedTemporaryFile("w", dir=self._file.path.parent, prefix=".calibrate_", suffix=self._file.path.suffix,
                                            encoding="utf-8") as world:  # beside the file, for paths in it are relative
            numbers = len(values) - len(self._offsets)
            shifts = list(zip(self._offsets, values[numbers:].tolist()))
            world.write(self._file.text(values[:numbers]))
            world.flush()
            for number, (run, columns, finite) in enumerate(zip(self._runs, self._columns, self._finite)):
                at = Path(folder) / str(number)
                at.mkdir()
                own = [(offset, value) for offset, value in shifts if offset.run == number]
                begin = sum(value for offset, value in own if offset.kind == "time")
                end = max(float(run.recording.time[-1]) - begin, 0.0) + _SPARE
                try:
                    journal = journal_of_run(world.name, end, at, orders=self._starts.orders(own, run.orders, at),
                                             clients=self._clients, options=self._options)
                except RobossError as error:
                    raise RobossError(error.message.replace(world.name, str(self._file.path)), error.remedy, error.code) from None
                copy = record(journal, sorted({column.variable for column in columns}), every=0.0)
                for column, rows in zip(columns, finite):
                    yield _difference(run.recording, copy, column.name, begin, any(offset.robot for offset, _ in own))[rows]


def _check_run(run: TestRun, columns: Sequence[Column], there: Mapping[str, Column], patterns: Sequence[str]) -> None:
    """Refuses what cannot be compared."""
    if not columns:
        names = ", ".join(column.name for column in run.recording.columns[:8]) or "none"
        world = ", ".join(list(dict.fromkeys(name for name, column in there.items()
                                             if any(matches(pattern, column) for pattern in patterns)))[:8]) or "none"
        raise ArgumentError(f"'{run.name}' has no column that is compared with the world; it has {names}",
                            f"name columns as the world does: {world}; or give other patterns (--compare)", "nothing-to-compare")
    time = run.recording.time
    if len(time) < 2 or not np.isfinite(time).all() or time[0] < 0 or not (np.diff(time) > 0).all():
        raise ArgumentError(f"the times of '{run.name}' do not ascend from 0 on", "give s since the start of the run, two or more",
                            "bad-times")
    if time[0] > time[-1] - time[0] + 10:
        raise ArgumentError(f"the times of '{run.name}' begin at {time[0]:g} s", "subtract the time at which the orders begin",
                            "bad-times")
    for column in columns:
        if column.unit and column.unit != there[column.name].unit:
            raise ArgumentError(f"'{column.name}' of '{run.name}' is in {column.unit}, not in {there[column.name].unit}",
                                "convert it", "bad-unit")


def _difference(recorded: Recording, simulated: Recording, name: str, begin: float, moved: bool) -> Floats:
    """Recorded minus simulated; the run began at this time of the recording's clock, s."""
    turns = name.endswith(".yaw")
    values = np.unwrap(simulated[name]) if turns else simulated[name].copy()
    if moved and len(values) > 2:
        values[0] = 2 * values[1] - values[2]  # orders of time 0, which put it elsewhere, show in the next state only
    if not np.isfinite(values).all():
        raise RobossError(f"'{name}' is not finite in the simulation", "", "not-finite")
    difference = recorded[name] - np.interp(recorded.time - begin, simulated.time, values)
    return (difference + np.pi) % (2 * np.pi) - np.pi if turns else difference


def _spread(units: Sequence[str], differences: Floats) -> dict[str, float]:
    """Root mean squares by unit."""
    kinds = np.array(units)
    return {unit: float(max(np.sqrt(np.mean(differences[kinds == unit]**2)), 1e-12)) for unit in dict.fromkeys(units)}


def _bounds(parameters: Sequence[Parameter], start: Floats) -> tuple[Floats, Floats]:
    usual = [sorted((0.1 * value, 10 * value)) for value in start]
    low = np.array([one[0] if parameter.low is None else parameter.low for parameter, one in zip(parameters, usual)])
    high = np.array([one[1] if parameter.high is None else parameter.high for parameter, one in zip(parameters, usual)])
    for parameter, value, lowest, highest in zip(parameters, start, low, high):
        if not lowest < value < highest or value == 0:
            raise ArgumentError(f"parameter '{parameter.name}' is {value:g} in the file, which is not between {lowest:g} and {highest:g}",
                                "give bounds around it, and a value in the file that is not 0: NAME=PATH@LOW..HIGH", "bad-bounds")
    return low, high
