"""Worlds: files and texts that are read and compiled."""
from __future__ import annotations

import os
import warnings
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any, Iterable, Optional, Sequence, Union

from . import _core
from .errors import ArgumentError, WorldError, WorldWarning
from .names import file_path, flag, listed, names_of, real, text, unknown
from .world_file import Edit, save_world

_EXAMPLES = Path(__file__).parent / "program" / "share" / "roboss" / "worlds"


class World:
    """A compiled world: immutable, shared by all simulations of it. `load` makes one.

    `pickle` keeps it whole, without its file. Its looks (colours and meshes, for views and cameras) are not in the
    pickle: they are read from the file again, where that is still there and says the same.
    """

    def __init__(self, model: _core.Model, file: str, diagnostics: tuple[_core.Diagnostic, ...],
                 frames: Sequence[Sequence[tuple[str, int, list[float]]]] = (), looks: Optional[_core.Looks] = None, *,
                 loaded: str = "", source: Optional[tuple[Any, ...]] = None, edits: tuple[Edit, ...] = ()):
        self._model = model
        self._frames = frames  # (name, link, pose on it) by robot
        self._known_looks = looks  # colours and meshes, for views; None: to be read from the source
        self._loaded = loaded or model.hash  # hash of the world as its file has it; robots may have come and gone since
        self._source = source  # what _core.load took; None: not known
        self._edits = edits  # which robots came and went since
        self._types = model.types
        self._facts: dict[int, TypeFacts] = {}
        self.file: str = file  #: path that it was loaded from, or "<text>"
        self.diagnostics: tuple[_core.Diagnostic, ...] = diagnostics  #: all findings; str() has file and line
        self.robots: tuple[str, ...] = tuple(model.robots)  #: names of all robots, by their number

    @property
    def name(self) -> str:
        """Name of the world in its file."""
        return self._model.name

    @property
    def dt(self) -> float:
        """Length of a tick, s."""
        return self._model.dt

    @property
    def gravity(self) -> tuple[float, float, float]:
        """Gravity, m/s^2, world axes."""
        return self._model.gravity

    @property
    def hash(self) -> str:
        """16 hexadecimal digits: equal for equal worlds, as `roboss check` prints it."""
        return self._model.hash

    @property
    def scenery(self) -> tuple[str, ...]:
        """Names of the static shapes, "model::link::collision"."""
        return tuple(self._model.scenery)

    def save(self, path: Union[str, os.PathLike]) -> None:
        """Writes the world as an SDFormat file that loads to the same world, to the last bit: with the same `hash`.

        It is the text or file that the world was loaded from (a WorldBuilder writes it, too), without the robots that
        were removed and with those that were spawned, where they start. The file is loaded before it is put in place.

        Raises:
            WorldError: the world is of another format than SDFormat, or what was removed or spawned is no model of its
                own in its file (code "no-text"); or the file would be another world (code "other-world"): options of
                `load`, such as `dt` or `ground`, are not written.
            ArgumentError: the path is a file that the world was loaded from (code "output-is-input"), or of another
                kind ("other-kind").
            OSError: the folder cannot be written.

        >>> import os, tempfile
        >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
        >>> sim.remove("car_1*")
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     sim.world.save(os.path.join(folder, "edited.sdf"))
        ...     roboss.load(os.path.join(folder, "edited.sdf")).hash == sim.world.hash
        True
        """
        names = list(self.robots)
        start = _core.robots([_core.Simulation(self._model, 1, 0)], list(range(len(names)))).pose(True) if names else []
        save_world(self, path, {name: pose.tolist() for name, pose in zip(names, start)})

    @property
    def _looks(self) -> _core.Looks:
        if self._known_looks is None:
            self._known_looks = _looks_of(self._source, self._loaded)
        return self._known_looks

    def __copy__(self) -> World:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> World:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return _world_of, (self._model, self.file, self.diagnostics, self._frames, self._loaded, self._source)

    def __repr__(self) -> str:
        return f"<roboss.World '{self.name}' from {self.file}: {len(self.robots)} robots, dt={self.dt} s>"

    def _find(self, wanted: Union[str, Iterable[str]], *, may_be_none: bool = False) -> list[int]:
        """Numbers of the robots that match a pattern or are named. `may_be_none`: it is no error if none matches."""
        names = self.robots
        if isinstance(wanted, str):
            ids = [number for number, name in enumerate(names) if fnmatchcase(name, wanted)]
            if not ids and not may_be_none:
                raise unknown("robot", wanted, names)
        else:
            known = {name: number for number, name in enumerate(names)}
            ids = []
            for name in names_of("robots", wanted):
                if name not in known:
                    raise unknown("robot", name, names)
                ids.append(known[name])
        return ids

    def _facts_of(self, robot: int) -> TypeFacts:
        """What the type of this robot consists of."""
        number = self._types[robot]
        if number not in self._facts:
            self._facts[number] = self._facts_of_set([robot])
        return self._facts[number]

    def _facts_of_set(self, robots: Sequence[int]) -> TypeFacts:
        """What these robots, at least one, have in common."""
        return TypeFacts(**_core.facts_of(self._model, list(robots)))


