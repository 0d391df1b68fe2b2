"""Distributions of drawn numbers: uniform, log-uniform, normal, and a choice among values."""
from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import ArgumentError
from ..names import numbers

Floats = NDArray[np.float64]


class Distribution(ABC):
    """A distribution of a number, or of each column of a row. `uniform`, `log_uniform`, `normal` and `choice` make one.

    Attributes:
        low, high: bounds of what it gives, () or (columns,); infinite: none.
    """

    low: Floats
    high: Floats

    @property
    def columns(self) -> Optional[int]:
        """The number of columns that it is for; None: any number, all alike."""
        return None if self.low.ndim == 0 else len(self.low)

    @abstractmethod
    def sample(self, stream: np.random.Generator, rows: int, columns: int) -> Floats:
        """Draws some rows, one after the other, (rows, columns)."""


@dataclass(frozen=True, eq=False)
class _Uniform(Distribution):
    low: Floats
    high: Floats

    def sample(self, stream: np.random.Generator, rows: int, columns: int) -> Floats:
        return np.minimum(self.low + (self.high - self.low) * stream.random((rows, columns)), self.high)


@dataclass(frozen=True, eq=False)
class _LogUniform(Distribution):
    low: Floats
    high: Floats

    def sample(self, stream: np.random.Generator, rows: int, columns: int) -> Floats:
        exponent = np.log(self.high / self.low) * stream.random((rows, columns))
        return np.clip(self.low * np.exp(exponent), self.low, self.high)


@dataclass(frozen=True, eq=False)
class _Normal(Distribution):
    mean: Floats
    std: Floats
    low: Floats
    high: Floats

    def sample(self, stream: np.random.Generator, rows: int, columns: int) -> Floats:
        return np.clip(self.mean + self.std * stream.standard_normal((rows, columns)), self.low, self.high)


@dataclass(frozen=True, eq=False)
class _Choice(Distribution):
    values: Floats
    bounds: Floats  # that divide the numbers from 0 to 1 among the values
    low: Floats
    high: Floats

    def sample(self, stream: np.random.Generator, rows: int, columns: int) -> Floats:
        return self.values[np.searchsorted(self.bounds, stream.random((rows, columns)), side="right")]


def uniform(low: ArrayLike, high: ArrayLike) -> Distribution:
    """Evenly from `low` to `high`: numbers, or (columns,) for each column its own.

    Raises ArgumentError (code "bad-distribution") for bounds that are not finite, and for a `low` above `high`.
    """
    return _Uniform(*_between("uniform", low, high))


def log_uniform(low: ArrayLike, high: ArrayLike) -> Distribution:
    """From `low` to `high`, evenly by factors: as often from 0.1 to 1 as from 1 to 10. Both are above 0.

    Raises ArgumentError (code "bad-distribution") as `uniform`, and for a `low` that is not above 0.
    """
    least, most = _between("log_uniform", low, high)
    if not (least > 0).all():
        raise _refused(f"log_uniform from {least.tolist()}", "give bounds above 0")
    return _LogUniform(least, most)


def normal(mean: ArrayLike, std: ArrayLike, low: ArrayLike = -np.inf, high: ArrayLike = np.inf) -> Distribution:
    """The normal distribution of this mean and standard deviation. What falls below `low` becomes `low`, what falls
    above `high` becomes `high`. Numbers, or (columns,) for each column its own.

    Raises ArgumentError (code "bad-distribution") for a deviation below 0, numbers that are not finite, and a `low`
    above `high`.
    """
    middle, width, least, most = _rows("normal", mean, std, low, high)
    if not (np.isfinite(middle).all() and np.isfinite(width).all() and (width >= 0).all()):
        raise _refused(f"normal with mean {middle.tolist()} and std {width.tolist()}",
                       "give finite numbers, and a std of 0 or more")
    if not (least <= most).all():
        raise _refused(f"normal from {least.tolist()} to {most.tolist()}", "give a `low` that is not above `high`")
    return _Normal(middle, width, least, most)


def choice(values: ArrayLike, weights: Optional[ArrayLike] = None) -> Distribution:
    """One of the values, (values,), each as often as the others, or in the proportion of these weights, (values,).

    Raises ArgumentError (code "bad-distribution") for no values, values that are not finite, weights that are negative,
    all zero or of another number.
    """
    given = numbers("choice", values)
    if given.ndim != 1 or not given.size or not np.isfinite(given).all():
        raise _refused(f"choice among {given.tolist()}", "give a list of finite numbers")
    share = np.ones(len(given)) if weights is None else numbers("weights", weights)
    if share.shape != given.shape or not (np.isfinite(share).all() and (share >= 0).all() and share.sum() > 0):
        raise _refused(f"choice among {len(given)} values with weights {share.tolist()}",
                       "give a weight of 0 or more for each value, and not zeros only")
    possible = given[share > 0]
    bounds = np.cumsum(share[share > 0] / share.sum())[:-1]
    return _Choice(possible, bounds, np.asarray(possible.min()), np.asarray(possible.max()))


def _between(what: str, low: ArrayLike, high: ArrayLike) -> tuple[Floats, Floats]:
    least, most = _rows(what, low, high)
    if not (np.isfinite(least).all() and np.isfinite(most).all() and (least <= most).all()):
        raise _refused(f"{what} from {least.tolist()} to {most.tolist()}",
                       "give finite bounds, with a `low` that is not above `high`")
    return least, most


def _rows(what: str, *values: ArrayLike) -> list[Floats]:
    """All of one shape, () or (columns,)."""
    arrays = [numbers(what, value) for value in values]
    try:
        rows = [np.array(row) for row in np.broadcast_arrays(*arrays)]
    except ValueError:
        rows = []
    if not rows or rows[0].ndim > 1 or not rows[0].size:
        raise _refused(f"{what} with arrays of shapes {', '.join(str(array.shape) for array in arrays)}",
                       "give numbers, or rows with one number for each column")
    return rows


def _refused(fault: str, remedy: str) -> ArgumentError:
    return ArgumentError(fault, remedy, "bad-distribution")
