"""Names that do not exist, and rows that do not fit."""
from __future__ import annotations

import difflib
from typing import Iterable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import ArgumentError, UnknownNameError

_MOST = 12


def unknown(kind: str, name: object, known: Iterable[str], where: str = "") -> UnknownNameError:
    """The exception: there is no `kind` of this name; it lists those that exist."""
    known = list(known)
    shown = ", ".join(known[:_MOST]) + (f" and {len(known) - _MOST} more" if len(known) > _MOST else "")
    similar = difflib.get_close_matches(str(name), known, n=1)
    return UnknownNameError(f"there is no {kind} '{name}'{where}; there is {shown or 'none'}",
                            f"did you mean '{similar[0]}'?" if similar else "", "unknown-name")


def index_of(kind: str, name: str, known: list[str], where: str = "") -> int:
    """The place of a name in the list."""
    try:
        return known.index(name)
    except ValueError:
        raise unknown(kind, name, known, where) from None


def numbers(what: str, values: ArrayLike) -> NDArray[np.float64]:
    """The values as an array of doubles."""
    try:
        return np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise ArgumentError(f"{what}: no array of numbers ({error})", code="bad-shape") from None


def filled(what: str, values: ArrayLike, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """The values as doubles of this shape: a full array, or one whose missing first axes are the same for all."""
    array = numbers(what, values)
    if array.shape != shape:
        wanted = shape[len(shape) - array.ndim:]
        if array.ndim > len(shape) or any(have not in (1, want) for have, want in zip(array.shape, wanted)):
            raise ArgumentError(f"{what}: an array of shape {array.shape}; it takes {shape}, one row of {shape[-1]} "
                                "for all robots, or one number", code="bad-shape")
        array = np.broadcast_to(array, shape)
    return np.ascontiguousarray(array)
