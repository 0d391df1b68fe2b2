"""RemoteSimulation: a run of a Controller elsewhere, with the objects of a Simulation."""
from __future__ import annotations

import json
import logging
import os
import threading
import weakref
from pathlib import Path
from typing import Any, Callable, Iterable, Sequence, Union

from numpy.typing import ArrayLike

from . import _core
from .errors import ArgumentError, StateError
from .names import file_path, filled, flag, listed, names_of, real, text, whole
from .robots import Robots
from .run import Run
from .world import World

_TURN_S = 0.05  # between two looks at the network while nothing is stepped
_log = logging.getLogger("roboss")


def connect(simulation: str = "default", *, name: str = "python", period: int = 10, latency: int = 0,
            controller: str = "", keys: Union[str, Path] = "", insecure: bool = False,
            patience: float = 10.0) -> RemoteSimulation:
    """Joins a run of `roboss controller`, on this computer or on a cluster, as a Client that steps it.

    From then on the world waits for this program at every `period` ticks: `step` lets it go on. Start the Controller
    with `--await-client NAME` if it shall wait for this program from the beginning.

    Args:
        simulation: name of the run (`--simulation`).
        name: of this Client; unique in the run.
        period: ticks between two observations; `step` takes multiples of it.
        latency: ticks from an observation to the effect of the orders that are given at it. With 0, states are those
            that a Simulation would have; more lets the cluster compute ahead meanwhile.
        controller: HOST or HOST:PORT of the Controller; empty: that of `simulation` on this computer.
        keys: folder with this program's key (`roboss keys`); empty: that of the run, on the Controller's computer.
        insecure: join a Controller that was started with `--insecure`, without keys and encryption.
        patience: s without a Controller after which ClusterError is raised (code "no-controller").

    Raises:
        ClusterError: no Controller is found, or it refuses this Client; a key is missing or not accepted.
        ArgumentError: a period or latency that cannot be.
    """
    period, latency = whole("period", period, 1), whole("latency", latency)
    core = _core.connect(text("simulation", simulation), text("name", name), period, latency,
                         real("patience", patience, 0), text("controller", controller),
                         file_path("keys", keys), flag("insecure", insecure))
    return RemoteSimulation(core, f"<simulation '{simulation}'>")


