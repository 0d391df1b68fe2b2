"""Checks of arguments: names that do not exist, rows that do not fit, values of another type or range."""
from __future__ import annotations

import difflib
import math
import operator
import os
from typing import Any, Iterable, Optional, TypeVar, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import ArgumentError, UnknownNameError

_MOST = 12
_T = TypeVar("_T")


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


def numbers(what: str, values: Optional[ArrayLike]) -> NDArray[np.float64]:
    """The values as an array of doubles."""
    try:
        return np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise ArgumentError(f"{what}: no array of numbers ({error})", code="bad-shape") from None


def whole(what: str, value: Any, least: int = 0, most: int = 2**63 - 1) -> int:
    """The value as an int of Python; numpy's integers will do. Raises ArgumentError for another type or range."""
    try:
        if isinstance(value, bool):
            raise TypeError
        number = operator.index(value)
    except TypeError:
        raise ArgumentError(f"{what}: {value!r} is no whole number", "give an int", "bad-type") from None
    if not least <= number <= most:
        limits = f"{least} or more" if most == 2**63 - 1 and number < least else f"{least} to {most}"
        raise ArgumentError(f"{what}: {number}", f"give {limits}", "bad-value")
    return number


def real(what: str, value: Any, least: float = -math.inf) -> float:
    """The value as a float. Raises ArgumentError for another type, for NaN, and below `least`."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise ArgumentError(f"{what}: {value!r} is no number", "give a float", "bad-type") from None
    if not number >= least:
        raise ArgumentError(f"{what}: {number}", f"give {least:g} or more" if least > -math.inf else "give a number", "bad-value")
    return number


def instance(what: str, value: object, kind: type[_T], remedy: str) -> _T:
    """The value. Raises ArgumentError if it is not of this type."""
    if not isinstance(value, kind):
        raise ArgumentError(f"{what}: a value of type '{type(value).__name__}'", remedy, "bad-type")
    return value


def text(what: str, value: object) -> str:
    """The value, a text. Raises ArgumentError for another type."""
    return instance(what, value, str, "give a text (str)")


def flag(what: str, value: object) -> bool:
    """The value as a bool; numpy's will do. Raises ArgumentError for another type."""
    if not isinstance(value, (bool, np.bool_)):
        raise ArgumentError(f"{what}: {value!r} is neither True nor False", "give a bool", "bad-type")
    return bool(value)


def file_path(what: str, value: object) -> str:
    """The path of a file, or its text, as a str. Raises ArgumentError for another type."""
    return text(what, os.fspath(value) if isinstance(value, os.PathLike) else value)


def listed(what: str, values: Iterable[_T]) -> list[_T]:
    """The values as a list. Raises ArgumentError for a lone text, and for what cannot be gone through."""
    if isinstance(values, (str, bytes)) or not hasattr(values, "__iter__"):
        raise ArgumentError(f"{what}: {values!r} is no list", "give a list or tuple", "bad-type")
    return list(values)


def names_of(what: str, values: Union[str, Iterable[str]]) -> list[str]:
    """A text as a list of itself, or a list of texts. Raises ArgumentError for other types."""
    return [values] if isinstance(values, str) else [text(what, name) for name in listed(what, values)]


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
