"""`roboss analyse`: reports on arms, vehicles and walkers."""
from __future__ import annotations

from pathlib import Path
from typing import Any, Iterable, Optional

import numpy as np

from ..errors import ArgumentError
from .command import Parser, Progress, check_file
from .record_command import add_branch, add_common
from .recorder import is_journal, located, record, ways
from .recording import SUFFIXES, Recording, read, write

_ARM = """Examples:
  roboss analyse arm worlds/arm.sdf --robot arm --link tool          the whole test, some minutes
  roboss analyse arm worlds/arm.sdf --cycles 5 --speeds 1 --loads 1 --keep test.parquet
  roboss analyse arm test.parquet                                    a recording (or .mcap, .csv), of this test or your own
  roboss analyse arm run.parquet --measured arm.tool.pose --commanded arm.tool.command
  roboss analyse arm arm_1.parquet --exchange arm_2.parquet arm_3.parquet   exchangeability of arms of one type

The test: a servo (PID and feed-forward, with encoders) drives the tool through the poses P1 to P5 of a cube, --cycles
times for each load and speed. In a recording, test poses are where the commanded pose rests."""
_VEHICLE = """Examples:
  roboss analyse vehicle worlds/crossroads.sdf --robot car_0
  roboss analyse vehicle rover.sdf --left wheel_fl wheel_rl --right wheel_fr wheel_rr --speed 1

The other robots of the world are left out. The vehicle starts where it stands; it needs free, flat ground around it."""
_WALKER = """Examples:
  roboss analyse walker run.journal --robot spider_0
  roboss record run.journal 'spider_0.**' -o run.parquet   and then   roboss analyse walker run.parquet
  roboss analyse walker run.parquet --robot spider_0 --from 2 --mass 3.5

It takes the efforts and velocities of all joints of the robot, and its pose."""


def parser() -> Parser:
    result = Parser("roboss analyse", examples="Examples: see `roboss analyse arm --help`, and the others.",
                    description="Makes reports: one HTML page each, with tables and pictures.")
    kinds = result.add_subparsers(dest="kind", required=True, metavar="KIND", parser_class=Parser)
    arm = _kind(kinds, "arm", "pose and path accuracy and repeatability by ISO 9283", _ARM, "a recording, a world or a URDF")
    arm.add_argument("--measured", metavar="VAR", help="of a recording: the attained poses (default: the *.pose with a *.command)")
    arm.add_argument("--commanded", metavar="VAR", help="of a recording: the commanded poses (default: the *.command)")
    arm.add_argument("--band", type=float, metavar="M", help="limit band of stabilisation (default: RP, at least 0.1 mm)")
    arm.add_argument("--drift-visits", type=int, default=10, metavar="N",
                     help="first and last visits to a pose that are compared for its drift (default: 10, as in the standard)")
    arm.add_argument("--exchange", nargs="+", default=[], metavar="FILE",
                     help="of a recording: recordings of other arms with the same program, for the exchangeability")
    arm.add_argument("--link", help="whose frame is measured (default: the last link)")
    arm.add_argument("--payload", type=float, default=2.0, metavar="KG", help="rated load (default: 2)")
    arm.add_argument("--loads", type=float, nargs="+", default=[0.1, 1.0], metavar="X", help="shares of it (default: 0.1 1)")
    arm.add_argument("--speeds", type=float, nargs="+", default=[1.0, 0.5], metavar="X",
                     help="shares of the joints' largest velocities (default: 1 0.5)")
    arm.add_argument("--cycles", type=int, default=30, metavar="N", help="default: 30, as in the standard")
    arm.add_argument("--center", type=float, nargs=3, metavar=("X", "Y", "Z"), help="of the cube, m (default: found)")
    arm.add_argument("--side", type=float, metavar="M", help="of the cube (default: the largest of the standard that it reaches)")
    arm.add_argument("--orientation", type=float, nargs=4, metavar=("QX", "QY", "QZ", "QW"),
                     help="of the tool (default: 0 1 0 0, it looks down; if it cannot, as at the start; of an arm with fewer "
                          "than six joints that cannot keep it, free)")
    arm.add_argument("--servo-hz", type=float, default=8.0, metavar="HZ", help="bandwidth of the PID (default: 8)")
    arm.add_argument("--encoder-bits", type=int, default=19, metavar="N", help="steps per turn: 2^N (default: 19)")
    arm.add_argument("--encoder-noise", type=float, default=1e-5, metavar="RAD", help="standard deviation (default: 1e-5)")
    arm.add_argument("--force", type=float, metavar="N", help="largest, for the compliance (default: the rated load's weight)")
    arm.add_argument("--seed", type=int, default=1, metavar="N", help="of the noise (default: 1)")
    arm.add_argument("--keep", metavar="FILE", help="write the recordings of the test (.parquet, .mcap)")
    arm.add_argument("--ground", action="store_true", help="add a ground, for a URDF")
    arm.add_argument("--fixed-base", action="append", default=[], metavar="NAME", help="weld this model to the world, for a URDF")
    vehicle = _kind(kinds, "vehicle", "circle, stop, weave and the squares of UMBmark", _VEHICLE, "a world")
    vehicle.add_argument("--left", nargs="+", metavar="JOINT", help="wheels (default: joints with 'left' in their names)")
    vehicle.add_argument("--right", nargs="+", metavar="JOINT", help="wheels (default: joints with 'right' in their names)")
    vehicle.add_argument("--speed", type=float, default=0.5, metavar="M/S", help="of the drives (default: 0.5)")
    vehicle.add_argument("--radius", type=float, default=2.0, metavar="M", help="of the circle (default: 2)")
    vehicle.add_argument("--side", type=float, default=4.0, metavar="M", help="of the squares (default: 4, as in UMBmark)")
    vehicle.add_argument("--track", type=float, metavar="M",
                         help="nominal distance of the wheels (default: the effective one, from a turn on the spot)")
    vehicle.add_argument("--runs", type=int, default=5, metavar="N", help="squares in each direction (default: 5)")
    walker = _kind(kinds, "walker", "cost of transport, torque and power of each joint", _WALKER, "a recording, a journal or a world")
    walker.add_argument("--mass", type=float, metavar="KG", help="of the robot (default: as recorded)")
    walker.add_argument("--from", type=float, dest="start", metavar="S", help="first time (default: all)")
    walker.add_argument("--until", type=float, metavar="S", help="last time")
    add_branch(walker)
    walker.add_argument("--every", type=float, default=0.0, metavar="S", help="of a journal or world (default: each tick)")
    return result


