"""Recordings of `roboss run`, at any time and to the last bit."""
import json
import subprocess

import numpy as np
import pytest

import roboss
from conftest import REPOSITORY, ROBOSS, analysis_command
from roboss.analysis import record_file
from roboss.outputs import check_output

WORLD = [REPOSITORY / "worlds/crossroads.sdf", "--orders", REPOSITORY / "worlds/crossroads.jsonl"]


def run(*arguments):
    """The JSON summary of `roboss run`."""
    command = [ROBOSS, "run", *arguments, "--headless", "--json", "-"]
    return json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """A journal of 2.3 s with checkpoints, and the hash at its end."""
    path = tmp_path_factory.mktemp("journal") / "crossroads.journal"
    summary = run(*WORLD, "--duration", "2.3", "--journal", path)
    return path, summary["state_hash"]


def test_is_at_any_time_as_the_run_was(recorded):
    path, last = recorded
    journal = roboss.Journal(path)
    assert journal.times() == (0, pytest.approx(2.3))
    assert journal.branches[-1].last_hash == last and journal.at(2.3).state_hash == last
    for time in (0, 1.1):
        assert journal.at(time, threads=2).state_hash == run(*WORLD, "--duration", str(time))["state_hash"]
    for tick, state_hash in journal.checkpoints():
        assert journal.at(tick * journal.world().dt).state_hash == state_hash


def test_follows_the_recording_or_goes_its_own_way(recorded):
    path, last = recorded
    journal = roboss.Journal(path)
    sim = journal.at(0.5)
    sim.step(1150 - sim.tick)
    assert sim.state_hash == last
    free = journal.at(0.5, follow=False)
    free.step(1150 - free.tick)
    assert free.state_hash != last


def test_plays_through_times(recorded):
    journal = roboss.Journal(recorded[0])
    heights = np.array([sim.robots("car_*").pose[:, 2].copy() for sim in journal.play(np.arange(0, 2.3, 0.5))])
    assert heights.shape == (5, 16)
    assert np.array_equal(heights[3], journal.at(1.5).robots("car_*").pose[:, 2])


def test_errors_name_file_and_time(recorded, tmp_path):
    journal = roboss.Journal(recorded[0])
    for call, code in ((lambda: journal.at(3), "no-such-time"), (lambda: journal.at(1, branch=9), "no-branch")):
        with pytest.raises(roboss.JournalError) as error:
            call()
        assert error.value.code == code and str(recorded[0]) in str(error.value)
    (tmp_path / "no.journal").write_text("no journal")
    for name in ("no.journal", "missing.journal"):
        with pytest.raises(roboss.JournalError, match=name):
            roboss.Journal(tmp_path / name)


def test_goes_through_branches_with_the_robots_of_then(branched):
    journal = roboss.Journal(branched)
    assert [number for number, _, _ in journal.lineage()] == [1, 2, 3]
    assert journal.times() == (0, pytest.approx(1.0))
    assert "car_3" in journal.at(0.2).world.robots and "car_3" not in journal.at(0.4).world.robots
    counts = [len(sim.world.robots) for sim in journal.play(np.arange(0, 1.01, 0.1))]
    assert counts == [counts[0]] * 4 + [counts[0] - 1] * 7
    sim = journal.at(0.1)
    before = sim.robots("car_*")
    sim.step(500 - sim.tick)
    assert sim.state_hash == journal.branches[-1].last_hash and "car_3" not in sim.world.robots
    with pytest.raises(roboss.StateError) as error:
        before.pose
    assert error.value.code == "changed-world"


def test_refuses_what_the_branch_does_not_have_and_names_who_does(branched):
    journal = roboss.Journal(branched)
    with pytest.raises(roboss.JournalError) as error:
        journal.at(0.9, branch=2)
    assert error.value.code == "no-such-time" and "branch 3 has it" in str(error.value)
    sim = journal.at(0.3)
    sim.robots("car_1").twist = np.array([[0, 0, 3.0, 0, 0, 0]])
    with pytest.raises(roboss.StateError) as error:
        sim.step(300)
    assert error.value.code == "own-way"


