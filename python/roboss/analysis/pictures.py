"""Pictures of recordings and reports, by matplotlib. Those of a report are SVG in the colours of its page."""
from __future__ import annotations

import io
import os
from typing import Optional, Sequence, Union

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ..outputs import check_output
from ..robots import Floats
from .recording import Recording

_INK = "#010203"  # becomes the colour of the page's text
COLORS = ("#2a7fde", "#e06c1f", "#2f9e58", "#b04fc4", "#c9a100", "#14a3a8", "#d1406b", "#7a6a58")
_STYLE = {"svg.fonttype": "none", "svg.hashsalt": "roboss", "font.size": 9, "axes.spines.top": False,
          "axes.spines.right": False, "axes.prop_cycle": matplotlib.cycler(color=COLORS), "lines.linewidth": 1.2,
          "font.family": "sans-serif", "legend.frameon": False, "axes.grid": True, "grid.alpha": 0.25, "grid.linewidth": 0.6,
          "figure.constrained_layout.use": True, "axes.axisbelow": True}
_ON_PAGE = {"text.color": _INK, "axes.labelcolor": _INK, "axes.edgecolor": _INK, "xtick.color": _INK, "ytick.color": _INK,
            "grid.color": _INK}


def plot(recording: Recording, patterns: Union[str, Sequence[str]], *, against: Optional[str] = None,
         title: str = "") -> Figure:
    """Variables over time, one diagram for each unit; or over another column.

    Args:
        patterns: of variables.
        against: name of a column for the horizontal axis, as "car_3.x".
    """
    numbers = recording.select(patterns)
    units = list(dict.fromkeys(recording.columns[number].unit for number in numbers))
    with matplotlib.rc_context(_STYLE):
        figure = Figure(figsize=(8, 1.2 + 2.2 * len(units)))
        for row, unit in enumerate(units):
            axes = figure.add_subplot(len(units), 1, row + 1)
            some = [number for number in numbers if recording.columns[number].unit == unit]
            horizontal = recording.time if against is None else recording[against]
            for number in some:
                axes.plot(horizontal, recording.values[:, number], label=recording.columns[number].name)
            one = len(some) == 1
            axes.set_ylabel((recording.columns[some[0]].name + " " if one else "") + (f"[{unit}]" if unit else ""))
            if not one:
                axes.legend(loc="upper left", bbox_to_anchor=(1, 1), fontsize=7, ncols=1 + len(some) // 25)
            if against is not None and unit == "m":
                axes.set_aspect("equal", adjustable="datalim")
            if row == len(units) - 1:
                axes.set_xlabel("time [s]" if against is None else against)
        if title:
            figure.suptitle(title)
    return figure


def save(figure: Figure, path: Union[str, os.PathLike]) -> None:
    """Writes a picture; the name says the format: .png, .svg, .pdf."""
    check_output(path)
    with matplotlib.rc_context(_STYLE):
        FigureCanvasAgg(figure)
        figure.savefig(path, dpi=150, **({"metadata": {"Date": None}} if str(path).endswith(".svg") else {}))


def on_page(draw, width: float = 7.0, height: float = 3.0, columns: int = 1) -> str:
    """The SVG of a picture for a report: calls draw(axes, ...) with its `columns` axes."""
    with matplotlib.rc_context({**_STYLE, **_ON_PAGE}):
        figure = Figure(figsize=(width, height))
        figure.patch.set_alpha(0)
        axes = [figure.add_subplot(1, columns, number + 1) for number in range(columns)]
        for one in axes:
            one.patch.set_alpha(0)
        draw(*axes)
        text = io.StringIO()
        figure.savefig(text, format="svg", metadata={"Date": None}, transparent=True)
    svg = text.getvalue()
    return svg[svg.index("<svg"):].replace(_INK, "currentColor")


def scatter(axes: Axes, xy: Floats, radius: float, names: tuple[str, str], number: int = 0, label: str = "") -> None:
    """Attained positions about the commanded one at the origin, with the circle of repeatability about their mean."""
    color = COLORS[number % len(COLORS)]
    axes.plot(*xy.T, ".", color=color, markersize=4, label=label)
    turn = np.linspace(0, 2 * np.pi, 100)
    middle = xy.mean(axis=0)
    axes.plot(middle[0] + radius * np.cos(turn), middle[1] + radius * np.sin(turn), color=color, linewidth=0.8)
    axes.set_xlabel(names[0])
    axes.set_ylabel(names[1])
    axes.set_aspect("equal", adjustable="datalim")
