"""Examples in docstrings, and the Python in README.md and in pages of docs, run as they stand."""
import doctest
import inspect
import pydoc

import gymnasium
import numpy as np
import pytest

import roboss
import roboss.analysis
from conftest import BLOCK, PAGES, REPOSITORY
from roboss import (batch, builder, camera, envs, kinematics, padded, robots, run, sensors, simulation, terrain, trajectories,
                    view, world)
from roboss.analysis import recorder, recording
from roboss.envs import city, city_driver, parallel, single, soccer, vector
from roboss.randomize import randomizer, streams

MODULES = [roboss, batch, padded, terrain, builder, camera, world, run, simulation, robots, sensors, kinematics, trajectories, view]
MODULES += [roboss.analysis, recorder, recording, envs, city, city_driver, parallel, single, soccer, vector]
MODULES += [roboss.randomize, randomizer, streams]


@pytest.mark.parametrize("module", MODULES, ids=lambda module: module.__name__)
def test_examples_in_docstrings(module):
    result = doctest.testmod(module, extraglobs={"roboss": roboss, "np": np, "gymnasium": gymnasium})
    assert result.attempted > 0 and result.failed == 0


@pytest.mark.parametrize("module", [roboss, envs, roboss.analysis, roboss.randomize],
                         ids=lambda module: module.__name__)
def test_everything_public_has_a_docstring(module):
    for name in module.__all__:
        thing = getattr(module, name)
        if isinstance(thing, type):
            own = [base for base in thing.__mro__ if base.__module__.startswith("roboss.")]
            members = [getattr(thing, member) for base in own for member in vars(base) if not member.startswith("_")]
            described = [member for member in members if callable(member) or isinstance(member, property)]
            if thing.__module__ != "roboss._core":
                assert all(inspect.getdoc(member) for member in [thing, *described]), name


@pytest.mark.parametrize("page", PAGES)
def test_blocks_of_pages_run(page, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "my_robot.urdf").write_text((REPOSITORY / "examples/first_robot/rover.urdf").read_text())
    blocks = BLOCK.findall((REPOSITORY / page).read_text())
    assert blocks
    names = {}
    for block in blocks:
        exec(block, names)


def test_help_describes_what_a_task_of_ones_own_defines():
    text = pydoc.render_doc(envs.Task, renderer=pydoc.plaintext)
    for method in ("observe", "act", "outcome", "place", "remove", "rows_of", "by_world"):
        assert f" {method}(self" in text, method