class RemoteSimulation(Run):
    """A run elsewhere, at the tick that this program observes. `connect` makes it; `with` leaves the run at the end.

    `robots`, their arrays (joint positions and velocities among them), orders, commands, sensors and `contacts` are those
    of a Simulation. Sensors are computed in this process. What is assigned to `pose`, `twist`, `joint_position` and
    `joint_velocity` (`qpos`, `qvel`) is an order: it is seen after the next `step`. Robots that others add or remove end the connection (StateError, "changed-world"). Orders that the Controller refuses go to the logger
    "roboss".

    `reset`, `restore`, `spawn` and `remove` are requests to the run: they change the world for all its Clients. Orders that
    were given since the last `step` are dropped by them.
    """

    def __init__(self, core: _core.Remote, source: str):
        self._core = core
        self._simulations, self._shape = [core.simulation], ()
        self.world: World = World(core.model, source, ())  #: that is simulated
        self._end = threading.Event()
        # The Controller repeats what is not answered: somebody takes it while nothing is stepped.
        self._thread = threading.Thread(target=_advance, args=(weakref.ref(self), self._end), daemon=True, name="roboss remote")
        self._thread.start()

    def step(self, ticks: int = 0) -> None:
        """Lets the world go on by `ticks`, a multiple of `period`; 0: one period. Ctrl-C ends the wait.

        Raises:
            ArgumentError: no multiple of `period`.
            ClusterError: the run is over (code "run-over"), or the Controller is gone ("no-controller").
            StateError: robots came or went ("changed-world"): connect again.
        """
        self._core.step(whole("ticks", ticks) or self.period)
        for line in self._core.take_refusals():
            _log.warning(line)

    @property
    def period(self) -> int:
        """Ticks between two observations."""
        return self._core.period

    @property
    def tick(self) -> int:
        """Ticks since the start of the world, of the observation."""
        return self._core.tick

    def reset(self) -> None:
        """Back to the start of the world file: robots that were added leave, those that were removed come back.

        The seed of noise stays. Raises ClusterError where the run refuses it.
        """
        self._change(self._core.reset)

    def save(self, file: str, *, overwrite: bool = False) -> str:
        """Saves the run on the Controller's computer, as `roboss control save FILE`; returns what the run answers.

        Args:
            file: below the folder that the run allows (`roboss controller --save-folder`).
            overwrite: whether a file of that name is replaced.

        Raises:
            ClusterError: the run refuses it: no folder, the file exists (code "file-exists") ...
        """
        return self._core.control(["save", text("file", file), *(["overwrite"] if flag("overwrite", overwrite) else [])])

    def restore(self) -> None:
        """Back to the last `save` of the run, or to the file that it was started from (`--from`).

        Raises ClusterError if there is none (code "no-save"). To continue from an older file start a run with `--from`.
        """
        self._change(self._core.restore)

    def spawn(self, source: Union[str, os.PathLike], name: Union[None, str, Sequence[str]] = None,
              pose: ArrayLike = (0, 0, 0, 0, 0, 0, 1), *, on_ground: bool = False) -> Robots:
        """Adds the models of a file, or copies of its only model, at the present tick. They are at rest.

        Args:
            source: path or text of an SDFormat, URDF or MJCF file. Files that it refers to (meshes) are looked up on the
                Controller's computer.
            name, pose, on_ground: as of Simulation.spawn.

        Returns the robots that came. Robots that were asked for before raise StateError from now on; ask `robots` again.

        Raises:
            ArgumentError: a World, which has no text to send.
            ClusterError: the run refuses the file (its findings are in the text), or a name.
        """
        if isinstance(source, World):
            raise ArgumentError("a World cannot be sent to a run", "give the path or the text of its file", "no-text")
        source = file_path("source", source)
        is_text = source.lstrip().startswith("<")
        content = source if is_text else Path(source).read_text(encoding="utf-8")
        names = [""] if name is None else names_of("name", name)
        before = set(self.world.robots)
        self._change(self._core.add, "<text>" if is_text else source, content, names,
                     filled("pose", pose, (len(names), 7)).tolist(), flag("on_ground", on_ground))
        return self.robots([robot for robot in self.world.robots if robot not in before])

    def remove(self, robots: Union[str, Iterable[str], Robots]) -> None:
        """Takes robots out of the world: those of a pattern, of a list of names, or these.

        Robots that were asked for before raise StateError from now on; ask `robots` again.
        """
        names = robots.names if isinstance(robots, Robots) else [self.world.robots[n] for n in self.world._find(robots)]
        self._change(self._core.remove, list(names))

    def _change(self, request: Callable, *arguments: Any) -> None:
        """Sends a request that changes the world; then this is the run with what the world has now."""
        request(*arguments)
        core = self._core.simulation
        if core is not self._simulations[0]:
            self._simulations = [core]
            self.world = World(self._core.model, self.world.file, ())

    def control(self, *words: str) -> str:
        """A request to the run in the words of `roboss control`: `control("speed", "max")`. Returns its answer.

        Raises ClusterError if it is refused, ArgumentError if there is no such request.
        """
        return self._core.control([text("words", word) for word in words])

    def status(self) -> dict[str, Any]:
        """The run as `roboss control status` tells it: members, islands, windows, losses ..."""
        return json.loads(self._core.control(["status"]))

    def close(self) -> None:
        """Leaves the run, which continues without this program. Later calls raise StateError."""
        if self._end.is_set():
            return
        self._end.set()
        self._thread.join()
        self._core.leave()

    def __enter__(self) -> RemoteSimulation:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __reduce__(self) -> tuple[Any, ...]:
        raise StateError("a run on a cluster has no copy in this process",
                         "save() it there, and load the file as a Simulation", "remote")

    def __getattr__(self, name: str) -> Any:
        if name in ("branch", "view", "threads"):
            raise StateError(f"'{name}' is for a Simulation in this process",
                             "see control() and `roboss control` for runs on a cluster", "remote")
        raise AttributeError(name)

    def __repr__(self) -> str:
        if self._end.is_set():
            return "<roboss.RemoteSimulation, closed>"
        return f"<roboss.RemoteSimulation of '{self.world.name}' at {self.time:g} s: {len(self.world.robots)} robots>"


def _advance(remote: weakref.ref[RemoteSimulation], end: threading.Event) -> None:
    """Takes what comes while nothing is stepped. Lives in a thread, as long as the connection."""
    while not end.wait(_TURN_S):
        there = remote()
        if there is None:
            return
        there._core.advance()
        del there
