"""Effects: what was drawn, as calls of the robots. Of several calls either all have an effect, or none has."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Callable, Optional, Sequence

import numpy as np

from ..batch import Batch
from ..errors import RobossError
from ..robots import Robots
from .agents import Agents, Mask, Rows
from .distributions import Floats
from .terms import Columns, KickTerm, NumberTerm, PushTerm, Term, numbers_of, parts_of


@dataclass(frozen=True, eq=False)
class Draw:
    """A term, what is drawn last of it, (agents, columns), and for which agents that is new."""

    term: Term
    columns: Columns
    rows: Floats
    new: Mask


Order = tuple[Robots, Callable[[], None]]  #: robots, and what is done to them


def orders_of(agents: Agents, draws: Sequence[Draw], restarted: Optional[Mask]) -> list[Order]:
    """One order for each set of robots that take arrays together.

    Args:
        restarted: agents whose numbers of the file, and older draws, may be back; None: none.
    """
    orders: list[Order] = []
    for kind in ("joint", "link", "surroundings"):
        some = [(draw, draw.term) for draw in draws if isinstance(draw.term, NumberTerm) and draw.term.kind == kind]
        if some:
            touched = np.any([draw.new for draw, _ in some], axis=0) if restarted is None else restarted
            orders += [_numbers_order(kind, some, *part) for part in agents.parts(touched)]
    for draw in draws:
        if isinstance(draw.term, (KickTerm, PushTerm)):
            orders += [_push_order(draw.term, draw.rows, agents.dt, *part) for part in agents.parts(draw.new)]
    return orders


def obey(orders: list[Order]) -> None:
    """Gives the orders. A single one of a Simulation is refused as a whole; others are taken back from saved states."""
    several = len(orders) > 1 or any(isinstance(robots.simulation, Batch) for robots, _ in orders)
    saves = Agents.saves([robots for robots, _ in orders]) if several else []
    try:
        for _, order in orders:
            order()
    except RobossError:
        for simulation, save in saves:
            simulation.restore(save)
        raise


def _numbers_order(kind: str, draws: list[tuple[Draw, NumberTerm]], robots: Robots, agents: Rows) -> Order:
    """Sets all numbers of a kind that terms are about: the file's, with the terms applied one after the other.

    Others stay: of joints and surroundings what they have is set again, of links NaN leaves it, as an inertia that
    follows its mass. A link that has no such number in the file gets none.
    """
    own, parts = numbers_of(robots, kind), parts_of(robots, kind)
    about: dict[str, list[str]] = {}  # the parts, by the parameter
    for draw, term in draws:
        about.setdefault(term.parameter, []).extend(name for name, _ in draw.columns)
    touched = [part for part in parts if any(part in some for some in about.values())]
    places = [parts.index(part) for part in touched]
    values: dict[str, Floats] = {}
    for parameter, some in about.items():
        of_file = own.of_file(parameter)[..., places].reshape(len(agents), -1)
        others = own[parameter][..., places].reshape(of_file.shape) if kind != "link" else np.nan
        values[parameter] = np.where([part in some for part in touched], of_file, others)
    for draw, term in draws:
        array, mine = values[term.parameter], [touched.index(part) for part, _ in draw.columns]
        array[:, mine] = np.where(np.isnan(array[:, mine]), np.nan, term.applied(array[:, mine], draw.rows[agents]))
    shaped = {parameter: array.reshape(*robots._rows, len(touched)) for parameter, array in values.items()}
    return robots, lambda: own.set(touched, **shaped)


def _push_order(term: Term, rows: Floats, dt: float, robots: Robots, agents: Rows) -> Order:
    shaped = rows[agents].reshape(*robots._rows, 6)
    if isinstance(term, PushTerm):
        ticks, link = max(1, round(term.duration / dt)), term.link
        return robots, lambda: robots.apply_wrench(shaped, link, ticks=ticks)
    return robots, lambda: setattr(robots, "twist", robots.twist + shaped)