def _kind(kinds: Any, name: str, what: str, examples: str, source: str) -> Parser:
    result = kinds.add_parser(name, help=what, examples=examples, description=f"Reports {what}.")
    result.add_argument("source", metavar="SOURCE", help=source)
    result.add_argument("--robot", help="its name (default: the only one)")
    result.add_argument("-o", "--output", default="report.html", metavar="FILE", help="the page (default: report.html)")
    add_common(result)
    return result


def run(options: Any) -> Any:
    if options.kind == "walker":
        options.source, options.branch, options.until = located(options.source, options.branch, options.until)
    check_file(options.output, "html", [options.source, *getattr(options, "exchange", [])])
    report = {"arm": _arm, "vehicle": _vehicle, "walker": _walker}[options.kind](options, Progress("analyse", options.quiet))
    report.write(options.output)
    if not options.json:
        print(f"{options.output}: {report.title}")
    return {"file": options.output, "title": report.title, "tables": report.data}


def _arm(options: Any, progress: Progress) -> Any:
    from .arm import analyse_arm, exchangeability
    from .reports import arm_report
    if Path(options.source).suffix in SUFFIXES:
        conditions, measured = _recorded_arm(options.source, options)
        others = [_recorded_arm(other, options)[0] for other in options.exchange]
        exchange = exchangeability([conditions[0], *(some[0] for some in others)]) if others else ()
        facts = [("Recording", options.source)] + [("Other arm", other) for other in options.exchange]
        return arm_report(f"Arm: {measured}", conditions, facts, exchange=exchange)
    if options.exchange:
        raise ArgumentError("--exchange with a world", "give a recording of each arm", "bad-value")
    if options.keep:
        check_file(options.keep, reads=[options.source])
    from .arm_driver import ArmDriver, ArmTest
    load_options = {"ground": options.ground, "fixed_base": options.fixed_base}
    if options.cycles < 2 or options.servo_hz <= 0 or min(options.speeds) <= 0 or min(options.loads) < 0:
        raise ArgumentError("too few cycles, or a speed, load or bandwidth that is too low",
                            "give 2 cycles or more, and numbers above 0", "bad-value")
    test = ArmTest(options.source, options.robot, options.link, options.payload, tuple(options.loads), tuple(options.speeds),
                   options.cycles, center=options.center and tuple(options.center), side=options.side,
                   orientation=options.orientation and tuple(options.orientation), servo_hz=options.servo_hz,
                   encoder_bits=options.encoder_bits, encoder_noise=options.encoder_noise, seed=options.seed, load_options=load_options)
    driver = ArmDriver(test)
    measured, commanded = (f"{driver.robot}.{driver.link}.{what}" for what in ("pose", "command"))
    progress.note(f"cube of {driver.cube.side:g} m at {' '.join(f'{x:.3f}' for x in driver.cube.center)}")
    kept, conditions = [], []
    for name, recording in driver.recordings(lambda name, share: progress(f"{name}: {100 * share:.0f} %")):
        kept.append(recording)
        conditions.append(analyse_arm(recording.time, recording[measured], recording[commanded], name=name, band=options.band,
                                      drift_visits=options.drift_visits))
        progress.note(f"{name}: RP {1e3 * max(p.score.repeatability for p in conditions[-1].poses):.4f} mm")
    if options.keep:
        write(_joined(kept), options.keep)
    force = options.force or 9.81 * options.payload
    cube = driver.cube
    turn = "free: positions only" if cube.turns else " ".join(f"{x:.3g}" for x in cube.poses[0, 3:]) + " (x y z w)"
    facts = [("World", options.source), ("Robot and link", f"{driver.robot}, {driver.link}"),
             ("Cube", f"{cube.side:g} m, centre {' '.join(f'{x:.3f}' for x in cube.center)} m"),
             ("Orientation of the tool", turn),
             ("Cycles", str(test.cycles)), ("Rated load", f"{test.payload:g} kg"),
             ("Servo", f"PID of {test.servo_hz:g} Hz, torques of the unloaded arm fed forward"),
             ("Encoders", f"2^{test.encoder_bits} steps per turn, noise {test.encoder_noise:g} rad, seed {test.seed}")]
    return arm_report(f"Arm: {driver.robot} of {Path(options.source).name}", conditions, facts,
                      driver.stiffness(force) if force > 0 else None)


