"""View: a simulation in browsers and notebooks."""
from __future__ import annotations

import atexit
import html
import logging
import threading
import time
import webbrowser
import weakref
from pathlib import Path
from typing import TYPE_CHECKING, Optional

from . import _core
from .names import flag, real, text, unknown, whole

if TYPE_CHECKING:
    from .simulation import Simulation

_PAGE = Path(__file__).parent / "program" / "share" / "roboss" / "web"
_ROLES = ["watch", "steer"]
_TURN_S = 0.02  # between two turns while nothing is stepped
_log = logging.getLogger("roboss")
_open: weakref.WeakSet[View] = weakref.WeakSet()


class View:
    """The viewer's page over a simulation. Simulation.view makes it; `with` closes it at the end.

    Pages see the simulation while it is stepped and while it rests. Orders of pages (role "steer") take effect at the
    next tick, as those of the program do. What only `roboss run` can do (pause, rewind, save) is refused on the page.
    The server's notices go to the logger "roboss".

    >>> sim = roboss.Simulation(roboss.example("crossroads.sdf"))
    >>> view = sim.view(role="watch")
    >>> view.pages                              # open in browsers
    0
    >>> view.close()
    >>> view.closed
    True
    """

    def __init__(self, simulation: Simulation, port: Optional[int], address: str, role: str, height: int,
                 insecure: bool):
        if role not in _ROLES:
            raise unknown("role", role, _ROLES)
        port = None if port is None else whole("port", port, 1, 65535)
        host = f"[{address}]" if ":" in text("address", address) else address
        core = _core.open_view(f"{host}:{port or 8090}", str(_PAGE), role, "roboss in Python",
                               flag("insecure", insecure))
        self.url: str = core.url  #: address of the page, with the token where one is needed
        self.fingerprint: str = core.fingerprint  #: SHA-256 of its certificate; empty without TLS, as on loopback
        self._core: Optional[_core.View] = core
        self._simulation = weakref.ref(simulation)
        self._height = whole("height", height, 1)
        self._end = threading.Event()
        self._show()
        self._thread = threading.Thread(target=_turn, args=(self._simulation, core, self._end), daemon=True,
                                        name="roboss view")
        self._thread.start()
        _open.add(self)

    @property
    def pages(self) -> int:
        """How many pages are open."""
        return 0 if self._core is None or self.closed else self._core.pages

    @property
    def closed(self) -> bool:
        """Whether it was closed, or its simulation is gone."""
        return self._end.is_set()

    def open(self) -> None:
        """Opens the page in the browser of this computer, as far as it has one."""
        webbrowser.open(self.url)

    def wait(self, pages: int = 1, timeout: float = 60.0) -> bool:
        """Waits until this number of pages is open, at most `timeout` s. Returns whether they are."""
        pages, end = whole("pages", pages), time.monotonic() + real("timeout", timeout)
        while self.pages < pages and time.monotonic() < end and not self.closed:
            time.sleep(_TURN_S)
        return self.pages >= pages

    def close(self) -> None:
        """Tells all pages that it ends, and frees the port. The simulation continues without a view."""
        core, self._core = self._core, None
        if core is None:
            return
        if not self.closed:
            core.say_farewell("the program has closed the view")
        self._end.set()
        simulation = self._simulation()
        if simulation is not None and simulation._view is self:
            simulation._core.show_in(None, _core.Looks())
            simulation._view = None
        self._thread.join()

    def _show(self) -> None:
        """The simulation that Python has now is the one that is shown."""
        simulation = self._simulation()
        if simulation is not None:
            simulation._core.show_in(self._core, simulation.world._looks)

    def __enter__(self) -> View:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return "<roboss.View, closed>" if self.closed else f"<roboss.View at {self.url}: {self.pages} pages>"

    def _repr_html_(self) -> str:
        """The page in a frame, for notebooks."""
        if self.closed:
            return html.escape(repr(self))
        url = html.escape(self.url)
        frame = html.escape(self.url + ("&" if "?" in self.url else "?") + "hide=panels")
        return (f'<iframe src="{frame}" width="100%" height="{self._height}" style="border: 0" allowfullscreen></iframe>'
                f'<div><a href="{url}" target="_blank">{url}</a></div>')


def _turn(simulation: weakref.ref[Simulation], core: _core.View, end: threading.Event) -> None:
    """Keeps pages up to date while nothing is stepped. Lives in a thread, as long as the simulation and the view."""
    while not end.wait(_TURN_S):
        shown = simulation()
        if shown is None:
            end.set()
            return core.say_farewell("the simulation has ended")
        shown._core.turn_view()
        del shown
        for notice in core.take_notices():
            _log.info(notice)


@atexit.register
def _close_all() -> None:
    for view in list(_open):
        view.close()
