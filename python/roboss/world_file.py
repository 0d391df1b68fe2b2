"""Worlds as files: the SDFormat that a World was loaded from, with the robots that came and went since."""
from __future__ import annotations

import os
import tempfile
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Sequence, Union
from xml.dom import expatbuilder
from xml.dom.minidom import Document, Element
from xml.parsers.expat import ExpatError

from . import _core
from .errors import WorldError
from .names import file_path
from .outputs import check_output

if TYPE_CHECKING:
    from .world import World

_Parsed = Any  # a minidom document; with prefixes as they are written, for no loader of SDFormat declares them


class Edit(NamedTuple):
    """What Simulation.spawn or Simulation.remove did to a world.

    Attributes:
        added: the World whose models came; None: robots went.
        names: that its only model got, one for each copy, [""]: its own; or of those that went.
        families: of the robots that came, by name: the place of their model among those of the world.
        poses: of the origin of `added` for each copy, x y z and quaternion x y z w.
    """

    added: Union[World, None]
    names: tuple[str, ...]
    families: dict[str, int] = {}
    poses: Sequence[list[float]] = ()


def save_world(world: World, path: Union[str, os.PathLike], start: dict[str, list[float]]) -> None:
    """See World.save. `start`: poses of the robots at the start, by name."""
    path = file_path("path", path)
    worlds = [world, *(edit.added for edit in world._edits if edit.added is not None)]
    check_output(path, "world", [one._source[0] for one in worlds if one._source is not None and not one._source[1]])
    if not world._edits and world._source is not None and world._source[1]:
        content = world._source[0]  # the text as it is
    else:
        content = _edited(world, Path(path), start)
    _publish(world, Path(path), content)


def _edited(world: World, path: Path, start: dict[str, list[float]]) -> str:
    document = _document_of(world, path.parent)
    if not _world_of(document):
        raise _no_text(world, "its file has models and no <world>", "build a world of them: WorldBuilder.add")
    places = _Places(document)
    for edit in world._edits:
        if edit.added is None:
            for name in edit.names:
                if not places.remove(name):
                    raise _no_text(world, f"'{name}', which was removed, is no model of its own there", "remove whole models")
            continue
        for name, pose in zip(edit.names, edit.poses):
            for model in _added(document, edit.added, path.parent):
                if name:
                    _rename(document, model, name)
                own = _name_of(model)
                if own in start:
                    _place(document, model, start[own])
                elif pose != [0, 0, 0, 0, 0, 0, 1]:
                    places.move(model, pose)
                places.add(model, next((edit.families[robot] for robot in edit.families if robot.split("::")[0] == own), None))
    return str(document.documentElement.toxml()) + "\n"


class _Places:
    """The models of a document, each at its place: robots that come and go change the place of no other, for it counts
    in the hash of the world. Where one is missing stands an empty model."""

    def __init__(self, document: _Parsed):
        self._document, self._world, self._models = document, _world_of(document)[0], _models(document)
        self._empty: list[Element] = []

    def remove(self, name: str) -> bool:
        """Takes the model of this name out; False: there is none."""
        for number, model in enumerate(self._models):
            if _name_of(model) == name:
                self._models[number] = self._new_empty()
                self._world.replaceChild(self._models[number], model)
                return True
        return False

    def add(self, model: Element, place: Optional[int]) -> None:
        """Adds a model at its place, or, where that does not count, at the end."""
        while place is not None and len(self._models) < place:
            self.add(self._new_empty(), None)
        if place is None and _name_of(model) in map(_name_of, self._models):  # scenery; its name counts nowhere
            _rename(self._document, model, self._new_name(_name_of(model)))
        if place is None or place == len(self._models):
            self._world.appendChild(model)
            self._models.append(model)
        elif self._models[place] in self._empty:
            self._world.replaceChild(model, self._models[place])
            self._models[place] = model
        else:  # scenery moves on
            self._world.insertBefore(model, self._models[place])
            self._models.insert(place, model)

    def move(self, model: Element, pose: list[float]) -> None:
        """Places scenery in a frame of its own."""
        name = self._new_name("frame")
        frame = self._world.insertBefore(self._document.createElement("frame"), self._models[0])
        frame.setAttribute("name", name)
        _place(self._document, frame, pose)
        own = [child for child in model.childNodes if getattr(child, "tagName", "") == "pose"]
        if not own:
            _place(self._document, model, [0, 0, 0, 0, 0, 0, 1])
        next(child for child in model.childNodes if getattr(child, "tagName", "") == "pose").setAttribute("relative_to", name)

    def _new_name(self, prefix: str) -> str:
        taken = {child.getAttribute("name") for child in self._world.childNodes if child.nodeType == child.ELEMENT_NODE}
        return next(name for name in map((prefix + "_{}").format, count()) if name not in taken)

    def _new_empty(self) -> Element:
        model = self._document.createElement("model")
        model.setAttribute("name", self._new_name("empty"))
        _set_text(self._document, model.appendChild(self._document.createElement("static")), "true")
        model.appendChild(self._document.createElement("link")).setAttribute("name", "link")
        self._empty.append(model)
        return model


