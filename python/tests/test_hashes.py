"""The same bits as `roboss run`, for any number of threads and any length of a step."""
import pytest

import roboss
from conftest import REPOSITORY, OrderFile, golden_runs

RUNS = golden_runs()


def final_hash(run, threads, part):
    world = roboss.load(str(REPOSITORY / run.world), precision=run.precision, accuracy=run.accuracy)
    sim = roboss.Simulation(world, threads=threads)
    end = round(run.duration / sim.dt)
    if run.orders:
        OrderFile(REPOSITORY / run.orders, sim).run(end, part)
    else:
        while sim.tick < end:
            sim.step(min(part, end - sim.tick))
    return sim.state_hash


def test_the_list_is_read():
    assert len(RUNS) >= 14


@pytest.mark.filterwarnings("ignore::roboss.WorldWarning")
@pytest.mark.parametrize("run", RUNS, ids=str)
def test_gives_the_hash_of_roboss_run(run):
    assert final_hash(run, threads=1, part=1_000_000) == run.hash


@pytest.mark.filterwarnings("ignore::roboss.WorldWarning")
@pytest.mark.parametrize("threads, part", [(2, 1), (3, 37)])
@pytest.mark.parametrize("run", [run for run in RUNS if "crossroads" in run.world or "drives" in run.world], ids=str)
def test_threads_and_calls_change_no_bit(run, threads, part):
    assert final_hash(run, threads, part) == run.hash
