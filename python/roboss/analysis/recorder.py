"""Recording of a world that is run, and of a journal that is replayed: any variables, also afterwards."""
from __future__ import annotations

import json
import os
import re
import subprocess
import tempfile
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Iterable, Iterator, Mapping, Optional, Sequence, Union

import numpy as np

from ..errors import ArgumentError, RobossError, WorldWarning
from ..journal import Journal, _Replay
from ..kinematics import RobotModel
from ..names import real, unknown
from ..outputs import check_output
from ..run import Run
from ..simulation import Simulation
from ..world import World, example, load
from .recording import WRITTEN, Recording, existing, read, write, writer_of
from .variables import ChangingVariables, Variables

Source = Union[str, os.PathLike, World, Simulation, Journal]
Progress = Callable[[float, float], None]  # gets the time and the end, s
_PROGRAM = Path(__file__).parents[1] / "program" / "bin" / "roboss"
_EXAMPLE = "example:"
_SQLITE = b"SQLite format 3\0"
_PLACE = re.compile(r"(.+?)(?:#(\d+))?(?:@(\d+(?:\.\d*)?))?")  # FILE[#BRANCH][@TIME]


def record(source: Source, patterns: Union[str, Iterable[str], None] = None, *, until: Optional[float] = None,
           every: float = 0.01, start: Optional[float] = None, branch: Optional[int] = None,
           progress: Optional[Progress] = None) -> Recording:
    """Records variables of a run.

    Args:
        source: a journal (its path, also as FILE#BRANCH and FILE@UNTIL, or a Journal), which is replayed; a world (its
            path, or a World), which is run; a Simulation, which is stepped on; or the path of a recording, of which a
            part is taken.
        patterns: of variables, as of Variables; None: all.
        until: time of the last sample, s; None: the end of the journal.
        every: time between two samples, s; rounded to ticks, at least one.
        start: time of the first sample, s; None: the beginning of the journal, the present of a Simulation.
        branch: of a journal; None: the youngest.
        progress: is called at each sample.

    Raises:
        UnknownNameError: a pattern matches no variable.
        ArgumentError: a world needs `until` (code "no-end"), or a time that is not there.

    >>> recording = roboss.analysis.record(roboss.example("crossroads.sdf"), "car_*.speed", until=0.1)
    >>> recording.values.shape                      # 0, 0.01 ... 0.1 s; 16 cars
    (11, 16)
    """
    if not isinstance(source, (World, Simulation, Journal)) and Path(source).suffix in WRITTEN:
        return _part(read(source), patterns, start, until)
    run, last, name = opened(source, start, until, branch)
    variables = variables_of(run, last, patterns)
    times, rows = [], []
    for sim in samples(run, last, every):
        times.append(sim.time)
        rows.append(variables.read())
        if progress:
            progress(sim.time, last)
    return Recording(np.array(times), variables.columns, np.array(rows).reshape(len(times), -1), _facts(run, name, variables))


@dataclass
class Recorded:
    """What record_file() wrote.

    Attributes:
        variables: names, those of messages last.
        columns: number of columns of numbers.
        samples: number of samples.
        first, last: their times, s.
        left_out: names of messages that match a pattern, but need samples more often; of record_ros2() of sensors without
            a message in ROS 2.
        messages: number of messages of record_ros2().
    """

    variables: list[str]
    columns: int
    samples: int = 0
    first: float = 0.0
    last: float = 0.0
    left_out: Sequence[str] = ()
    messages: int = 0


def record_file(source: Source, path: Union[str, os.PathLike], patterns: Union[str, Iterable[str], None] = None, *,
                until: Optional[float] = None, every: float = 0.01, start: Optional[float] = None,
                branch: Optional[int] = None, progress: Optional[Progress] = None, name: str = "") -> Recorded:
    """Records variables of a run into a file (.parquet, .mcap, .csv or .rrd) while it runs, so memory does not grow with its
    length. A Rerun recording (.rrd) draws the whole world, too, whatever is chosen.

    Takes messages, too, except in a table (.csv): images, contact points, what radios heard (unless `every` is too long for
    them: `left_out`). After an error or Ctrl-C the file has all samples so far.

    Args:
        name: what the file calls the source; "": its path.
        others: as of record().

    For instance `record_file("crossroads.sdf", "run.mcap", ["car_3.pose", "car_3.contact_points"], until=10)`.
    """
    if not isinstance(source, (World, Simulation, Journal)) and Path(source).suffix in WRITTEN:
        part = _part(read(source), patterns, start, until)
        write(part, path)
        ends = (float(part.time[0]), float(part.time[-1])) if len(part.time) else (0.0, 0.0)
        return Recorded(list(part.variables), len(part.columns), len(part.time), *ends)
    run, last, ending = opened(source, start, until, branch)
    check_output(path, reads=[located(source, branch, until)[0]])
    takes_messages = Path(path).suffix != ".csv"
    variables = variables_of(run, last, patterns, messages=takes_messages, every=_ticks(run, every) * run.dt)
    names = [*dict.fromkeys(c.variable for c in variables.columns), *(m.name for m in variables.messages.variables)]
    done = Recorded(names, len(variables.columns), first=run.time, left_out=tuple(variables.left_out))
    facts = _facts(run, name or ending, variables)
    with writer_of(path, variables.columns, facts, variables.messages.variables, run) as writer:
        for sim in samples(run, last, every):
            writer.add(sim.time, variables.read(), variables.messages.read())
            done.samples, done.last = done.samples + 1, sim.time
            if progress:
                progress(sim.time, last)
    return done


