"""`roboss plot`: quick pictures of variables."""
from __future__ import annotations

from typing import Any

from ..errors import ArgumentError
from .command import Parser, Progress, check_file
from .record_command import add_branch, add_common
from .recorder import located, record, ways

_EXAMPLES = """Examples:
  roboss plot run.parquet car_3.speed 'arm.*.effort'       one diagram for each unit, into plot.png
  roboss plot run.mcap 'car_*.y' --against car_3.x -o paths.svg
  roboss plot run.journal '*.speed'                        straight from a journal
  roboss plot worlds/crossroads.sdf 'car_*.z' --until 1    or a world"""


def parser() -> Parser:
    result = Parser("roboss plot", examples=_EXAMPLES, description="Draws variables over time, as PNG, SVG or PDF.")
    result.add_argument("source", metavar="FILE", help="a recording (.parquet, .mcap, .csv), a journal, or a world")
    result.add_argument("variables", nargs="+", metavar="VARIABLE", help="names or patterns, as of `roboss record`")
    result.add_argument("-o", "--output", default="plot.png", metavar="FILE", help=".png, .svg or .pdf (default: plot.png)")
    result.add_argument("--against", metavar="COLUMN", help="the horizontal axis (default: time)")
    result.add_argument("--title", default="", help="above the diagrams")
    result.add_argument("--every", type=float, default=0.01, metavar="S", help="of a journal or world (default: 0.01)")
    result.add_argument("--from", type=float, dest="start", metavar="S", help="first time")
    result.add_argument("--until", type=float, metavar="S", help="last time")
    add_branch(result)
    add_common(result)
    return result


def run(options: Any) -> Any:
    from . import pictures
    if not options.output.endswith((".png", ".svg", ".pdf")):
        raise ArgumentError(f"a picture named '{options.output}'", "end the name in .png, .svg or .pdf", "unknown-format")
    options.source, options.branch, options.until = located(options.source, options.branch, options.until)
    check_file(options.output, reads=[options.source])
    progress = Progress("plot", options.quiet)
    patterns = options.variables + ([options.against] if options.against else [])
    recording = record(options.source, patterns, until=options.until, every=options.every, start=options.start,
                       branch=options.branch, progress=lambda now, end: progress(f"{now:.2f} of {end:.2f} s"))
    progress.note_if(ways(options.source, options.branch))
    pictures.save(pictures.plot(recording, options.variables, against=options.against, title=options.title), options.output)
    numbers = recording.select(options.variables)
    rows = [{"column": recording.columns[n].name, "unit": recording.columns[n].unit, "min": float(values.min()),
             "max": float(values.max()), "mean": float(values.mean()), "last": float(values[-1])}
            for n in numbers for values in [recording.values[:, n]]]
    if not options.json:
        print(f"{options.output}: {len(rows)} columns, {len(recording.time)} samples")
    return {"file": options.output, "samples": len(recording.time), "columns": rows}
