"""`roboss record`: variables of a run in an open format."""
from __future__ import annotations

import tempfile
import time
from contextlib import ExitStack
from pathlib import Path
from typing import Any, Sequence

from ..errors import ArgumentError
from .command import Parser, Progress, check_file
from .recorder import Recorded, check_order, is_journal, journal_of_run, located, opened, record_file, ways, world_of
from .recording import WRITTEN, check_package, existing
from .ros2_recorder import record_ros2, topics_of
from .variables import Variables

_EXAMPLES = """Variables are named ROBOT.WHAT; * ? [...] match many, up to the next dot, and ** beyond dots. --list shows all that a source has, with units.
  car_3.pose  car_3.x  car_3.speed  car_3.energy  car_3.contacts      of a robot
  arm.elbow.position  .velocity  .effort  .power                     of a joint
  arm.tool.pose  arm.tool.twist                                      of a link
  car_3.laser.ranges                                                 readings of a sensor
  rover.eye.color  car_3.contact_points  rover_1.radio.messages      messages: images, contact points, what a radio heard
  contact_points                                                     all contact points of the world
  car_3.**                                                           all of a robot

Examples:
  roboss record worlds/crossroads.sdf --list
  roboss record worlds/crossroads.sdf 'car_*.speed' car_3.pose --until 10 -o run.parquet
  roboss record example:city 'car_*.speed' --until 10 -o city.parquet
  roboss record worlds/crossroads.sdf '*.pose' --until 10 --orders worlds/crossroads.jsonl -o run.mcap
  roboss record run.journal 'arm.*.effort' --every 0.001 -o efforts.parquet        afterwards, from a journal
  roboss record 'run.journal#2@1.5' -o second.csv                                  branch 2 up to 1.5 s
  roboss record worlds/cameras.sdf 'rover.**' --until 5 --every 0.1 -o run.rrd     robots, images and scans for Rerun
  roboss plot run.parquet car_3.speed
  roboss record worlds/crossroads.sdf --ros2 --until 10 -o run.mcap         topics of ROS 2, for Foxglove, Lichtblick, rosbags
  roboss record run.journal --ros2 '/car_3/**' '/tf*' -o bag                a rosbag2: ros2 bag play bag
  roboss record run.journal --ros2 --list                                   the topics that there are

A world is run here; an example, and a world with --orders or --client, is first run by `roboss run` into a journal. A journal is replayed
to the last bit, so its recording is that of the run. MCAP opens in Foxglove, .rrd in Rerun, Parquet in pandas, Polars, DuckDB,
CSV in every spreadsheet."""


def parser() -> Parser:
    result = Parser("roboss record", examples=_EXAMPLES,
                    description="Records variables of a world or of a journal over time, as Parquet, MCAP, CSV or Rerun.")
    result.add_argument("source", metavar="SOURCE", help="a world (SDFormat, URDF, MJCF), example:NAME with its programs and orders, or a journal")
    result.add_argument("variables", nargs="*", metavar="VARIABLE", help="names or patterns (default: *.pose)")
    result.add_argument("-o", "--output", metavar="FILE", help="ends in .parquet, .mcap, .csv (numbers only) or .rrd (Rerun, with the robots in 3-D)")
    result.add_argument("--ros2", action="store_true", help="record the robots' topics of ROS 2, with its messages: VARIABLE is a "
                        "topic or a pattern (default: all), FILE ends in .mcap or is a new folder, a rosbag2 (docs/ros2.md)")
    result.add_argument("--list", action="store_true", help="show the variables that there are, and record nothing")
    result.add_argument("--every", type=float, default=0.01, metavar="S", help="time between two samples (default: 0.01)")
    result.add_argument("--from", type=float, dest="start", metavar="S", help="time of the first sample (default: the first)")
    result.add_argument("--until", type=float, metavar="S", help="time of the last sample (default: the end of the journal)")
    add_branch(result)
    result.add_argument("--orders", metavar="FILE", help="orders for the robots of a world, a file or a bag, as of `roboss run`")
    result.add_argument("--client", action="append", default=[], metavar="LIB", help="a control program, as of `roboss run`")
    add_common(result)
    return result


def add_branch(to: Parser) -> None:
    """For what takes a journal, which may also be named FILE#BRANCH@TIME."""
    to.add_argument("--branch", type=int, metavar="N", help="of a journal, also named FILE#N (default: the youngest)")


def add_common(to: Parser) -> None:
    """Options that all three commands have."""
    to.add_argument("--json", action="store_true", help="print the result as JSON")
    to.add_argument("--quiet", action="store_true", help="no progress")