def test_commands_take_the_branch_that_a_remedy_names(tmp_path):
    journal = tmp_path / "two.journal"
    run(*WORLD, "--duration", "0.3", "--journal", journal)
    run(*WORLD, "--from", f"{journal}@0.1", "--journal", journal, "--duration", "0.1")
    table, picture, page = (tmp_path / name for name in ("run.csv", "plot.png", "report.html"))
    words = {"record": ["car_3.pose", "-o", str(table)], "plot": ["car_3.z", "-o", str(picture)],
             "analyse": ["--robot", "car_3", "-o", str(page)]}
    for command, more in words.items():
        start = [command, "walker"] if command == "analyse" else [command]
        ended, _, errors = analysis_command(*start, str(journal), *more, "--until", "0.28")
        place = f"{journal}#1@0.28"
        assert ended == 1 and "[no-such-time]" in errors and f"branch 1 has it: {place}" in errors
        for source, options in ((place, []), (f"{journal}#1", ["--until", "0.28"]), (str(journal), ["--branch", "1", "--until", "0.28"])):
            ended, _, errors = analysis_command(*start, source, *more, *options)
            assert ended == 0, (source, errors)
        ended, _, errors = analysis_command(*start, place, *more, "--branch", "2")
        assert ended == 1 and "[bad-value]" in errors
    assert record_file(f"{journal}#1@0.28", table, "car_3.x").last == pytest.approx(0.28)
    assert record_file(f"{journal}#2", table, "car_3.x").last == pytest.approx(0.2)
    with pytest.raises(roboss.JournalError) as error:
        record_file(f"{journal}#7", table, "car_3.x")
    assert error.value.code == "no-branch"
    other = tmp_path / "a#1.csv"
    record_file(f"{journal}#2", other, "car_3.x")
    assert roboss.analysis.record(other, "car_3.x").time[-1] == pytest.approx(0.2)  # a file by its whole name
    with pytest.raises(roboss.ArgumentError) as error:
        record_file(f"{tmp_path}/none.journal#1", table, "car_3.x")
    assert error.value.code == "no-file"


def test_a_step_that_is_too_long_is_not_told_to_be_above_0():
    sim = roboss.Simulation(roboss.load(WORLD[0]))
    for ticks, remedy in ((2**70, f"give 0 to {2**63 - 1}"), (-1, "give 0 or more")):
        with pytest.raises(roboss.ArgumentError) as error:
            sim.step(ticks)
        assert error.value.remedy == remedy and sim.tick == 0


def test_tables_and_recordings_replace_older_ones_only(tmp_path):
    world = tmp_path / "world.sdf"
    roboss.WorldBuilder("w").save(world)
    for name in ("run.csv", "run.parquet", "run.mcap", "plot.svg", "plot.png", "page.html"):
        path, kind = tmp_path / name, name.rpartition(".")[2]
        for text in ("hi", "time_s,robot,link,x\n0,a,b,1\n", "time,a.x\n0,1\n", world.read_text()):
            path.write_text(text)
            with pytest.raises(roboss.ArgumentError) as error:
                check_output(path)
            assert error.value.code == "other-kind" and path.read_text() == text, kind
        path.write_text("")
        check_output(path, reads=[world])
    (tmp_path / "bag").mkdir()
    (tmp_path / "data").write_text("1")
    for name in ("bag", "data"):
        with pytest.raises(roboss.ArgumentError) as error:
            check_output(tmp_path / name)
        assert error.value.code == "output-exists"
    check_output(tmp_path / "new")


def test_a_recorded_table_replaces_no_other_table(tmp_path):
    table = tmp_path / "my.csv"
    for text in ("hi", "name,mass\narm,3\n", "time_s,robot,link,x,y,z\n0,arm,base,0,0,0\n"):
        table.write_text(text)
        with pytest.raises(roboss.ArgumentError) as error:
            record_file(WORLD[0], table, "*.z", until=0.01)
        assert error.value.code == "other-kind" and table.read_text() == text
    table.unlink()
    for _ in range(2):
        assert record_file(WORLD[0], table, "*.z", until=0.01).samples == 2


def test_outputs_replace_nothing_else(tmp_path):
    notes = tmp_path / "notes.html"
    notes.write_text("remember")
    world = tmp_path / "world.sdf"
    roboss.WorldBuilder("w").save(world)
    roboss.WorldBuilder("w").save(world)  # an older one of the same kind
    with pytest.raises(roboss.ArgumentError) as error:
        roboss.WorldBuilder("w").save(notes)
    assert error.value.code == "other-kind" and notes.read_text() == "remember"
    (tmp_path / "link.png").symlink_to(world)
    with pytest.raises(roboss.ArgumentError) as error:
        check_output(tmp_path / "link.png", reads=[world])
    assert error.value.code == "output-is-input"