def _document_of(world: World, folder: Path) -> _Parsed:
    """The file of a world, parsed, for a file in this folder. Raises WorldError if it is no SDFormat with models."""
    if world._source is None:
        raise _no_text(world, "the text that it was loaded from is not known", "load its file")
    source, is_text = world._source[:2]
    try:
        document = expatbuilder.parseString(source if is_text else Path(source).read_bytes(), namespaces=False)
    except (OSError, ExpatError) as error:
        raise _no_text(world, f"its file cannot be read again: {error}", "put the file back") from None
    if document.documentElement.tagName != "sdf" or not _models(document):
        raise _no_text(world, "it is no SDFormat with models, and there is no writer for other formats",
                       "include the file in a world: WorldBuilder.add")
    if not is_text and Path(source).parent.resolve() != folder.resolve():
        for uri in document.getElementsByTagName("uri"):
            file = _file_of(_text(uri), Path(source).resolve().parent, world._source[2])
            if file is not None:
                _set_text(document, uri, file.resolve().as_uri())
    return document


def _file_of(uri: str, folder: Path, search_paths: list[str]) -> Optional[Path]:
    """The file that a URI of a world in this folder leads to, as docs/worlds.md has it; None: another URI, or no file."""
    scheme, _, rest = uri.rpartition("://")
    if not rest or scheme not in ("", "model"):
        return None
    near = [place / part for place in (folder, *folder.parents) for part in ("", "models")] if scheme else [folder]
    return next((place / rest for place in (*map(Path, search_paths), *near) if (place / rest).exists()), None)


def _added(document: _Parsed, added: World, folder: Path) -> list[Element]:
    """The models of a world that was added, as elements of the document."""
    source, is_text = added._source[:2] if added._source is not None else ("", True)
    if source and not is_text and not _is_sdf_world(source):  # a model alone, of any format
        include = document.createElement("include")
        for tag, value in (("name", added.robots[0] if added.robots else added.name), ("uri", Path(source).as_uri())):
            _set_text(document, include.appendChild(document.createElement(tag)), value)
        return [include]
    return [document.importNode(model, True) for model in _models(_document_of(added, folder))]


def _is_sdf_world(source: str) -> bool:
    try:
        return bool(_world_of(expatbuilder.parse(source, namespaces=False)))
    except (OSError, ExpatError):
        return False


def _rename(document: _Parsed, model: Element, name: str) -> None:
    if model.tagName == "model":
        model.setAttribute("name", name)
        return
    _drop(model, "name")
    _set_text(document, model.appendChild(document.createElement("name")), name)


def _place(document: _Parsed, model: Element, pose: list[float]) -> None:
    _drop(model, "pose")
    element = model.appendChild(document.createElement("pose"))
    element.setAttribute("rotation_format", "quat_xyzw")
    _set_text(document, element, " ".join(repr(number) for number in pose))


def _publish(world: World, path: Path, content: str) -> None:
    """Writes the file, if it loads to the same world. Raises WorldError otherwise; nothing is written then."""
    handle, name = tempfile.mkstemp(suffix=".sdf", dir=path.parent)
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(content)
        search_paths = list(world._source[2]) if world._source is not None else []
        model = _core.load(name, False, search_paths, "", False, [], None, None, "", None, False, "")[0]
        if model is None or model.hash != world.hash:
            raise WorldError(f"world '{world.name}' cannot be written as SDFormat: the file would be another world "
                             f"({model.hash if model is not None else 'refused'} instead of {world.hash})",
                             "options of load (dt, ground, fixed_base ...) are not in a file: write them there; a model that "
                             "was put elsewhere must be placed there", "other-world")
        os.chmod(name, 0o666 & ~_umask())
        os.replace(name, path)
    finally:
        if os.path.exists(name):
            os.unlink(name)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def _no_text(world: World, fault: str, remedy: str) -> WorldError:
    return WorldError(f"world '{world.name}' cannot be written as SDFormat: {fault}", remedy, "no-text")


def _world_of(document: Document) -> list[Element]:
    return [child for child in document.documentElement.childNodes if getattr(child, "tagName", "") == "world"]


def _models(document: _Parsed) -> list[Element]:
    """Those of its world, or of a file that has models alone."""
    parent = next(iter(_world_of(document)), document.documentElement)
    return [child for child in parent.childNodes if getattr(child, "tagName", "") in ("model", "include")]


def _name_of(model: Element) -> str:
    if model.tagName == "model":
        return model.getAttribute("name")
    return next((_text(child) for child in model.childNodes if getattr(child, "tagName", "") == "name"), "")


def _drop(model: Element, tag: str) -> None:
    for child in [child for child in model.childNodes if getattr(child, "tagName", "") == tag]:
        model.removeChild(child)


def _text(element: Element) -> str:
    return "".join(child.data for child in element.childNodes if child.nodeType == child.TEXT_NODE).strip()


def _set_text(document: _Parsed, element: Any, value: str) -> None:
    while element.firstChild:
        element.removeChild(element.firstChild)
    element.appendChild(document.createTextNode(value))