def variables_of(run: Run, last: float, patterns: Union[str, Iterable[str], None], messages: bool = False,
                 every: float = 0.0) -> Variables:
    """Variables of the run up to a time, s, also of robots that come only later in a recording."""
    later = later_runs(run, last)
    if not later:
        return Variables(run, patterns, messages, every)
    return ChangingVariables(run, later, patterns, messages, every)


def later_runs(run: Run, last: float) -> list[Run]:
    """A run of each world that a recording comes to have up to a time, s, as robots come and go; empty: it keeps its own."""
    return run._later(last) if isinstance(run, _Replay) else []


def ways(source: Source, branch: Optional[int] = None) -> str:
    """Through which branches a journal leads, in words, if there are several; else empty."""
    source, branch, _ = located(source, branch, None)
    if isinstance(source, (World, Simulation)) or not (isinstance(source, Journal) or is_journal(source)):
        return ""
    parts = (source if isinstance(source, Journal) else Journal(source)).lineage(branch)
    return "goes through " + ", ".join(f"branch {number} to {until:g} s" for number, _, until in parts) if len(parts) > 1 else ""


def _facts(run: Run, name: str, variables: Variables) -> dict[str, Any]:
    """What a recording says of its run."""
    return {"source": name, "world": run.world.name, "world_hash": run.world.hash, "dt": run.dt,
            "gravity": list(run.world.gravity), "mass_kg": masses(run.world, {c.name.split(".")[0] for c in variables.columns})}


def masses(world: World, robots: Iterable[str]) -> dict[str, float]:
    """Masses of robots with a free base, kg: the first number of their mass matrix."""
    found = {}
    for robot in sorted(set(robots) & set(world.robots)):
        if world._facts_of(world.robots.index(robot)).free_base:
            model = RobotModel(world, robot, cut_loops=True)
            found[robot] = float(model.mass_matrix(model.start)[0, 0])
    return found


def journal_of_run(world: Union[str, os.PathLike], until: float, folder: Union[str, os.PathLike], *,
                   orders: Optional[str] = None, clients: Sequence[str] = (),
                   options: Optional[Mapping[str, Any]] = None) -> Path:
    """Runs a world by the program `roboss`, with orders, control programs and options of load(), and gives the path of
    its journal.

    Raises:
        RobossError: the run failed; the text is what the program printed.
    """
    journal = Path(folder) / "run.journal"
    command = [str(_PROGRAM), "run", os.fspath(world), "--headless", "--quiet", "--speed", "max", "--duration", repr(until),
               "--journal", str(journal)]
    command += ["--orders", orders] if orders else []
    for client in clients:
        command += ["--client", client]
    command += _words(options or {})
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        raise RobossError("the run failed:\n" + done.stderr.strip(), "", "run-failed")
    return journal


def _words(options: Mapping[str, Any]) -> list[str]:
    """Options of load() as those of `roboss run`."""
    words = ["--ground"] if options.get("ground") else []
    words += ["--on-ground"] if options.get("on_ground") else []
    words += ["--dt", repr(options["dt"])] if options.get("dt") else []
    for option, name in (("--fixed-base", "fixed_base"), ("--path", "search_paths")):
        for value in options.get(name, ()):
            words += [option, os.fspath(value)]
    return words


def is_journal(path: Union[str, os.PathLike]) -> bool:
    """Whether the file is a journal or a saved run."""
    try:
        with open(path, "rb") as stream:
            return stream.read(len(_SQLITE)) == _SQLITE
    except OSError:
        return False


