"""Radios: messages between robots."""
from __future__ import annotations

from typing import NamedTuple, Optional, Sequence, Union

from . import _core
from .errors import ArgumentError
from .names import listed, text
from .sensors import Sensor

Payload = Union[bytes, bytearray, memoryview, str]


class Message(NamedTuple):
    """A message as a radio received it."""
    sender: str  #: name of the robot
    to: Optional[str]  #: name of the robot that it is for; None: everybody
    sent: float  #: simulated time at which it was given to the sender's radio, s
    arrived: float  #: simulated time of the first tick at whose beginning it was there, s
    channel: int  #: of both radios
    strength: float  #: power at the receiver, dBm
    payload: bytes  #: as it was sent


class Radio(Sensor):
    """A radio that all robots of a set have. `robots["radio"]` makes it. What is lost, and why: docs/radio.md.

    `read_all` shows all that arrived within the last second; `receive` gives each message once.
    """

    def send(self, payload: Union[Payload, Sequence[Payload]], to: Union[str, Sequence[Optional[str]], None] = None
             ) -> None:
        """Each robot sends a message, in effect with the next `step`.

        Args:
            payload: bytes, or text (UTF-8): the same for all robots, or a list with one for each. At most 8192 bytes.
            to: the robot that it is for, by its name or by the address of its radio; a list: one for each robot;
                None: everybody who hears it.

        Raises OrderError for a payload that is too long or for a message to oneself, UnknownNameError for an
        addressee that is not there; then nothing is sent.

        >>> sim = roboss.Simulation(roboss.example("radio.sdf"))
        >>> rovers = sim.robots("rover_*")
        >>> rovers[:1]["radio"].send(b"hello")
        >>> sim.step(20)
        >>> [[message.payload for message in heard] for heard in rovers["radio"].receive()]
        [[], [b'hello'], [b'hello'], []]
        """
        rows = len(self.robots) * len(self.robots._simulations)
        is_one = isinstance(payload, (bytes, bytearray, memoryview, str))
        payloads = [payload] * rows if is_one else listed("payload", payload)
        names = [to] * rows if to is None or isinstance(to, str) else listed("to", to)
        for what, values in (("payloads", payloads), ("addressees", names)):
            if len(values) != rows:
                raise ArgumentError(f"{len(values)} {what} for {rows} robots", "give one for each, or one for all")
        addressees = ["" if name is None else text("to", name) for name in names]
        if any(name == "" for name in names):
            raise ArgumentError("an addressee with an empty name", "give None for everybody")
        as_bytes = [_bytes_of(p) for p in payloads]
        _core.transmit(self.robots._simulations, list(self.robots.ids), self._numbers, as_bytes, addressees)

    def receive(self) -> list[list[Message]]:
        """For each robot the messages that arrived since the last call, or since the run began, by time of arrival.

        Of a Batch: robots of the first simulation, then of the second ... A message is kept for a second after it was
        sent: ask as often. `reset` and `restore` forget what was not asked for.
        """
        heard = _core.received(self.robots._simulations, list(self.robots.ids), self._numbers)
        return [[Message(sender, to or None, *rest) for sender, to, *rest in row] for row in heard]


def _bytes_of(payload: object) -> bytes:
    if isinstance(payload, str):
        return payload.encode()
    if not isinstance(payload, (bytes, bytearray, memoryview)):
        raise ArgumentError(f"payload: a value of type '{type(payload).__name__}'", "give bytes or a text", "bad-type")
    return bytes(payload)
