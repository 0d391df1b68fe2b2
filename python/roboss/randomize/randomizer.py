"""Randomizer: draws the terms for each robot when their time has come, and puts into effect what was drawn."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, Iterable, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import ArgumentError, RobossError, SaveError, StateError
from ..names import index_of, instance, listed, whole
from ..padded import PaddedRobots
from ..robots import Robots
from .agents import Agents, Mask, Rows
from .effects import Draw, obey, orders_of
from .streams import ROWS, stream
from .terms import Columns, LatencyTerm, NoiseTerm, Term

Floats = NDArray[np.float64]
_NEVER = np.iinfo(np.int64).max


@dataclass(frozen=True, eq=False)
class RandomizerSave:
    """The state of a Randomizer, for `restore` and `pickle`: numbers of draws, not what was drawn.

    Attributes:
        seed: of the draws.
        terms: names.
        draws, waits: how often each agent drew each term and its intervals, (terms, agents).
        due: ticks of the next draws in intervals, (terms, agents).
        begun: agents that were reset at least once, (agents,).
        actions: the last ones, newest first, (steps, agents, ...); None: none yet.
    """

    seed: int
    terms: tuple[str, ...]
    draws: Rows
    waits: Rows
    due: Rows
    begun: Mask
    actions: Optional[Floats]


class Randomizer:
    """Domain randomisation of some robots. The draws of a robot are functions of the seed, its simulation's place in
    the Batch, its name, the term's name and how often that was drawn for it, and of nothing else: see `stream`.

    `reset` begins an episode of all robots or some, behind a reset of the simulation if there is one; `update` comes
    before each step. The constructor changes nothing.

    Args:
        robots: of a Simulation, or of a Batch, also padded; those of a Batch of different worlds have the same joints,
            or links, in the terms.
        terms: what `joint`, `link`, `kick`, `push`, `noise` and `latency` make. Names of terms differ.
        seed: of the draws.
        observation_columns: for terms of noise; None: there are none.

    Raises:
        UnknownNameError: no such parameter, joint or link.
        ArgumentError: terms of one name (code "name-taken"), a distribution for another number of columns
            ("wrong-count"), robots with different joints or links ("mixed-types").

    >>> from roboss import randomize
    >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
    >>> cars = sim.robots("car_*")
    >>> randomizer = randomize.Randomizer(cars, [
    ...     randomize.joint("damping", randomize.uniform(0, 0.05)),
    ...     randomize.joint("max_effort", randomize.log_uniform(0.5, 2), "scale", shared=True),
    ...     randomize.kick(randomize.uniform([-1, -1, 0, 0, 0, 0], [1, 1, 0, 0, 0, 0]), when=(1, 3)),
    ... ], seed=7)
    >>> randomizer.reset()
    >>> for _ in range(100):
    ...     randomizer.update()
    ...     sim.step(25)
    >>> damping = randomizer.drawn["joint_damping"]        # N m s/rad
    >>> damping.shape, bool(np.array_equal(damping, cars.parameters["damping"]))
    ((16, 4), True)
    >>> bool(np.isfinite(randomizer.drawn["kick"]).all())  # after 5 s
    True
    """

    def __init__(self, robots: Union[Robots, PaddedRobots], terms: Iterable[Term], *, seed: int = 0,
                 observation_columns: Optional[int] = None):
        self.robots = robots  #: that are randomised
        self.terms: tuple[Term, ...] = tuple(_checked(terms))  #: what is drawn, in the order in which it applies
        self._agents = Agents(robots)
        self._observation = observation_columns
        if observation_columns is not None:
            self._observation = whole("observation_columns", observation_columns, 1)
        self._columns = [self._columns_of(term) for term in self.terms]
        self._steps = [number for number, term in enumerate(self.terms) if isinstance(term, LatencyTerm)]
        self._most = int(sum(np.rint(self.terms[number].distribution.high.max()) for number in self._steps))  # steps
        self.reseed(seed)

    def __reduce__(self) -> tuple[Any, ...]:
        return _randomizer_of, (self.robots, self.terms, self._observation, self.save())

    def __repr__(self) -> str:
        return f"<roboss.randomize.Randomizer of {self._agents.count} robots: {', '.join(self._names)}>"

    @property
    def seed(self) -> int:
        """The seed of the draws."""
        return self._seed

    @property
    def begun(self) -> bool:
        """True if all robots were reset since the start or the last `reseed`."""
        return bool(self._begun.all())

    @property
    def drawn(self) -> dict[str, Floats]:
        """The last draws, by the name of the term: (N, columns), of a Batch (B, N, columns), of padded robots
        (B, most, columns). NaN: nothing yet. Of a number that is scaled it is the factor, of noise what is added."""
        return {term.name: self._agents.arrays(rows) for term, rows in zip(self.terms, self._draws)}

    def columns(self, term: str) -> tuple[str, ...]:
        """Names of the columns of what a term draws: joints, links, "force_x" ..."""
        return tuple(name for name, _ in self._columns[self._number(term)])

    def units(self, term: str) -> tuple[str, ...]:
        """Units of the columns of what a term draws; "1" of factors, "" of noise: that of the observation."""
        return tuple(unit for _, unit in self._columns[self._number(term)])

    def reseed(self, seed: int) -> None:
        """Forgets what was drawn, as if made anew with this seed. The robots keep it until their next `reset`."""
        self._seed = whole("seed", seed)
        shape = (len(self.terms), self._agents.count)
        self._numbers = np.full(shape, -1, dtype=np.int64)
        self._waits = np.full(shape, -1, dtype=np.int64)
        self._due = np.full(shape, _NEVER, dtype=np.int64)
        self._begun = np.zeros(self._agents.count, dtype=bool)
        self._draws = [np.full((self._agents.count, len(columns)), np.nan) for columns in self._columns]
        self._past: Optional[Floats] = None
        self._block = np.full(shape, -1, dtype=np.int64)  # of each agent in the following
        self._blocks = [np.empty((self._agents.count, ROWS, len(columns))) for columns in self._columns]

    def reset(self, agents: Optional[ArrayLike] = None) -> None:
        """Begins an episode of these robots: draws what is drawn then, and puts all numbers into effect, also those of
        the start. Call it after Simulation.reset or Batch.reset, which take them back, and after poses are set.

        Args:
            agents: a mask (N,), of a Batch (B, N) or of its simulations (B,); None: all.

        Raises:
            OrderError: a robot cannot have a number that was drawn. Nothing is changed then, nothing counts as drawn.
        """
        self._do(self._begin, self._agents.mask(agents), True)

    def update(self, agents: Optional[ArrayLike] = None) -> None:
        """Draws what is drawn at each step, and what is due by its interval. Call it before each step.

        Intervals end at the first update after their time. They follow the simulation's time, so draws do not depend on
        how long the steps are: a draw that no update saw is left out and counted.

        Args:
            agents: a mask as of `reset`, of those that take part; None: all.

        Raises:
            StateError: one of them was not reset (code "not-reset").
            OrderError: as `reset`.
        """
        chosen = self._agents.mask(agents)
        self._check_begun(chosen)
        self._do(self._draw_due, chosen, False)

    def noisy(self, observations: NDArray[Any]) -> NDArray[Any]:
        """The observations, (N, columns), (B, N, columns) or (agents, columns), with the noise of this step added.

        Raises ArgumentError (code "bad-shape") for other shapes.
        """
        given = np.asarray(observations)
        rows = self._agents.rows("observations", given)
        out = np.array(rows, dtype=np.result_type(rows.dtype, np.float32))
        for term, draws in zip(self.terms, self._draws):
            if isinstance(term, NoiseTerm):
                self._check_begun(np.ones(self._agents.count, dtype=bool))
                if out.ndim != 2 or out.shape[1] != self._observation:
                    raise ArgumentError(f"observations of shape {given.shape}",
                                        f"give {self._observation} columns", "bad-shape")
                out[:, slice(None) if term.places is None else list(term.places)] += draws.astype(out.dtype)
        return self._agents.shaped(out, given)

    def delayed(self, actions: ArrayLike) -> Floats:
        """Takes the actions of this step, (N, ...), (B, N, ...) or (agents, ...), and gives those that are carried out
        in it: of each robot what it was given its latency before. Before the first one arrives, that is 0.

        Raises ArgumentError (code "bad-shape") for other shapes.
        """
        given = np.asarray(actions, dtype=np.float64)
        rows = self._agents.rows("actions", given)
        if not self._steps:
            return given.copy()
        self._check_begun(np.ones(self._agents.count, dtype=bool))
        if self._past is None:
            self._past = np.zeros((self._most + 1, *rows.shape))
        if self._past.shape[1:] != rows.shape:
            raise ArgumentError(f"actions of shape {given.shape}",
                                f"give rows of shape {self._past.shape[2:]}, as before", "bad-shape")
        self._past[1:] = self._past[:-1].copy()
        self._past[0] = rows
        steps = np.sum([self._draws[number][:, 0] for number in self._steps], axis=0).astype(int)
        return self._agents.shaped(self._past[steps, np.arange(self._agents.count)], given)

    def save(self) -> RandomizerSave:
        """Its state, small: keep it beside Simulation.save, which has the numbers of the robots."""
        past = None if self._past is None else self._past.copy()
        return RandomizerSave(self._seed, self._names, self._numbers.copy(), self._waits.copy(), self._due.copy(),
                              self._begun.copy(), past)

    def restore(self, save: RandomizerSave) -> None:
        """Continues from a save of the same terms and robots. It leaves the robots alone: restore the simulation, too.

        Raises SaveError (code "other-randomizer") if it is of other terms, or of another number of robots.
        """
        instance("save", save, RandomizerSave, "give what `save` returned")
        if save.terms != self._names or save.draws.shape != self._numbers.shape:
            raise SaveError(f"a save of {save.draws.shape[1]} robots with the terms {', '.join(save.terms)}",
                            "give one of the same terms and robots", "other-randomizer")
        self.reseed(save.seed)
        self._numbers, self._waits, self._due = save.draws.copy(), save.waits.copy(), save.due.copy()
        self._begun = save.begun.copy()
        self._past = None if save.actions is None else save.actions.copy()
        for number in range(len(self.terms)):
            self._fill(number, self._numbers[number] >= 0)

    @property
    def _names(self) -> tuple[str, ...]:
        return tuple(term.name for term in self.terms)

    def _number(self, term: str) -> int:
        return index_of("term", term, list(self._names))

    def _columns_of(self, term: Term) -> Columns:
        found = [list(term.columns(member, self._observation)) for member in self._agents.some]
        if any(columns != found[0] for columns in found):
            raise ArgumentError(f"term '{term.name}': the robots of these worlds have different columns",
                                "name joints or links that all have, or make a Randomizer for each", "mixed-types")
        count, wanted = 1 if term.shared else len(found[0]), term.distribution.columns
        if wanted not in (None, count):
            raise ArgumentError(f"term '{term.name}': a distribution of {wanted} columns for {count}",
                                "give numbers, or one for each of " + ", ".join(name for name, _ in found[0][:12]),
                                "wrong-count")
        return found[0]

    def _check_begun(self, chosen: Mask) -> None:
        if not self._begun[chosen].all():
            raise StateError("robots that were not reset", "call reset() first", "not-reset")

    def _do(self, draw: Callable[[int, Mask, Rows], Mask], chosen: Mask, resets: bool) -> None:
        """Draws all terms, and puts them into effect; or leaves everything as it was."""
        before = (self._numbers.copy(), self._waits.copy(), self._due.copy(), self._begun.copy(),
                  [rows.copy() for rows in self._draws])
        try:
            ticks = self._agents.ticks()
            drawn = [draw(number, chosen, ticks) for number in range(len(self.terms))]
            self._begun |= chosen
            obey(orders_of(self._agents, [Draw(*one) for one in zip(self.terms, self._columns, self._draws, drawn)],
                           chosen if resets else None))
        except RobossError:
            self._numbers, self._waits, self._due, self._begun, self._draws = before
            raise
        if resets and self._past is not None:
            self._past[:, chosen] = 0

    def _begin(self, number: int, chosen: Mask, ticks: Rows) -> Mask:
        """Draws a term at the start of an episode. Returns for which agents."""
        term = self.terms[number]
        if isinstance(term.when, tuple):
            self._wait(number, chosen, ticks)
            chosen = chosen & ~np.bool_(term.acts)
        elif term.when == "start":
            chosen = chosen & (self._numbers[number] < 0)
        self._numbers[number, chosen] += 1
        self._fill(number, chosen)
        return chosen

    def _draw_due(self, number: int, chosen: Mask, ticks: Rows) -> Mask:
        """Draws a term that is due. Returns for which agents."""
        term = self.terms[number]
        due: Mask
        if isinstance(term.when, tuple):
            late = due = chosen & (self._due[number] <= ticks)
            while late.any():
                self._numbers[number, late] += 1
                self._wait(number, late, self._due[number])
                late = late & (self._due[number] <= ticks)
        else:
            due = chosen & (term.when == "step")
            self._numbers[number, due] += 1
        self._fill(number, due)
        return due

    def _wait(self, number: int, chosen: Mask, since: Rows) -> None:
        """The next draw is due an interval after these ticks."""
        term = self.terms[number]
        assert isinstance(term.when, tuple)
        least, most = term.when
        self._waits[number, chosen] += 1
        for agent in map(int, np.flatnonzero(chosen)):
            share = self._stream(f"{term.name}/when", agent, int(self._waits[number, agent])).random()
            self._due[number, agent] = since[agent] + max(1, round((least + (most - least) * share) / self._agents.dt))

    def _fill(self, number: int, chosen: Mask) -> None:
        """The draws of these agents, by the numbers of their draws."""
        term, blocks, (block, row) = self.terms[number], self._blocks[number], np.divmod(self._numbers[number], ROWS)
        for agent in map(int, np.flatnonzero(chosen & (block != self._block[number]))):
            blocks[agent] = term.draw(self._stream(term.name, agent, int(block[agent])), *blocks.shape[1:])
            self._block[number, agent] = block[agent]
        self._draws[number][chosen] = blocks[chosen, row[chosen]]

    def _stream(self, term: str, agent: int, block: int) -> np.random.Generator:
        return stream(self._seed, *self._agents.keys[agent], term, block)


def _checked(terms: Iterable[Term]) -> list[Term]:
    given = listed("terms", terms)
    names: set[str] = set()
    for term in given:
        if not isinstance(term, Term):
            raise ArgumentError(f"terms: {term!r}", "give what joint, link, kick, push, noise and latency make",
                                "bad-type")
        if term.name in names or "/" in term.name or not term.name:
            raise ArgumentError(f"a term called '{term.name}'", "give each a name of its own, without '/': name=...",
                                "name-taken")
        names.add(term.name)
    return given


def _randomizer_of(robots: Union[Robots, PaddedRobots], terms: tuple[Term, ...], observation_columns: Optional[int],
                   save: RandomizerSave) -> Randomizer:
    """The randomizer of its parts, for pickle."""
    randomizer = Randomizer(robots, terms, observation_columns=observation_columns)
    randomizer.restore(save)
    return randomizer
