"""Recordings as Rerun has them (.rrd): robots with their shapes in 3-D, images, scans, numbers as curves, texts.

Entities are `world/scenery/...`, `world/robots/ROBOT/LINK/...`, `world/contact_points/...`, `numbers/ROBOT/...` and
`texts/ROBOT/...`; the timeline is `sim_time`, a duration.
"""
from __future__ import annotations

import json
import os
from contextlib import contextmanager
from typing import Any, Iterator, Mapping, Optional, Sequence, Union

import numpy as np
import rerun as rr
import rerun.blueprint as rrb

from ..errors import RobossError
from ..robots import Floats
from ..run import Run
from .messages import MessageVariable
from .recording import POSE, Column
from .rerun_messages import drawn_message, is_image, is_text
from .rerun_robots import DrawnRobots

_HELD_ROWS, _HELD = 1024, 2**20  # samples and numbers that are in memory before they are written
_CURVES = 16                     # at most, of a variable; one with more numbers is drawn as bars
_IMAGES = 6                      # that the default view shows
_AXES_M = 0.2                    # length of the axes of a pose whose robot is not known


class RerunWriter:
    """Writes samples to a file as they come; only the last few megabytes are in memory. A context.

    Args:
        run: whose world is drawn, in each sample as it is then. None: of poses among the columns only axes are drawn.
        others: as of McapWriter.
    """

    def __init__(self, path: Union[str, os.PathLike], columns: Sequence[Column], facts: Mapping[str, Any],
                 messages: Sequence[MessageVariable] = (), run: Optional[Run] = None):
        numbers: dict[str, list[int]] = {}
        for number, column in enumerate(columns):
            numbers.setdefault(column.variable, []).append(number)
        self._series = [_Series(columns, *item, run is not None) for item in numbers.items()]
        self._messages = messages
        with open(path, "wb"):  # its error says why it cannot be written
            pass
        self._stream = rr.RecordingStream("roboss")
        with _as_os_error():
            self._stream.save(os.fspath(path))
        self._stream.set_log_time_enabled(False)
        self._stream.set_log_tick_enabled(False)
        self._stream.send_recording_name(str(facts.get("world") or "roboss"))
        plain: dict[str, Any] = {name: json.dumps(value) if isinstance(value, dict) else value for name, value in facts.items()}
        self._stream.send_property("roboss", rr.AnyValues(**plain))
        self._stream.log("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
        for series in self._series:
            series.describe(self._stream)
        self._robots = None if run is None else DrawnRobots(self._stream, run, {_sensor(message.name) for message in messages})
        self._rows: list[tuple[np.timedelta64, Floats]] = []
        self._has_views = False

    def add(self, time: float, values: Floats, messages: Sequence[Any] = ()) -> None:
        """Writes a sample: the values of the columns, and those of the messages."""
        stamp = np.timedelta64(round(time * 1e9), "ns")
        with _as_os_error():
            self._stream.set_time("sim_time", duration=stamp)
            if self._robots is not None:
                self._robots.add(stamp)
            self._add_views()
            self._rows.append((stamp, values))
            for series in self._series:
                series.add_bars(self._stream, values)
            for variable, value in zip(self._messages, messages):
                for part in drawn_message(variable, value) if value is not None else []:  # None: its robot is not there
                    self._stream.log(self._path(variable), part, strict=True)
            if len(self._rows) >= _HELD_ROWS or len(self._rows) * len(values) >= _HELD:
                self._flush()

    def _flush(self) -> None:
        """Writes the samples that are in memory."""
        if self._robots is not None:
            self._robots.flush()
        if self._rows:
            times = rr.TimeColumn("sim_time", duration=[stamp for stamp, _ in self._rows])
            rows, self._rows = np.array([values for _, values in self._rows]), []
            for series in self._series:
                series.write(self._stream, times, rows)
        self._stream.flush()

    def _path(self, variable: MessageVariable) -> list[object]:
        """The entity path of a variable that holds messages."""
        if is_text(variable):
            return ["texts", *variable.name.split(".")]
        if variable.layout.name == "roboss.Contacts":
            return ["world", "contact_points", *variable.name.split(".")[:-1]]
        place = self._robots.path_of(_sensor(variable.name)) if self._robots is not None else None
        return [*(place or ["unplaced", _sensor(variable.name)]), variable.name.rsplit(".", 1)[-1]]

    def _add_views(self) -> None:
        """Writes the view of the file, once, as the first robots are there."""
        if self._has_views:
            return
        self._has_views = True
        views: list[Any] = [rrb.Spatial2DView(origin=rr.new_entity_path(self._path(message)), name=message.name)
                            for message in self._messages if is_image(message)][:_IMAGES]
        views = [rrb.Grid(*views)] if len(views) > 1 else views
        if any(series.kind == "curves" for series in self._series):
            views.append(rrb.TimeSeriesView(origin="/numbers", name="numbers"))
        if any(series.kind == "bars" for series in self._series):
            views.append(rrb.BarChartView(origin="/numbers", name="bars"))
        if any(message.layout.name == "roboss.RadioMessages" for message in self._messages):
            views.append(rrb.TextLogView(origin="/texts", name="texts"))
        eye = self._robots.eye() if self._robots is not None else None
        world = rrb.Spatial3DView(origin="/world", name="world", eye_controls=eye)
        shown = rrb.Horizontal(world, rrb.Vertical(*views), column_shares=[3, 2]) if views else world
        blueprint = rrb.Blueprint(shown, rrb.TimePanel(timeline="sim_time"), auto_views=False)
        self._stream.send_blueprint(blueprint)  # also if the viewer still has that of another recording

    def __enter__(self) -> RerunWriter:
        return self

    def __exit__(self, *_: Any) -> None:
        """Ends the file: also after an error it has all samples so far."""
        with _as_os_error():
            self._flush()
            self._stream.disconnect()


class _Series:
    """A variable's numbers over time.

    Attributes:
        kind: how they are shown: "curves", "bars" (of many numbers, as those of a scan), "axes" (a pose), or "" (the pose of
            a robot or a link that is drawn).
    """

    def __init__(self, all_columns: Sequence[Column], variable: str, numbers: list[int], has_run: bool):
        columns = [all_columns[number] for number in numbers]
        self._numbers, self._columns = numbers, columns
        is_pose = variable.endswith(".pose") and [c.name[len(variable) + 1:] for c in columns] == [part for part, _ in POSE]
        self.kind = ("" if has_run else "axes") if is_pose else "bars" if len(numbers) > _CURVES else "curves"
        parts = ["world", "poses", variable.rsplit(".", 1)[0]] if is_pose else ["numbers", *variable.split(".")]
        self._path: str = rr.new_entity_path(parts)

    def describe(self, stream: rr.RecordingStream) -> None:
        """Writes the facts that hold at all times, as the names of curves."""
        if self.kind == "curves":
            names = [c.name + (f" ({c.unit})" if c.unit else "") for c in self._columns]
            stream.log(self._path, rr.SeriesLines(names=names), static=True)
        elif self.kind == "axes":
            stream.log(self._path, rr.TransformAxes3D(_AXES_M), static=True)

    def add_bars(self, stream: rr.RecordingStream, values: Floats) -> None:
        """Writes a sample, if they are bars. One that is not finite is NaN: it would be higher than the picture."""
        if self.kind == "bars":
            some = values[self._numbers]
            stream.log(self._path, rr.BarChart(np.where(np.isfinite(some), some, np.nan)), strict=True)

    def write(self, stream: rr.RecordingStream, times: rr.TimeColumn, rows: Floats) -> None:
        """Writes several samples, if they are curves or axes."""
        if self.kind not in ("curves", "axes"):
            return
        some = rows[:, self._numbers]
        columns = rr.Scalars.columns(scalars=some.ravel()).partition([len(self._numbers)] * len(rows)) if self.kind == "curves" \
            else rr.Transform3D.columns(translation=some[:, :3], quaternion=some[:, 3:])
        stream.send_columns(self._path, indexes=[times], columns=columns, strict=True)


def _sensor(message: str) -> str:
    """The sensor, "car_3.laser", of a variable, "car_3.laser.scan"."""
    return message.rsplit(".", 1)[0]


@contextmanager
def _as_os_error() -> Iterator[None]:
    """Rerun's errors of files as those of Python."""
    try:
        yield
    except RuntimeError as error:
        if isinstance(error, RobossError):
            raise
        raise OSError(str(error)) from error