def _recorded_arm(path: str, options: Any) -> tuple[list[Any], str]:
    """Figures of each condition of a recording, and the name of the measured poses."""
    from .arm import analyse_arm
    recording = read(path)
    measured, commanded = _pose_names(recording, options)
    return [analyse_arm(part.time, part[measured], part[commanded], name=name, band=options.band, drift_visits=options.drift_visits)
            for name, part in _conditions(recording)], measured


def _pose_names(recording: Recording, options: Any) -> tuple[str, str]:
    commands = [name for name in recording.variables if name.endswith(".command")]
    commanded = options.commanded or (commands[0] if len(commands) == 1 else None)
    measured = options.measured or (commanded[:-len("command")] + "pose" if commanded and commanded.endswith(".command") else None)
    if commanded is None or measured is None:
        raise ArgumentError(f"it is not clear which poses are commanded; there is {', '.join(recording.variables[:12])}",
                            "name them: --measured VAR --commanded VAR", "which-variable")
    for name in (measured, commanded):
        if recording[name].ndim != 2 or recording[name].shape[1] != 7:
            raise ArgumentError(f"'{name}' is no pose", "name variables of x y z qx qy qz qw", "no-pose")
    _check_complete(recording, (measured, commanded))
    return measured, commanded


def _check_complete(recording: Recording, names: Iterable[str]) -> None:
    """Refuses gaps and times that do not ascend, as tables of other programs may have them."""
    if len(recording.time) < 2 or not (np.diff(recording.time) > 0).all():
        raise ArgumentError("the times of the recording do not ascend", "give two samples or more, sorted by time", "bad-times")
    for name in names:
        if not np.isfinite(recording[name]).all():
            raise ArgumentError(f"'{name}' has samples without a value", "leave these samples out, or interpolate them", "has-gaps")


def _conditions(recording: Recording) -> list[tuple[str, Recording]]:
    """The parts of a recording by "test.load" and "test.speed", if it has them."""
    if "test.load" not in recording or "test.speed" not in recording:
        return [("", recording)]
    kinds = np.column_stack([recording["test.load"], recording["test.speed"]])
    parts = []
    for load, speed in dict.fromkeys(map(tuple, kinds)):
        rows = (kinds == (load, speed)).all(axis=1)
        parts.append((f"{load:g} kg, {100 * speed:g} % of speed",
                      Recording(recording.time[rows], recording.columns, recording.values[rows], recording.facts)))
    return parts


