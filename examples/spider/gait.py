"""The gait of examples/spider/gait.cpp for Python, through ctypes: one truth for search and control program.

A gait is a row of numbers, in the order of `Gaits.names`. Build the library first:
`tools/build.sh release roboss_spider_gait`.
"""
import ctypes
import os
import tomllib
from pathlib import Path

import numpy as np

LIBRARY = Path(__file__).parents[2] / "build/release/lib/roboss_spider_gait.so"
JOINTS, LEGS = 18, 6


class GaitError(Exception):
    """A gait cannot be used; the text has the file and a remedy."""


class Gaits:
    """Functions of gaits; `names` and `default` describe the numbers of one."""

    def __init__(self, library=None):
        path = Path(library or os.environ.get("ROBOSS_SPIDER_LIBRARY", LIBRARY))
        if not path.exists():
            raise GaitError(f"{path}: there is no such library\n  remedy: tools/build.sh release roboss_spider_gait")
        self._path, self._library = path, ctypes.CDLL(str(path))
        self._library.roboss_spider_name.restype = ctypes.c_char_p
        self.names, index = [], ctypes.c_size_t(0)
        while (name := self._library.roboss_spider_name(index)) is not None:
            self.names.append(name.decode())
            index.value += 1
        self.default = np.empty(len(self.names))
        self._library.roboss_spider_default(_address(self.default))

    def __reduce__(self):
        return Gaits, (self._path,)

    def __deepcopy__(self, memo):
        return self  # it does not change

    def targets(self, gaits, time, turns):
        """Joint targets (N, 18) in rad of gaits (N, numbers), `time` s after the first step; turns (N,), rad a stride."""
        gaits, turns = np.ascontiguousarray(gaits, float), np.ascontiguousarray(turns, float)
        out = np.empty((len(gaits), JOINTS))
        self._library.roboss_spider_targets(ctypes.c_size_t(len(gaits)), _address(gaits), ctypes.c_double(time),
                                            _address(turns), _address(out))
        return out

    def foot(self, leg, angles):
        """Where the foot of a leg is in the trunk's frame, m, at the angles of its three joints."""
        angles, out = np.ascontiguousarray(angles, float), np.empty(3)
        self._library.roboss_spider_foot(ctypes.c_size_t(leg), _address(angles), _address(out))
        return out

    def load(self, file):
        """The gait of a file; what it leaves out has its default. Raises GaitError where it is no gait."""
        try:
            with open(file, "rb") as stream:
                values = tomllib.load(stream)
        except OSError as error:
            raise GaitError(f"{file}: {error.strerror}\n  remedy: give a file such as examples/spider/gaits/walk.toml") from None
        except ValueError as error:  # no TOML, or no UTF-8
            raise GaitError(f"{file}: {error}\n  remedy: write lines such as `stride = 0.1`") from None
        if not values:
            raise GaitError(f"{file}: names no parameter of a gait\n  remedy: write lines such as `stride = 0.1`")
        gait = self.default.copy()
        for name, value in values.items():
            numbers = value if name == "phases" else [value]
            parts = [f"phase_{leg}" for leg in range(LEGS)] if name == "phases" else [name]
            if parts[0] not in self.names:
                raise GaitError(f"{file}: there is no parameter '{name}'\n  remedy: there are "
                                f"phases, {', '.join(part for part in self.names if not part.startswith('phase_'))}")
            if not isinstance(numbers, list) or len(numbers) != len(parts) or \
                    not all(type(number) in (int, float) and np.isfinite(number) for number in numbers):
                raise GaitError(f"{file}: '{name}' does not take {value!r}\n  remedy: give "
                                + ("six numbers in brackets" if name == "phases" else "one number"))
            for part, number in zip(parts, numbers):
                gait[self.names.index(part)] = number
        return gait

    def text(self, gait, comment=""):
        """A gait as the text of a file."""
        values = dict(zip(self.names, gait))
        phases = ", ".join(f"{values[f'phase_{leg}']:g}" for leg in range(LEGS))
        lines = [f"# {line}" for line in comment.splitlines()]
        lines += [f"{name} = {value:.5g}" for name, value in values.items() if not name.startswith("phase_")]
        return "\n".join([*lines, f"phases = [{phases}]"]) + "\n"


def _address(array):
    return array.ctypes.data_as(ctypes.c_void_p)