def _world_of(model: _core.Model, file: str, diagnostics: tuple[_core.Diagnostic, ...],
              frames: Sequence[Sequence[tuple[str, int, list[float]]]], loaded: str, source: Optional[tuple[Any, ...]]) -> World:
    """The world of its parts, for pickle."""
    return World(model, file, diagnostics, frames, loaded=loaded, source=source)


def _looks_of(source: Optional[tuple[Any, ...]], wanted: str) -> _core.Looks:
    """The looks of the world that the source says, if that still has this hash; else none."""
    if source is not None and (source[1] or os.path.isfile(source[0])):
        model, _, _, looks = _core.load(*source)
        if model is not None and model.hash == wanted:
            return looks
    return _core.Looks()


@dataclass(frozen=True)
class TypeFacts:
    """What robots have in common: those of one type everything, others what has one name."""

    types: list[str]  # names of the types that they are of
    free_base: Optional[bool]  # None: of some
    links: list[str]
    axes: list[str]
    limits: Optional[list[list[float]]]  # None: they differ
    units: list[str]  # of the position of each axis: "rad" or "m"
    coordinates: list[str]  # of each axis: "axis", "ball" or "loop"
    sensors: list[tuple[str, str, float, list[int]]]  # name, kind, rate, its number on each robot
    commands: list[tuple[str, tuple[tuple[str, str], ...], bool, str]]  # name, values, is a list, the first robot's name

    @property
    def name(self) -> str:
        """Of the type, or of all of them."""
        return ", ".join(self.types[:8]) + (" ..." if len(self.types) > 8 else "")


def load(source: Union[str, os.PathLike], *, search_paths: Iterable[Union[str, os.PathLike]] = (), profile: str = "",
         ground: bool = False, fixed_base: Iterable[str] = (), dt: Optional[float] = None, sleep: Optional[bool] = None,
         accuracy: str = "", precision: Optional[str] = None, strict: bool = False, on_ground: bool = False,
         keyframe: str = "") -> World:
    """Reads and compiles a world.

    Args:
        source: path of an SDFormat, URDF or MJCF (MuJoCo) file, or its text (anything that begins with "<").
        search_paths: folders for `model://`, `package://` and relative URIs, before those of the environment.
        profile: name of the `<physics>` to use; "": the world's default.
        ground: add a plane at z = 0, for a file with a robot alone, such as a URDF.
        fixed_base: names of models to weld to the world.
        dt: length of a tick in s; None: the world's.
        sleep: whether robots at rest sleep; None: the world's choice.
        accuracy: "fast", "standard" or "high"; "": the world's choice.
        precision: "double" or "float", in which lone robots are stepped; None: the world's choice.
        strict: refuse a world of which a model had to be left out.
        on_ground: stand the robots on the ground, box or mesh below them, with their lowest collision shape.
        keyframe: of an MJCF file: name or number of the `<key>` that the world starts from; "": as the bodies stand.

    Raises:
        WorldError: the world cannot be used; its text has all errors with file and line.

    Warnings and models that are left out are issued as WorldWarning, each with file and line; World.diagnostics has
    all findings.

    >>> roboss.load(roboss.example("pile.sdf")).dt
    0.002
    >>> world = roboss.load('''<robot name="ball"><link name="body">
    ...   <inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>
    ...   <collision><geometry><sphere radius="0.1"/></geometry></collision>
    ... </link></robot>''', ground=True, on_ground=True)
    >>> world.robots
    ('ball',)
    >>> float(roboss.Simulation(world).robots().pose[0, 2].round(6))
    0.1
    """
    if precision not in (None, "double", "float"):
        raise ArgumentError(f"a precision of {precision!r}", "give 'double', 'float' or None")
    source = file_path("source", source)
    is_text = source.lstrip().startswith("<")
    options = ([file_path("search_paths", path) for path in listed("search_paths", search_paths)],
               text("profile", profile), flag("ground", ground), names_of("fixed_base", listed("fixed_base", fixed_base)),
               None if dt is None else real("dt", dt), None if sleep is None else flag("sleep", sleep),
               text("accuracy", accuracy), None if precision is None else precision == "float",
               flag("on_ground", on_ground), text("keyframe", keyframe))
    model, findings, frames, looks = _core.load(source, is_text, *options)
    errors = [finding for finding in findings if finding.severity == "error"]
    if model is None or (flag("strict", strict) and errors):
        file = "the text" if is_text else f"'{source}'"
        listing = "\n".join(str(error) for error in errors)
        raise WorldError(f"the world of {file} cannot be used:\n{listing}", code=errors[0].code if errors else "",
                         diagnostics=tuple(findings))
    for finding in findings:
        if finding.severity != "note":
            warnings.warn(str(finding), WorldWarning, stacklevel=2)
    return World(model, "<text>" if is_text else source, tuple(findings), frames, looks,
                 source=(source if is_text else os.path.abspath(source), is_text, *options))


def example(name: str) -> str:
    """Path of a world that comes with the package: "city.sdf", "crossroads.sdf", "pile.sdf" ...

    >>> roboss.load(roboss.example("city.sdf")).robots[:2]
    ('car_0', 'car_1')
    """
    path = _EXAMPLES / text("name", name)
    if not path.is_file():
        raise unknown("example world", name, sorted(world.name for world in _EXAMPLES.glob("*.sdf")))
    return str(path)
