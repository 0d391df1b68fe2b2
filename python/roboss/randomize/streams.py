"""Streams of random numbers that have names: a draw depends on its own name and number, and on nothing else."""
from __future__ import annotations

import hashlib
import json
from typing import Optional, Sequence, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from ..errors import ArgumentError
from ..names import listed, whole
from .distributions import choice

_T = TypeVar("_T")


ROWS = 16  #: draws of a stream


def stream(seed: int, simulation: int, robot: str, term: str, block: int) -> np.random.Generator:
    """The random numbers of 16 draws of a Randomizer, one after the other: draws 16 * block to 16 * block + 15.

    It is numpy's Philox with the counter [0, block, 0, 0]. Its key is the BLAKE2b of 16 bytes of the JSON text
    `json.dumps([seed, simulation, robot, term])`, read as an integer with the low byte first.

    Args:
        simulation: place of the simulation in its Batch; 0 of a Simulation.
        robot: its name in the world.
        term: its name; "NAME/when" of the intervals of a term.
        block: from 0 on.
    """
    text = json.dumps([seed, simulation, robot, term]).encode()
    key = np.frombuffer(hashlib.blake2b(text, digest_size=16).digest(), dtype="<u8")
    return np.random.Generator(np.random.Philox(key=key, counter=[0, block, 0, 0]))


def pick(items: Sequence[_T], count: int, *, seed: int = 0, weights: Optional[ArrayLike] = None) -> list[_T]:
    """Draws one of the items for each of `count` simulations, as terrains for the members of a Batch.

    The item of a simulation is a function of the seed and its place, whatever `count` is.

    Args:
        items: worlds, difficulties ...
        weights: how often, in proportion, (items,); None: all alike.

    >>> roboss.randomize.pick(["flat", "stairs", "rough"], 6, seed=3)[:4] == roboss.randomize.pick(
    ...     ["flat", "stairs", "rough"], 4, seed=3)
    True
    """
    things = listed("items", items)
    if not things:
        raise ArgumentError("no items to pick from", "give one or more", "no-items")
    places = choice(np.arange(len(things)), weights)
    seed = whole("seed", seed)
    drawn = [places.sample(stream(seed, number, "", "pick", 0), 1, 1) for number in range(whole("count", count))]
    return [things[int(place[0, 0])] for place in drawn]
