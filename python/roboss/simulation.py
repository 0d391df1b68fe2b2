"""Simulation: one world in this process, stepped on all cores."""
from __future__ import annotations

import operator
import os
import warnings
from typing import TYPE_CHECKING, Any, Iterable, Optional, Self, Sequence, Union

from numpy.typing import ArrayLike

from . import _core
from .errors import ArgumentError, SaveError, StateError, WorldWarning
from .names import file_path, filled, flag, instance, names_of, whole
from .outputs import check_output
from .robots import Robots
from .run import Run
from .view import View
from .world import World, load
from .world_file import Edit

if TYPE_CHECKING:
    from .batch import Batch

_THREADS_MOST = 1024  # as the command line


def threads_or_all(threads: Optional[int]) -> int:
    """The number given; of None one for each core that this process may use.

    Raises:
        ArgumentError: not 1 to 1024.
    """
    if threads is None:
        return min(len(os.sched_getaffinity(0)), _THREADS_MOST)
    if not 1 <= whole("threads", threads, -2**63) <= _THREADS_MOST:
        raise ArgumentError(f"{threads} threads", f"give 1 to {_THREADS_MOST}, or None for one a core", "bad-threads")
    return threads


class Simulation(Run):
    """One world, at a tick of its time. Not for several threads at once (StateError).

    `pickle` and `copy.deepcopy` give a simulation that continues with the same bits: with its world, orders that wait,
    and number of threads, and without its view. One of a Batch goes along with its Batch.

    Args:
        world: a World, or what `load` takes.
        threads: that step; None: one for each core that this process may use. No bit depends on it.
        seed: of sensor noise.

    Raises:
        WorldError: the world has plugins that send messages (code "message-board"), or cannot be loaded.

    >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"), threads=1)
    >>> sim.step(10)
    >>> sim.tick, sim.time
    (10, 0.02)
    """

    _view: Optional[View] = None
    _batch: Optional[tuple[Any, int]] = None  # a Batch, and its place there

    def __init__(self, world: Union[World, str, os.PathLike], *, threads: Optional[int] = None, seed: int = 0):
        self.world: World = world if isinstance(world, World) else load(world)  #: that it simulates
        self._take(_core.Simulation(self.world._model, threads_or_all(threads), whole("seed", seed)))

    @classmethod
    def _of(cls, world: World, core: _core.Simulation) -> Self:
        """The simulation of a world that is there already."""
        simulation = cls.__new__(cls)
        simulation.world = world
        simulation._take(core)
        return simulation

    def _take(self, core: _core.Simulation) -> None:
        self._core, self._simulations, self._shape = core, [core], ()
        core.see(self.world._looks, core.threads)

    def step(self, ticks: int = 1) -> None:
        """Advances the world by `ticks` time steps of `dt`. Other threads of Python run meanwhile; Ctrl-C ends it.

        Raises:
            StateError: a state would become infinite (code "not-finite"). The text names robot and joint; the world
                stays intact at the beginning of that tick.
        """
        self._core.step(whole("ticks", ticks))

    @property
    def tick(self) -> int:
        """Ticks since the start of the world."""
        return self._core.tick

    @property
    def threads(self) -> int:
        """Threads that step."""
        return self._core.threads

    def save(self, path: Union[None, str, os.PathLike] = None) -> _core.Save:
        """Everything needed to continue exactly: states, orders that wait, tick, seed. It has `tick` and `seed`.

        `pickle` keeps it, with its world.

        Args:
            path: of a file to write it to, too: that of `roboss run --save`, which `roboss run WORLD --from FILE`
                continues, and `load`. It replaces a saved state, and nothing else.

        Raises:
            ArgumentError: the file is the world's (code "output-is-input"), or no saved state ("other-kind",
                "not-a-saved-run").
            SaveError: it cannot be written.
        """
        save = self._core.save()
        if path is not None:
            path = file_path("path", path)
            check_output(path, "saved state", [self.world.file])
            _core.may_save_to(path)
            save.write(path, self.world.file, int(self.world._loaded, 16))
        return save

    @classmethod
    def load(cls, path: Union[str, os.PathLike], world: Optional[World] = None, *, threads: Optional[int] = None) -> Simulation:
        """The simulation of a file that `save` or `roboss run --save` wrote, as it was, with the orders that waited.

        Of a journal (`roboss run --journal`) it is the end; roboss.Journal goes to any time. Control programs of
        `roboss run` are not started: the orders that they gave before are in the file, what they remember is not used.

        Args:
            path: of the file.
            world: that it was saved of; None: the one in the file. Without its world file, that has no looks: nothing
                is seen by cameras and views but the shapes that collide.
            threads: of the Simulation.

        Raises:
            JournalError: there is no such file, it is no saved state, or it is damaged.
            SaveError: it is of another world (code "other-world").
        """
        journal = _core.open_journal(file_path("path", path))
        branch = journal.branches[-1]
        model = journal.model(branch.id)
        if world is None:
            world = World(model, branch.world_file, (), loaded=journal.world_hash(branch.id))
        elif instance("world", world, World, "give a World, or None").hash != model.hash:
            raise SaveError(f"'{file_path('path', path)}' was saved of another world than '{world.name}'",
                            "leave the world out, or give the one that it is of", "other-world")
        core = journal.at(branch.id, world._model, branch.last_tick, branch.last_tick, True, threads_or_all(threads))
        return Simulation._of(world, core)

    def restore(self, save: _core.Save) -> None:
        """Continues from a save of the same world, also one of another Simulation. Raises SaveError otherwise.

        >>> sim = roboss.Simulation(roboss.example("pile.sdf"))
        >>> sim.step(50)
        >>> save = sim.save()
        >>> sim.step(50); first = sim.state_hash
        >>> sim.restore(save); sim.step(50)
        >>> sim.state_hash == first
        True
        """
        self._core.restore(instance("save", save, _core.Save, "give what `save` returned"))

    def branch(self, count: int, *, threads: Optional[int] = None) -> Batch:
        """`count` simulations that continue from this moment with the same bits, as a Batch: to try what may come.

        Each has the states, orders that wait, sensors and seed of noise of this one, which stays as it is.

        Args:
            threads: that step the Batch; None: as many as step this simulation.

        Raises:
            ArgumentError: `count` below 1.

        >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
        >>> sim.step(100)
        >>> branches = sim.branch(3)
        >>> branches.robots("car_0").set_joint_targets(np.array([0.0, 5, 10])[:, None, None])   # rad/s
        >>> _ = branches.step(500)
        >>> branches.robots("car_0").joint_velocity[:, 0, 0].round(1), sim.tick
        (array([ 0.,  5., 10.]), 100)
        """
        from .batch import branch_of  # it is made of Simulations

        count = whole("count", count, 1)
        return branch_of([self.world], [self._save_for_copy()], count, self.threads if threads is None else threads)

    def reset(self, seed: Optional[int] = None) -> None:
        """Back to the start of the world, without orders; with this seed of noise, None: the same one."""
        self._core.reset(None if seed is None else whole("seed", seed))

    def __reduce__(self) -> tuple[Any, ...]:
        if self._batch is not None:
            return operator.getitem, self._batch
        return _simulation_of, (self.world, self.threads, self._save_for_copy())

    def _save_for_copy(self) -> _core.Save:
        """With what a copy begins; raises StateError if there cannot be one."""
        return self.save()

    def spawn(self, source: Union[World, str, os.PathLike], name: Union[None, str, Sequence[str]] = None,
              pose: ArrayLike = (0, 0, 0, 0, 0, 0, 1), *, on_ground: bool = False) -> Robots:
        """Adds the models of a world, or copies of its only model, at the present tick. They are at rest.

        Args:
            source: a World with the same `dt`, or what `load` takes.
            name: of the model in this world, or names of several copies; None: as it is called in `source`.
            pose: where the origin of `source` is in this world: x y z (m), quaternion x y z w; shape (7,), or (copies,
                7).
            on_ground: stand them on the scenery below that place, with their lowest collision shape.

        Returns the robots that came. Robots that were asked for before raise StateError (code "changed-world") from now
        on; ask `robots` again. All others keep every bit of their states. `reset` puts the new ones where they came.

        A WorldWarning tells of robots that start deep in others or in the scenery.

        Raises:
            WorldError: a name is taken (code "name-taken"), another `dt` ("other-step"), or `load` refuses the source.

        >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
        >>> sim.step(100)
        >>> ball = '''<robot name="ball"><link name="body">
        ...   <inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>
        ...   <collision><geometry><sphere radius="0.2"/></geometry></collision>
        ... </link></robot>'''
        >>> balls = sim.spawn(ball, ["ball_0", "ball_1"], [[0, 0, 2, 0, 0, 0, 1], [0, 0, 3, 0, 0, 0, 1]])
        >>> sim.step(100)
        >>> balls.pose[:, 2].round(3)                      # m, 0.2 s later
        array([1.804, 2.804])
        """
        self._may_change()
        addition = source if isinstance(source, World) else load(source, dt=self.dt)
        names = [""] if name is None else names_of("name", name)
        poses = filled("pose", pose, (len(names), 7)).tolist()
        before = len(self.world.robots)
        core, model, findings = self._core.spawn(addition._model, names, poses, flag("on_ground", on_ground))
        for finding in findings:
            if finding.severity != "note":
                warnings.warn(str(finding), WorldWarning, stacklevel=2)
        frames = self.world._frames or [()] * before
        new = len(model.robots) - before
        looks = self.world._looks.with_copies(addition._looks, addition._model, names, poses)
        came = dict(zip(model.robots[before:], model.families[before:]))
        edit = Edit(addition, tuple(names), came, poses)
        self._continue(core, model, [*frames, *(list(addition._frames) or [()] * new) * len(names)], looks, edit)
        return Robots(self, range(before, before + new))

    def remove(self, robots: Union[str, Iterable[str], Robots]) -> None:
        """Takes robots out of the world: those of a pattern, of a list of names, or these. The others keep every bit.

        Robots that were asked for before raise StateError (code "changed-world") from now on; ask `robots` again.

        >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
        >>> sim.remove("car_1*")
        >>> len(sim.robots("car_*"))
        9
        """
        self._may_change()
        names = robots.names if isinstance(robots, Robots) else [self.world.robots[n] for n in self.world._find(robots)]
        core, model, now = self._core.remove(list(names))
        frames = [frame for frame, new in zip(self.world._frames, now) if new >= 0]
        self._continue(core, model, frames, self.world._looks, Edit(None, tuple(names)))

    def _may_change(self) -> None:
        if self._batch is not None:
            raise StateError("a simulation of a Batch keeps its world", "use a Simulation", "in-batch")

    def _continue(self, core: _core.Simulation, model: _core.Model, frames: list, looks: _core.Looks, edit: Edit) -> None:
        """Goes on in another world."""
        self.world = World(model, self.world.file, self.world.diagnostics, frames, looks, loaded=self.world._loaded,
                           source=self.world._source, edits=(*self.world._edits, edit))
        self._take(core)
        if self._view is not None:
            self._view._show()

    def view(self, port: Optional[int] = None, *, address: str = "127.0.0.1", role: str = "steer",
             height: int = 480, insecure: bool = False) -> View:
        """Shows this simulation in browsers, on the page of docs/viewer.md: what `step` does, as it is done.

        The server runs in this process until View.close(), or until the simulation or the program ends. A simulation
        has one view: a second call gives the same one. In a notebook, a cell that ends with it shows the page.

        Args:
            port: None: 8090, or the next one that is free; a number: this one, or the next one that is free.
            address: to listen at; with another one than loopback, the page is served over TLS, the `url` carries a
                token, and `View.fingerprint` is that of the certificate, for browsers to compare.
            role: the most that a page may do: "watch" or "steer" (order robots: drag, push, set joints).
            height: of the frame in a notebook, pixels.
            insecure: without TLS, also beyond loopback.

        Raises:
            ViewError: it cannot listen there.

        >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
        >>> with sim.view() as view:
        ...     print(view.url.split(":")[0])           # open it in a browser
        ...     sim.step(100)
        http
        """
        if self._view is None or self._view.closed:
            self._view = View(self, port, address, role, height, insecure)
        return self._view

    def __repr__(self) -> str:
        return f"<roboss.Simulation of '{self.world.name}' at {self.time:g} s: {len(self.world.robots)} robots>"


def _simulation_of(world: World, threads: int, save: _core.Save) -> Simulation:
    """The simulation of its parts, for pickle."""
    simulation = Simulation(world, threads=threads)
    simulation.restore(save)
    return simulation
