"""Terrain: cubes that fall on it rest at the height that it says; a curriculum is a batch; lengths that cannot be are refused."""
import numpy as np
import pytest

import roboss
from test_errors import refused

MAKERS = {
    "stairs": lambda builder: roboss.terrain.stairs(builder, "t", start=[1, 0.5, 0.2], steps=4, rise=0.15, run=0.5),
    "down": lambda builder: roboss.terrain.stairs(builder, "t", start=[1, 0, 1], steps=4, rise=-0.15, run=0.5),
    "gaps": lambda builder: roboss.terrain.gaps(builder, "t", start=[1, -0.5, 0], count=3, gap=0.3, stone=0.5),
    "rough": lambda builder: roboss.terrain.rough(builder, "t", start=[1, 0, 0], cell=0.5, height=0.2, seed=2, width=1),
}


@pytest.mark.parametrize("maker", MAKERS)
def test_cubes_rest_at_the_heights_that_it_says(maker):
    builder = roboss.WorldBuilder("w")
    builder.ground()
    terrain = MAKERS[maker](builder)
    middles = np.stack([terrain.blocks[:, :2].mean(axis=1), terrain.blocks[:, 2:4].mean(axis=1)], axis=1)[::2]
    heights = terrain.height_at(*middles.T)
    assert np.isfinite(heights).all() and np.array_equal(heights, terrain.blocks[::2, 4])
    for number, (place, height) in enumerate(zip(middles, heights)):
        builder.box(f"cube_{number}", [0.1, 0.1, 0.1], mass=1, pose=[*place, height + 0.06])
    sim = roboss.Simulation(builder.build())
    sim.step(400)
    assert np.allclose(sim.robots("cube_*").pose[:, 2] - 0.05, heights, atol=2e-3)


def test_heights_beside_it_are_not_numbers():
    terrain = MAKERS["gaps"](roboss.WorldBuilder("w"))
    assert np.isnan(terrain.height_at([1.65, 0.9, 1.2], [-0.5, -0.5, 5])).all()  # in a gap, before it, beside it
    assert terrain.height_at(1.2, -0.5) == 0.3 and terrain.end == pytest.approx((1 + 3 * 0.8 + 0.5, -0.5, 0))


def test_one_begins_where_the_other_ends_and_a_seed_repeats():
    builder = roboss.WorldBuilder("w")
    first = roboss.terrain.stairs(builder, "up", steps=3, rise=0.1, run=0.3)
    second = roboss.terrain.rough(builder, "rough", start=first.end, seed=5)
    assert second.blocks[:, 0].min() == first.end[0] == pytest.approx(1.9) and (second.blocks[:, 4] >= 0.3 - 1e-12).all()
    again = roboss.terrain.rough(roboss.WorldBuilder("w"), "rough", start=first.end, seed=5)
    other = roboss.terrain.rough(roboss.WorldBuilder("w"), "rough", start=first.end, seed=6)
    assert np.array_equal(second.blocks, again.blocks) and not np.array_equal(second.blocks, other.blocks)


def test_a_curriculum_is_a_batch_of_worlds():
    worlds = roboss.terrain.curriculum(
        lambda builder, hard: roboss.terrain.stairs(builder, "stairs", start=[1, 0, 0], steps=1 + round(4 * hard)),
        [0, 0.5, 1], [("car", roboss.example("models/car/model.sdf"), [0, 0, 0.1])])
    assert [len(world.scenery) for world in worlds] == [3, 5, 7]
    batch = roboss.Batch(worlds)
    cars = batch.robots("car", padded=True)
    batch.step(100)
    assert cars.pose.shape == (3, 1, 7) and len({world.hash for world in worlds}) == 3


def test_lengths_that_cannot_be_are_refused():
    for make in (lambda: roboss.terrain.stairs(roboss.WorldBuilder("w"), "t", run=0),
                 lambda: roboss.terrain.gaps(roboss.WorldBuilder("w"), "t", height=-1),
                 lambda: roboss.terrain.stairs(roboss.WorldBuilder("w"), "t", width=np.nan)):
        with pytest.raises(roboss.ArgumentError) as error:
            make()
        refused(error, "bad-terrain", "'t'")
    for wrong in ({"cell": 0}, {"height": -1}, {"seed": -1}, {"start": [0, 0]}):
        with pytest.raises(roboss.ArgumentError):
            roboss.terrain.rough(roboss.WorldBuilder("w"), "t", **wrong)
