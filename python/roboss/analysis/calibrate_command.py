"""`roboss calibrate`: numbers of a world file, fitted to recorded runs of the real robot."""
from __future__ import annotations

import math
import re
from typing import Any, Optional

from ..errors import ArgumentError
from .command import Parser, Progress, check_file
from .record_command import add_common
from .recording import existing, read

_EXAMPLES = """Examples:
  roboss calibrate robot.sdf --run straight.parquet=straight.jsonl --run turn.parquet=turn.jsonl \\
      --parameter "motor=.//model[@name='robot']//axis/limit/effort" \\
      --parameter "friction=.//collision[@name='tyre']/surface/friction/ode/mu@0.2..2" -o calibrated.sdf
  roboss calibrate robot.urdf --ground --run a.parquet=a.jsonl --parameter "mass=.//link[@name='base']/inertial/mass/@value"

A parameter is NAME=PATH[,PATH ...][@LOW..HIGH]: elements of the file by ElementTree's subset of XPath; /@ATTRIBUTE at
the end names an attribute. All of them get the same number. Without bounds: a tenth to ten times the value in the file.
Elements of included files are not searched.

A run is RECORDING[=ORDERS]: a table of `roboss record`, or any Parquet or CSV file with a column 'time' (s) and columns named
as those of `roboss record` (robot.x, robot.yaw, robot.joint.position ...), and the orders that the robot had. The robot
starts as the file says; --fit-start finds where it stood, --fit-time when the run began on the tracker's clock:
  roboss calibrate robot.sdf --run straight.csv=straight.jsonl --fit-start robot --fit-time 0.5 --parameter ...
Use short runs in which one or two parameters dominate. Empty cells are left out."""
_RUN = re.compile(r"(.*?\.(?:parquet|mcap|csv))(?:=(.+))?")
_PARAMETER = re.compile(r"([^=]+)=(.+?)(?:@([^]/'\"]+)\.\.([^]/'\"]+))?")


def parser() -> Parser:
    result = Parser("roboss calibrate", examples=_EXAMPLES,
                    description="Fits numbers of a world file to recorded runs, with 95 % confidence intervals.")
    result.add_argument("world", metavar="WORLD", help="the file (SDFormat, URDF) with the numbers to start from")
    result.add_argument("--run", action="append", required=True, metavar="RECORDING[=ORDERS]", help="a recorded run (may be repeated)")
    result.add_argument("--parameter", action="append", required=True, metavar="NAME=PATH", help="a number to find (may be repeated)")
    result.add_argument("--compare", nargs="+", metavar="VARIABLE",
                        help="patterns of what is compared (default: *.x *.y *.yaw *.*.position)")
    result.add_argument("--fit-start", nargs="+", default=[], metavar="ROBOT",
                        help="find x, y (within 1 m of the file's) and yaw (1 rad) of its start, for each run")
    result.add_argument("--fit-time", type=float, metavar="S", help="find when each run began on the recording's clock, at most S off")
    result.add_argument("--client", action="append", default=[], metavar="LIB", help="a control program, as of `roboss run`")
    result.add_argument("--ground", action="store_true", help="add a ground, for a URDF")
    result.add_argument("--fixed-base", action="append", default=[], metavar="NAME", help="weld this model to the world, for a URDF")
    result.add_argument("--path", action="append", default=[], metavar="FOLDER", help="where model:// and package:// are looked up")
    result.add_argument("--dt", type=float, metavar="S", help="time step (default: the world's)")
    result.add_argument("-o", "--output", metavar="FILE", help="write the world with the numbers found")
    add_common(result)
    return result


def run(options: Any) -> Any:
    from .calibration import PATTERNS, Parameter, TestRun, calibrate
    if options.output:
        check_file(options.output, "world", [options.world, *options.client])
    if options.fit_time is not None and not options.fit_time > 0:
        raise ArgumentError(f"--fit-time {options.fit_time:g}", "give the largest offset, in s, above 0", "bad-value")
    parameters = []
    for text in options.parameter:
        found = _PARAMETER.fullmatch(text)
        if not found:
            raise ArgumentError(f"a parameter '{text}'", "write NAME=PATH or NAME=PATH@LOW..HIGH", "bad-value")
        name, paths, low, high = found.groups()
        try:
            bounds = [None if bound is None else float(bound) for bound in (low, high)]
        except ValueError:
            raise ArgumentError(f"bounds '{low}..{high}' of parameter '{name}'", "give two numbers", "bad-value") from None
        parameters.append(Parameter(name.strip(), tuple(_paths(paths)), *bounds))
    runs = []
    for text in options.run:
        found = _RUN.fullmatch(text)
        if not found:
            raise ArgumentError(f"a run '{text}'", "write FILE.parquet or FILE.parquet=ORDERS.jsonl (.mcap and .csv, too)", "bad-value")
        runs.append(TestRun(read(existing(found[1])), found[2] and existing(found[2]), found[1]))
    loading = {"ground": options.ground, "fixed_base": options.fixed_base, "dt": options.dt, "search_paths": options.path}
    result = calibrate(options.world, parameters, runs, compare=options.compare or PATTERNS,
                       clients=[existing(client) for client in options.client], options=loading,
                       fit_start=options.fit_start, fit_time=options.fit_time,
                       progress=Progress("calibrate", options.quiet))
    if options.output:
        with open(options.output, "w", encoding="utf-8") as file:
            file.write(result.world)
    if not options.json:
        _print(result)
        if options.output:
            print(f"written: {options.output}")
    return {"parameters": [{"name": name, "start": float(result.start[n]), "value": float(result.values[n]),
                            "low": _number(result.low[n]), "high": _number(result.high[n]), "at_bound": bool(result.at_bound[n])}
                           for n, name in enumerate(result.names)],
            "correlation": [[_number(value) for value in row] for row in result.correlation], "compared": result.compared,
            "rms": result.rms, "rms_before": result.rms_before, "simulations": result.simulations,
            "converged": result.converged, "file": options.output}


def _print(result: Any) -> None:
    width = max(9, *(len(name) for name in result.names))
    print(f"{'parameter':{width}}  {'file':>10}  {'found':>10}  95 % interval")
    for n, name in enumerate(result.names):
        interval = "at its bound: widen it (@LOW..HIGH)" if result.at_bound[n] else f"{result.low[n]:.5g} to {result.high[n]:.5g}"
        print(f"{name:{width}}  {result.start[n]:10.5g}  {result.values[n]:10.5g}  {interval}")
    for first in range(len(result.names)):
        for second in range(first):
            if abs(result.correlation[first, second]) > 0.95:
                print(f"{result.names[second]} and {result.names[first]} are hardly identifiable: the correlation of their "
                      f"errors is {result.correlation[first, second]:.3f}")
    print(f"compared: {', '.join(result.compared)}")
    for unit, rms in result.rms.items():
        print(f"rms difference  {result.rms_before[unit]:.3g} -> {rms:.3g} {unit}")
    print(f"{result.simulations} simulations" + ("" if result.converged else "; no minimum was found: the last values are shown"))


def _number(value: float) -> Optional[float]:
    return float(value) if math.isfinite(value) else None


def _paths(text: str) -> list[str]:
    """Parts between commas that stand in no brackets."""
    return [part.strip() for part in re.split(r",(?![^\[]*\])", text)]