def _joined(recordings: list[Recording]) -> Recording:
    """One recording of all conditions, one behind the other."""
    times, end = [], 0.0
    for part in recordings:
        times.append(part.time + end)
        end = times[-1][-1] + 1.0
    return Recording(np.concatenate(times), recordings[0].columns, np.vstack([part.values for part in recordings]),
                     recordings[0].facts)


def _vehicle(options: Any, progress: Progress) -> Any:
    from .reports import vehicle_report
    from .vehicle_driver import VehicleDriver, VehicleTest
    if min(options.speed, options.radius, options.side) <= 0 or options.runs < 1:
        raise ArgumentError("a speed, radius or side that is not above 0, or no runs", "give numbers above 0", "bad-value")
    driver = VehicleDriver(VehicleTest(options.source, options.robot, options.left, options.right, options.speed, options.radius,
                                       options.side, options.runs, options.track), progress)
    facts = [("World", options.source), ("Robot", driver.robot), ("Wheels left", ", ".join(driver.left)),
             ("Wheels right", ", ".join(driver.right)), ("Effective radius of the wheels", f"{driver.wheel_radius:.5f} m"),
             ("Track, by its contacts", f"{driver.contact_track:.4f} m"), ("Track, nominal", f"{driver.track:.4f} m"), ("Squares", f"{options.runs} of {options.side:g} m in each direction")]
    return vehicle_report(f"Vehicle: {driver.robot} of {Path(options.source).name}", facts, driver.circle(), driver.stop(),
                          driver.weave(), driver.umbmark())


def _walker(options: Any, progress: Progress) -> Any:
    from . import walker
    from .reports import walker_report
    if options.mass is not None and not 0 < options.mass < np.inf:
        raise ArgumentError(f"a mass of {options.mass:g} kg", "give one above 0 (--mass)", "bad-value")
    robot = options.robot
    patterns = [f"{robot or '*'}.*.effort", f"{robot or '*'}.*.velocity", f"{robot or '*'}.pose"]
    recording = record(options.source, patterns, until=options.until, every=options.every, start=options.start,
                       branch=options.branch, progress=lambda now, end: progress(f"{now:.2f} of {end:.2f} s"))
    progress.note_if(ways(options.source, options.branch))
    robots = {name[:-len(".pose")] for name in recording.variables if name.endswith(".pose")}
    robots = {name for name in robots if any(v.startswith(name + ".") and v.endswith(".effort") for v in recording.variables)}
    if robot is None and len(robots) != 1:
        raise ArgumentError(f"there are {len(robots)} robots with efforts and a pose", "name one (--robot)", "which-robot")
    robot = robot or robots.pop()
    joints = [name[len(robot) + 1:-len(".effort")] for name in recording.variables
              if name.startswith(robot + ".") and name.endswith(".effort") and name[:-6] + "velocity" in recording]
    if recording[f"{robot}.pose"].ndim != 2:
        raise ArgumentError(f"'{robot}.pose' is no pose", "give its x and y, or all of it", "no-pose")
    _check_complete(recording, [f"{robot}.pose", *(f"{robot}.{joint}.{what}" for joint in joints for what in ("effort", "velocity"))])
    units = {column.variable: column.unit for column in recording.columns}
    efforts = np.column_stack([recording[f"{robot}.{joint}.effort"] for joint in joints])
    velocities = np.column_stack([recording[f"{robot}.{joint}.velocity"] for joint in joints])
    mass: Optional[float] = options.mass or recording.facts.get("mass_kg", {}).get(robot)
    gravity = float(np.linalg.norm(recording.facts.get("gravity", [9.81])))
    transport = walker.transport_score(recording.time, efforts * velocities, recording[f"{robot}.pose"][:, :2], mass, gravity) \
        if mass else None
    demands = {joint: (walker.joint_demand(recording.time, efforts[:, n], velocities[:, n]), units[f"{robot}.{joint}.effort"])
               for n, joint in enumerate(joints)}
    facts = [("Source", options.source), ("Robot", robot), ("Time", f"{recording.time[0]:g} to {recording.time[-1]:g} s, "
             f"{len(recording.time)} samples"), ("Mass", f"{mass:.4g} kg" if mass else "unknown (--mass)")]
    return walker_report(f"Walker: {robot}", facts, recording.time, transport, demands, efforts * velocities)
