"""The spider of examples/spider: searches walk as its control program does, and the Analyser sees its motors."""
import argparse
import json
import sys
from pathlib import Path

import numpy as np
import pytest

import roboss
from conftest import REPOSITORY
from roboss.analysis.recorder import journal_of_run
from test_recording import command

sys.path.insert(0, str(REPOSITORY / "examples" / "spider"))
from gait import GaitError, Gaits  # noqa: E402
from search import RANGES, Search, score, speed_bound, world_of  # noqa: E402
from walking import Walker  # noqa: E402

WORLD, GAITS = roboss.example("spider.sdf"), REPOSITORY / "examples" / "spider" / "gaits"
PROGRAM = REPOSITORY / "build" / "release" / "lib" / "roboss_spider.so"
SLOW = 0.8 * np.pi  # rad/s, the joints of the paper


def world_with_motors(speed, torque=4):
    text = Path(WORLD).read_text(encoding="utf-8")
    return text.replace("<effort>4</effort><velocity>8</velocity>", f"<effort>{torque}</effort><velocity>{speed}</velocity>")


def test_a_search_walks_as_the_control_program_does(tmp_path, monkeypatch):
    close = 1e-5  # m, rad: the two round differently, and friction bounds agree to the tolerance of the solver
    gaits = Gaits()
    for name in ("walk", "rough"):
        monkeypatch.setenv("ROBOSS_SPIDER_GAIT", str(GAITS / f"{name}.toml"))
        (tmp_path / name).mkdir()
        journal = roboss.Journal(journal_of_run(WORLD, 1.5, tmp_path / name, clients=[str(PROGRAM)]))
        walker = Walker(WORLD, gaits)
        for _ in walker.steps(gaits.load(GAITS / f"{name}.toml"), 1.5):
            pass
        there = journal.at(1.5).robots("spider_0")
        assert there.pose[0, 0] > 0.1
        assert walker.spiders.pose == pytest.approx(there.pose, abs=close)
        assert walker.spiders.joint_position == pytest.approx(there.joint_position, abs=close)


def test_the_file_of_a_gait_gives_the_gait_back(tmp_path):
    gaits = Gaits()
    gait = np.round(gaits.default + 0.01 * np.arange(len(gaits.names)), 3)
    (tmp_path / "a.toml").write_text(gaits.text(gait, "two\nlines"))
    assert gaits.load(tmp_path / "a.toml") == pytest.approx(gait, rel=1e-4)


def test_the_fastest_gait_of_slow_joints_stays_below_what_any_posture_allows():
    gaits = Gaits()
    gait = gaits.load(GAITS / "slow_joints.toml")
    walk = Walker(world_with_motors(2.513), gaits).walk(gait, 4, 2)
    bound = speed_bound(gaits, SLOW, dict(zip(gaits.names, gait))["height"])
    assert 0.6 < walk.speed[0] < bound < 1.0  # m/s; the paper says 2
    assert not walk.fell[0] and walk.lean[0] < 0.1 and walk.joint_speed[0] < 1.03 * SLOW


@pytest.mark.parametrize("options", [{"angle": 30}, {"angle": 30, "terrain": "steps"}, {"height": 0.1},
                                     {"height": 0.1, "terrain": "slope"}])
def test_a_number_that_the_terrain_does_not_have_is_refused(options):
    with pytest.raises(GaitError, match="--terrain"):
        world_of(1, argparse.Namespace(**options))


def test_a_search_finds_a_faster_gait():
    pytest.importorskip("cma")
    options = argparse.Namespace(motor_speed=8.0, motor_torque=4.0, speed=None, start=None, spiders=8, generations=5, seconds=2.0, seed=0)
    search = Search(options)
    first = score(search.walker.walk(search.gaits.default, 2, 1), options)[0]
    gait, _ = search.run()
    assert score(search.walker.walk(gait, 2, 1), options)[0] > first + 0.05
    assert all(low <= gait[search.gaits.names.index(name)] <= high for name, (low, high) in RANGES.items())


def test_the_analyser_finds_what_its_walk_asks_of_the_motors(tmp_path):
    command("record", WORLD, "spider_0.pose", "spider_0.*.effort", "spider_0.*.velocity", "--client", PROGRAM, "--until", "2",
            "--every", "0.002", "-o", tmp_path / "spider.parquet", "--quiet")
    tables = json.loads(command("analyse", "walker", tmp_path / "spider.parquet", "--from", 1.4, "--json", "-o",
                                tmp_path / "spider.html"))["tables"]
    cost, = tables["Mechanical cost of transport"]
    assert cost["Speed [m/s]"] == pytest.approx(0.39, abs=0.02)
    assert 0 < cost["With recovery"] < cost["Cost"] < 1  # friction and servos take what the motors give
    joints = tables["Demand of each joint"]
    assert len(joints) == 18 and all(0.05 < row["rms [N m]"] < row["peak [N m]"] <= 4 for row in joints)