def run(options: Any) -> Any:
    if not options.every > 0:
        raise ArgumentError(f"a time of {options.every} s between samples", "give one above 0", "bad-value")
    if not options.list:
        _check_name(options)
    options.source, options.branch, options.until = located(options.source, options.branch, options.until)
    named, options.source = options.source, existing(world_of(options.source))
    if not options.list:
        check_file(options.output, reads=[options.source, options.orders, *options.client])
    progress, begin = Progress("record", options.quiet), time.monotonic()
    with ExitStack() as stack:
        source = options.source
        if (options.orders or options.client or named != options.source) and not options.list:
            if is_journal(source):
                raise ArgumentError("--orders or --client with a journal", "leave them out: it has its orders", "bad-value")
            if options.until is None:
                raise ArgumentError("a world has no end", "say until which time (--until)", "no-end")
            check_order(options.start, options.until)
            progress.note("runs the world into a journal")
            folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="roboss_record_"))
            source = journal_of_run(named, options.until, folder, orders=options.orders, clients=options.client)
        if options.list:
            return _list(options)
        record, default = (record_ros2, None) if options.ros2 else (record_file, ["*.pose"])
        done = record(source, options.output, options.variables or default, until=options.until, every=options.every,
                      start=options.start, branch=options.branch, name=named,
                      progress=lambda now, end: progress(f"{now:.2f} of {end:.2f} s"))
    progress.note_if(ways(options.source, options.branch))
    if options.ros2:
        return _told_of_topics(options, done, progress, time.monotonic() - begin)
    if done.left_out:
        progress.note(f"without {_first_of(done.left_out)}: with {options.every:g} s between samples messages would be missing (--every)")
    result = {"file": options.output, "variables": done.variables, "left_out": list(done.left_out),
              "columns": done.columns, "samples": done.samples,
              "first_s": done.first, "last_s": done.last, "took_s": round(time.monotonic() - begin, 3)}
    if not options.json:
        print(f"{options.output}: {len(done.variables)} variables, {result['samples']} samples from "
              f"{result['first_s']:g} to {result['last_s']:g} s")
    return result


def _check_name(options: Any) -> None:
    """Refuses a name that says no format."""
    suffixes = ("", ".mcap") if options.ros2 else WRITTEN
    if options.output is None or Path(options.output).suffix not in suffixes:
        raise ArgumentError("no file to write" if options.output is None else f"a file named '{options.output}'",
                            "give -o FILE.mcap, or -o FOLDER for a rosbag2" if options.ros2 else
                            "give -o FILE.parquet, FILE.mcap, FILE.csv or FILE.rrd", "unknown-format")
    check_package(Path(options.output).suffix)


def _first_of(names: Sequence[str]) -> str:
    return ", ".join(names[:8]) + (" ..." if len(names) > 8 else "")


def _told_of_topics(options: Any, done: Recorded, progress: Progress, took: float) -> Any:
    if done.left_out:
        progress.note(f"without {_first_of(done.left_out)}: these sensors have no message in ROS 2 here")
    if not options.json:
        print(f"{options.output}: {len(done.variables)} topics, {done.messages} messages from {done.first:g} to {done.last:g} s")
    return {"file": options.output, "topics": done.variables, "left_out": list(done.left_out), "messages": done.messages,
            "first_s": done.first, "last_s": done.last, "took_s": round(took, 3)}


def _list_topics(options: Any, until: Any) -> Any:
    topics = topics_of(options.source, options.start, until, options.branch)
    if not options.json:
        width = max(len(topic.name) for topic in topics)
        for topic in topics:
            print(f"{topic.name:{width}}  {topic.type}")
    return [{"topic": topic.name, "type": topic.type, "hash": topic.hash, "latched": topic.latched} for topic in topics]


def _list(options: Any) -> Any:
    until = options.until if options.until is not None else None if is_journal(options.source) else options.start or 0.0
    if options.ros2:
        return _list_topics(options, until)
    run_of, _, _ = opened(options.source, options.start, until, options.branch)
    variables = Variables(run_of, options.variables or None, messages=True)
    found: dict[str, list] = {}
    for column in variables.columns:
        found.setdefault(column.variable, []).append(column)
    rows = [{"variable": name, "parts": [part.name[len(name) + 1:] for part in parts], "units": [part.unit for part in parts],
             "frame": parts[0].frame} for name, parts in found.items()]
    rows += [{"variable": message.name, "parts": list(message.layout.fields), "frame": message.frame,
              "units": [message.layout.units.get(name, "") for name in message.layout.fields], "message": message.layout.name}
             for message in variables.messages.variables]
    if not options.json:
        width = max(len(row["variable"]) for row in rows)
        for row in rows:
            units = list(dict.fromkeys(unit or "-" for unit in row["units"]))
            count = len(row["parts"])
            if "message" in row:
                parts = f"message of {' '.join(row['parts'])}"
            else:
                parts = "" if count == 1 else " ".join(row["parts"]) if count <= 8 else f"{count} numbers"
            print(f"{row['variable']:{width}}  {', '.join(units):12}  {parts}".rstrip())
    return rows