def located(source: Source, branch: Optional[int], until: Optional[float]) -> tuple[Source, Optional[int], Optional[float]]:
    """The source, the branch, and the time of the last sample, s. A journal may be named FILE#BRANCH@TIME, as other commands
    take it (docs/journal.md). A file that exists under the whole name is that file.

    Raises:
        ArgumentError: the name and `branch` or `until` differ (code "bad-value").
    """
    if isinstance(source, (World, Simulation, Journal)) or os.path.exists(source):
        return source, branch, until
    found = _PLACE.fullmatch(os.fspath(source))
    if not found or not is_journal(found[1]):
        return source, branch, until
    for option, named, value in (("--branch", found[2], branch), ("--until", found[3], until)):
        if named is not None and value is not None and float(named) != value:
            raise ArgumentError(f"'{os.fspath(source)}' and {option} {value:g}", f"leave {option} out, or name the file alone",
                                "bad-value")
    return (found[1], branch if found[2] is None else int(found[2]), until if found[3] is None else float(found[3]))


def opened_world(path: Union[str, os.PathLike], **options) -> World:
    """load(), without its warnings: a recording is not the place for them (`roboss check` has them)."""
    return quietly_loaded(existing(world_of(path)), **options)


def world_of(source: Union[str, os.PathLike]) -> str:
    """The path of the world of `example:NAME`, as `roboss run` takes it; of any other source its own path.

    Raises:
        UnknownNameError: no example has this name.
    """
    path = os.fspath(source)
    if not path.startswith(_EXAMPLE):
        return path
    worlds = {entry["name"]: entry["world"] for entry in json.loads(Path(example("examples.json")).read_text(encoding="utf-8"))}
    name = path.removeprefix(_EXAMPLE)
    if name not in worlds:
        raise unknown("example", name, sorted(worlds))
    return example(worlds[name])


def quietly_loaded(world: Union[str, os.PathLike], **options) -> World:
    """load() of a path or of a text, without its warnings."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", WorldWarning)
        return load(world, **options)


def opened(source: Source, start: Optional[float], until: Optional[float],
           branch: Optional[int]) -> tuple[Run, float, str]:
    """The run at its first sample, the time of the last, and what it is."""
    source, branch, until = located(source, branch, until)
    if not isinstance(source, (World, Simulation, Journal)):
        source = existing(world_of(source))
    check_order(start, until)
    if isinstance(source, Journal) or (not isinstance(source, (World, Simulation)) and is_journal(source)):
        journal = source if isinstance(source, Journal) else Journal(source)
        first, last = journal.times(branch)
        end = last if until is None else until
        if not first <= end <= last + 1e-9:
            journal.at(end, branch)  # says which branch has it
        return journal.at(first if start is None else start, branch), end, journal.path
    if until is None:
        raise ArgumentError("a world has no end", "say until which time (--until)", "no-end")
    if isinstance(source, Simulation):
        sim, name = source, source.world.file
    else:
        world = source if isinstance(source, World) else opened_world(source)
        sim, name = Simulation(world), world.file
    for time in (start, until):
        if time is not None and not sim.time - 1e-9 <= time < np.inf:
            raise ArgumentError(f"'{name}' has no time {time:g} s", f"give {sim.time:g} s or later (--from, --until)", "no-such-time")
    if start is not None and start > sim.time:
        sim.step(round(start / sim.dt) - sim.tick)
    return sim, until, name


def check_order(start: Optional[float], until: Optional[float]) -> None:
    """Refuses a range of times that ends before it starts."""
    times = [real("time", time) for time in (start, until) if time is not None]
    if times != sorted(times):
        raise ArgumentError(f"times from {start:g} to {until:g} s", "let them end after they start (--from, --until)", "bad-value")


def samples(run: Run, last: float, every: float) -> Iterator[Run]:
    """The run at each time of a sample, until `last`, s."""
    ticks = _ticks(run, every)
    yield run
    while run.tick + ticks <= round(last / run.dt):
        run.step(ticks)
        yield run


def _ticks(run: Run, every: float) -> int:
    """From sample to sample."""
    return max(1, round(every / run.dt))


def _part(recording: Recording, patterns: Union[str, Iterable[str], None], start: Optional[float],
          until: Optional[float]) -> Recording:
    """Some columns and times of a recording."""
    check_order(start, until)
    chosen = range(len(recording.columns)) if patterns is None else recording.select(patterns)
    rows = np.ones(len(recording.time), dtype=bool)
    if start is not None:
        rows &= recording.time >= start - 1e-9
    if until is not None:
        rows &= recording.time <= until + 1e-9
    if not rows.any():
        ends = f"it begins at {recording.time[0]:g} s and ends at {recording.time[-1]:g} s" if len(rows) else "it is empty"
        raise ArgumentError(f"the recording has no sample at these times: {ends}", "give times between these (--from, --until)", "no-such-time")
    columns = [recording.columns[number] for number in chosen]
    return Recording(recording.time[rows], columns, recording.values[rows][:, list(chosen)], recording.facts)
