"""roboss.randomize: distributions have their true statistics; a draw depends on its names and number and on nothing
else; what is drawn is in effect; what is refused changes nothing."""
import hashlib
import math
import pickle

import numpy as np
import pytest

import roboss
from roboss.randomize import (Randomizer, choice, joint, kick, latency, log_uniform, noise, normal, pick, push, stream,
                              uniform)

CARS = "crossroads.sdf"
BALLS = """<sdf version="1.9"><world name="balls"><gravity>0 0 -9.81</gravity>{}</world></sdf>"""
BALL = """<model name="ball_{}"><pose>0 {} 5 0 0 0</pose><link name="body">
  <inertial><mass>2</mass><inertia><ixx>.1</ixx><iyy>.1</iyy><izz>.1</izz></inertia></inertial></link></model>"""


def cars(threads=1):
    return roboss.Simulation(roboss.example(CARS), threads=threads).robots("car_*")


def balls(count=4):
    models = "".join(BALL.format(number, number) for number in range(count))
    return roboss.Simulation(roboss.load(BALLS.format(models))).robots("ball_*")


def farthest(values, probability):
    """Kolmogorov's distance of a sample from the distribution with this function."""
    values = np.sort(values)
    expected = probability(values)
    return max(np.abs(np.arange(1, len(values) + 1) / len(values) - expected).max(),
               np.abs(np.arange(len(values)) / len(values) - expected).max())


@pytest.fixture(scope="module")
def samples():
    """The draws of 16 cars with 4 joints in 160 episodes, by distribution: (episodes, 64)."""
    terms = [joint("damping", uniform(2, 4), name="uniform"),
             joint("damping", log_uniform(0.01, 10), name="log_uniform"),
             joint("damping", normal(3, 0.5), name="normal"),
             joint("damping", choice([1, 2, 5], [1, 0, 3]), name="choice")]
    randomizer, drawn = Randomizer(cars(), terms, seed=11), []
    for _ in range(160):
        randomizer.reset()
        drawn.append(randomizer.drawn)
    return {term.name: np.array([one[term.name].ravel() for one in drawn]) for term in terms}


@pytest.mark.parametrize("name, probability, mean, variance", [
    ("uniform", lambda x: (x - 2) / 2, 3, 1 / 3),
    ("log_uniform", lambda x: np.log(x / 0.01) / np.log(1000), 9.99 / math.log(1000),
     (100 - 1e-4) / (2 * math.log(1000)) - (9.99 / math.log(1000)) ** 2),
    ("normal", lambda x: np.array([0.5 * (1 + math.erf((one - 3) / math.sqrt(0.5))) for one in x]), 3, 0.25)])
def test_distributions_have_their_true_statistics(samples, name, probability, mean, variance):
    sample = samples[name].ravel()
    count = len(sample)
    assert farthest(sample, probability) < 1.63 / math.sqrt(count)                       # 1 in 100 samples is farther
    assert abs(sample.mean() - mean) < 3 * math.sqrt(variance / count)
    assert abs(sample.var() / variance - 1) < 0.05


def test_a_choice_has_its_weights(samples):
    sample = samples["choice"].ravel()
    assert set(sample) == {1, 5} and abs((sample == 5).mean() - 0.75) < 3 * math.sqrt(0.75 * 0.25 / len(sample))


def test_draws_of_robots_joints_and_episodes_are_independent(samples):
    sample = samples["uniform"]
    between = np.corrcoef(sample.T)[np.triu_indices(64, 1)]                              # 2016 pairs of 160
    assert abs(between.mean()) < 0.01 and abs(between.std() * math.sqrt(160) - 1) < 0.05
    after = np.corrcoef(sample[:-1].ravel(), sample[1:].ravel())[0, 1]
    assert abs(after) < 4 / math.sqrt(sample.size)


def test_bounds_hold_and_rows_have_their_own():
    randomizer = Randomizer(balls(), [kick(uniform([-1, 0, 2, 3, 0, 0], [1, 0, 4, 3, 0, 0]), when="reset"),
                                      push(normal(0, 10, -5, [5, 6, 7, 8, 9, 10]), when="reset")])
    kicks, pushes = [], []
    for _ in range(100):
        randomizer.reset()
        kicks.append(randomizer.drawn["kick"])
        pushes.append(randomizer.drawn["push"])
    low, high = np.min(kicks, axis=(0, 1)), np.max(kicks, axis=(0, 1))
    assert np.allclose(low, [-1, 0, 2, 3, 0, 0], atol=0.02) and np.allclose(high, [1, 0, 4, 3, 0, 0], atol=0.02)
    assert np.min(pushes) == -5 and np.array_equal(np.max(pushes, axis=(0, 1)), [5, 6, 7, 8, 9, 10])


def test_a_draw_is_that_of_the_documented_stream():
    randomizer = Randomizer(cars(), [joint("damping", uniform(0, 1)), kick(uniform(0, 1), when=(1, 2))], seed=5)
    for _ in range(20):
        randomizer.reset()
    key = int.from_bytes(hashlib.blake2b(b'[5, 0, "car_3", "joint_damping"]', digest_size=16).digest(), "little")
    numbers = np.random.Generator(np.random.Philox(key=key, counter=[0, 1, 0, 0])).random((16, 4))
    row = randomizer.robots.names.index("car_3")
    assert np.array_equal(randomizer.drawn["joint_damping"][row], numbers[3])            # draw 19 is row 3 of block 1
    assert stream(5, 0, "car_3", "joint_damping", 1).random() == numbers[0, 0]
    assert numbers[3, 0] == pytest.approx(0.5247823626020424, abs=1e-15)                 # in all versions


def test_another_number_or_order_of_robots_leaves_a_robots_draws_alone():
    terms = [joint("damping", uniform(0, 1)), joint("max_effort", normal(1, 0.1, low=0), "scale", shared=True)]
    whole, batch = cars(), roboss.Batch(roboss.example(CARS), 3, threads=1)

    def drawn_of(robots):
        randomizer = Randomizer(robots, terms, seed=2)
        for _ in range(3):
            randomizer.reset()
        return randomizer.drawn

    all_drawn, of_batch = drawn_of(whole), drawn_of(batch.robots(["car_9", "car_3"]))
    for rows in (slice(2, 9), [8, 2, 5]):
        for name, array in drawn_of(whole[rows]).items():
            assert np.array_equal(array, all_drawn[name][rows])
    places = [whole.names.index("car_9"), whole.names.index("car_3")]
    for name, array in of_batch.items():
        assert np.array_equal(array[0], all_drawn[name][places])
        assert not (array[0] == array[1]).any()                                          # each simulation its own


def test_a_larger_batch_leaves_the_first_simulations_alone():
    terms, world, found = [joint("friction", uniform(0, 0.01))], roboss.load(roboss.example(CARS)), []
    for count in (2, 5):
        batch = roboss.Batch(world, count, threads=1)
        randomizer = Randomizer(batch.robots("car_*"), terms, seed=3)
        randomizer.reset()
        assert np.array_equal(randomizer.drawn["joint_friction"], batch.robots("car_*").parameters["friction"])
        found.append(([sim.state_hash for sim in batch], randomizer.drawn["joint_friction"]))
    assert found[0][0] == found[1][0][:2] and np.array_equal(found[0][1], found[1][1][:2])


def test_others_that_draw_more_often_leave_a_robots_draws_alone():
    terms = [joint("damping", uniform(0, 1)), kick(uniform(-1, 1), when=(0.5, 1)), noise(normal(0, 1))]
    alone, among = [Randomizer(cars(), terms, seed=4, observation_columns=3) for _ in range(2)]
    first = np.arange(16) == 0
    alone.reset()
    among.reset()
    for step in range(40):
        for randomizer in (alone, among):
            randomizer.update()
            randomizer.robots.simulation.step(25)
        if step % 3 == 0:
            among.reset(~first)
    for name in alone.drawn:
        assert np.array_equal(alone.drawn[name][0], among.drawn[name][0])
        assert not np.array_equal(alone.drawn[name][1], among.drawn[name][1])


def test_intervals_do_not_depend_on_the_length_of_steps():
    found = []
    for ticks in (1, 4, 25):
        randomizer = Randomizer(balls(), [kick(uniform(-1, 1), when=(0.05, 0.3))], seed=6)
        randomizer.reset()
        for _ in range(500 // ticks):
            randomizer.update()
            randomizer.robots.simulation.step(ticks)
        randomizer.update()
        found.append((randomizer.save().draws, randomizer.save().due, randomizer.drawn["kick"]))
    for draws, due, drawn in found[1:]:
        assert all(map(np.array_equal, (draws, due, drawn), found[0]))
    simulated, count = randomizer.robots.simulation.time, draws + 1
    assert ((simulated / 0.3 - 1 <= count) & (count <= simulated / 0.05)).all()


def test_the_same_seed_gives_the_same_state_hashes():
    terms = [joint("damping", uniform(0.5, 2), "scale"),
             joint("damping", uniform(0, 0.01), "add", name="more", when=(0.2, 0.4)),
             joint("friction", uniform(0, 0.01), when="start"), kick(normal(0, 0.2), when=(0.1, 0.5)),
             push(uniform(-5, 5), when=(0.1, 0.5), duration=0.05), latency(choice([0, 1, 2]))]
    hashes = []
    for seed, threads in ((1, 1), (1, 2), (2, 1)):
        randomizer = Randomizer(cars(threads), terms, seed=seed)
        randomizer.reset()
        for step in range(30):
            randomizer.update()
            randomizer.robots.set_joint_targets(randomizer.delayed(np.full((16, 4), 0.2 * step)))
            randomizer.robots.simulation.step(25)
            if step == 15:
                randomizer.reset(np.arange(16) % 3 == 0)
        hashes.append(randomizer.robots.simulation.state_hash)
    assert hashes[0] == hashes[1] and hashes[0] != hashes[2]


def test_operations_are_relative_to_the_file_and_apply_in_order():
    robots = cars()
    randomizer = Randomizer(robots, [
        joint("max_effort", uniform(0.5, 2), "scale", shared=True),
        joint("max_effort", uniform(0, 3), "add", joints="front_*", name="more"),
        joint("damping", choice([0.25]), joints=["rear_left"])])
    of_file, own = robots.parameters.of_file("max_effort"), robots.parameters["damping"].copy()
    for _ in range(3):                                                                   # nothing piles up
        randomizer.reset()
        factor, more = randomizer.drawn["joint_max_effort"], randomizer.drawn["more"]
        wanted = of_file * factor
        wanted[:, :2] += more
        assert np.array_equal(robots.parameters["max_effort"], wanted) and (factor == factor[:, :1]).all()
        assert (robots.parameters["damping"][:, 2] == 0.25).all()
        assert np.array_equal(robots.parameters["damping"][:, [0, 1, 3]], own[:, [0, 1, 3]])
    assert randomizer.columns("more") == ("front_left", "front_right") and randomizer.units("more") == ("N m",) * 2
    assert randomizer.units("joint_max_effort") == ("1",) * 4 and randomizer.units("joint_damping") == ("N m s/rad",)


def test_start_stays_reset_changes_and_a_reset_of_the_simulation_is_made_good():
    robots = cars()
    terms = [joint("damping", uniform(0, 1), when="start"), joint("friction", uniform(0, 1))]
    randomizer = Randomizer(robots, terms, seed=1)
    assert np.isnan(randomizer.drawn["joint_damping"]).all() and not randomizer.begun
    randomizer.reset()
    first = randomizer.drawn
    robots.simulation.reset()
    assert not np.array_equal(robots.parameters["damping"], first["joint_damping"])
    randomizer.reset()
    assert np.array_equal(robots.parameters["damping"], first["joint_damping"])
    assert not (robots.parameters["friction"] == first["joint_friction"]).any()
    randomizer.reseed(1)
    randomizer.reset()
    assert np.array_equal(robots.parameters["friction"], first["joint_friction"])
    once = Randomizer(robots, [joint("damping", uniform(0, 1), when="start")])
    for _ in range(2):
        robots.simulation.reset()
        once.reset()
        assert np.array_equal(robots.parameters["damping"], once.drawn["joint_damping"])


def test_a_reset_of_some_leaves_the_others_alone():
    batch = roboss.Batch(roboss.example(CARS), 3, threads=1)
    robots = batch.robots("car_*")
    randomizer = Randomizer(robots, [joint("damping", uniform(0, 1))])
    randomizer.reset()
    before = robots.parameters["damping"]
    for chosen in (np.array([False, True, False]), np.arange(48).reshape(3, 16) % 5 == 0):
        hashes = [sim.state_hash for sim in batch]
        randomizer.reset(chosen)
        now = robots.parameters["damping"]
        rows = np.broadcast_to(chosen.reshape(3, -1), (3, 16))
        assert ((now != before).all(axis=2) == rows).all() and np.array_equal(now, randomizer.drawn["joint_damping"])
        assert [sim.state_hash != one for sim, one in zip(batch, hashes)] == rows.any(axis=1).tolist()
        before = now


def test_a_kick_adds_its_velocity_and_a_push_its_momentum():
    robots = balls()
    terms = [kick(uniform(-1, 1), when="reset"), push(uniform(-30, 30), when=0.1, duration=0.05)]
    randomizer = Randomizer(robots, terms)
    dt = robots.simulation.dt
    robots.twist = [0, 0, 3, 0, 0, 0]
    randomizer.reset()
    kicked = robots.twist.copy()
    assert np.allclose(kicked, randomizer.drawn["kick"] + [0, 0, 3, 0, 0, 0], atol=1e-14)
    robots.twist = 0
    ticks = round(0.1 / dt)
    robots.simulation.step(ticks - 1)
    randomizer.update()
    assert np.isnan(randomizer.drawn["push"]).all()
    robots.simulation.step(1)
    randomizer.update()
    wrench, before = randomizer.drawn["push"], robots.twist.copy()
    robots.simulation.step(ticks)
    falls = -9.81 * ticks * dt
    assert np.allclose((robots.twist - before)[:, :3], wrench[:, :3] * 0.05 / 2 + [0, 0, falls], atol=1e-6)
    assert randomizer.units("push")[2:4] == ("N", "N m") and randomizer.columns("kick")[5] == "angular_z"


def test_latency_delays_each_robot_by_its_own():
    randomizer = Randomizer(cars(), [latency(choice([0, 1, 3]))], seed=1)
    randomizer.reset()
    steps = randomizer.drawn["latency"][:, 0].astype(int)
    assert set(steps) == {0, 1, 3}
    for number in range(1, 8):
        randomizer.update()
        given = number + np.arange(32).reshape(16, 2) / 100
        expected = np.where(number - steps[:, None] >= 1, given - steps[:, None], 0)
        assert np.allclose(randomizer.delayed(given), expected, atol=1e-12)
    again = np.arange(16) % 2 == 0
    randomizer.reset(again)
    late, later = randomizer.drawn["latency"][:, 0] > 0, randomizer.delayed(np.full((16, 2), 9.0))
    assert (again & late).any() and not later[again & late].any() and (later[~(again & late)] > 3).all()


def test_noise_is_new_at_each_step_and_a_bias_stays():
    terms = [noise(normal(0, 0.1), columns=[0, 2]), noise(uniform(-1, 1), when="reset", name="bias")]
    randomizer = Randomizer(cars(), terms, observation_columns=3)
    randomizer.reset()
    seen = []
    for _ in range(200):
        randomizer.update()
        zeros = np.zeros((16, 3), dtype=np.float32)
        noisy = randomizer.noisy(zeros)
        assert noisy.dtype == np.float32 and not zeros.any() and np.array_equal(noisy, randomizer.noisy(zeros))
        seen.append(noisy - randomizer.drawn["bias"])
    seen = np.array(seen)
    assert np.abs(seen[:, :, 1]).max() < 1e-6
    assert abs(seen[:, :, [0, 2]].std() / 0.1 - 1) < 0.03 and abs(seen[:, :, [0, 2]].mean()) < 3 * 0.1 / math.sqrt(6400)
    assert randomizer.columns("noise") == ("observation[0]", "observation[2]")


def test_members_of_a_batch_with_different_terrains():
    levels = roboss.terrain.curriculum(
        lambda builder, hard: roboss.terrain.rough(builder, "rubble", start=[1, 0, 0], height=0.1 * hard + 0.01),
        [0, 1], [("car", roboss.example("models/car/model.sdf"), [0, 0, 0.1])])
    worlds = pick(levels, 6, seed=1)
    assert worlds[:4] == pick(levels, 4, seed=1) and {world.name for world in worlds} == {"level_0", "level_1"}
    assert abs(pick([0, 1], 4000, seed=2, weights=[1, 3]).count(1) / 4000 - 0.75) < 0.03
    robots = roboss.Batch(worlds, threads=1).robots("car", padded=True)
    randomizer = Randomizer(robots, [joint("damping", uniform(0, 1)), kick(uniform(-1, 1), when="reset")], seed=1)
    randomizer.reset()
    assert randomizer.drawn["joint_damping"].shape == (6, 1, 4)
    for member, drawn in zip(robots.members, randomizer.drawn["joint_damping"]):
        assert np.array_equal(member.parameters["damping"], drawn)
    assert np.allclose(robots.twist, randomizer.drawn["kick"])


def test_padded_rows_without_a_robot_are_empty():
    worlds = [roboss.load(roboss.example(name)) for name in ("crossroads.sdf", "city.sdf")]
    robots = roboss.Batch(worlds, threads=1).robots("car_*", padded=True)
    randomizer = Randomizer(robots, [joint("damping", uniform(0, 1)), latency(choice([1]))])
    randomizer.reset()
    drawn = randomizer.drawn["joint_damping"]
    assert drawn.shape == (2, 50, 4) and np.array_equal(np.isnan(drawn[..., 0]), ~robots.mask)
    actions = np.ones((2, 50, 4))
    assert not randomizer.delayed(actions)[robots.mask].any() and randomizer.delayed(2 * actions)[robots.mask].all()
    alone = Randomizer(roboss.Simulation(worlds[0], threads=1).robots("car_*"), [joint("damping", uniform(0, 1))])
    alone.reset()
    assert np.array_equal(alone.drawn["joint_damping"], drawn[0, :16])


def test_saves_and_pickles_continue_with_the_same_bits():
    terms = [joint("damping", uniform(0, 0.1), when=(0.1, 0.2)), kick(uniform(-1, 1), when=(0.1, 0.3)),
             latency(choice([0, 2])), noise(normal(0, 1))]
    randomizer = Randomizer(cars(), terms, seed=8, observation_columns=2)
    randomizer.reset()

    def run(one, steps=20):
        seen = []
        for step in range(steps):
            one.update()
            one.robots.set_joint_targets(one.delayed(np.full((16, 4), float(step))))
            one.robots.simulation.step(25)
            seen.append(one.noisy(np.zeros((16, 2))))
        return one.robots.simulation.state_hash, np.array(seen), one.drawn

    run(randomizer)
    sim = randomizer.robots.simulation
    saves = pickle.loads(pickle.dumps((sim.save(), randomizer.save())))
    twin = pickle.loads(pickle.dumps(randomizer))
    assert len(pickle.dumps(randomizer.save())) < 10_000
    first = run(randomizer)
    other = Randomizer(cars(), terms, seed=99, observation_columns=2)                    # another process
    other.robots.simulation.restore(saves[0])
    other.restore(saves[1])
    for one in (twin, other):
        found = run(one)
        assert found[0] == first[0] and np.array_equal(found[1], first[1])
        assert all(np.array_equal(found[2][name], first[2][name], equal_nan=True) for name in first[2])
    with pytest.raises(roboss.SaveError) as refused:
        Randomizer(cars(), terms[:1]).restore(saves[1])
    assert refused.value.code == "other-randomizer"


@pytest.mark.parametrize("make, error, code", [
    (lambda: uniform(2, 1), roboss.ArgumentError, "bad-distribution"),
    (lambda: uniform(0, np.inf), roboss.ArgumentError, "bad-distribution"),
    (lambda: uniform([0, 1], [1, 2, 3]), roboss.ArgumentError, "bad-distribution"),
    (lambda: uniform(np.nan, 1), roboss.ArgumentError, "bad-distribution"),
    (lambda: log_uniform(0, 1), roboss.ArgumentError, "bad-distribution"),
    (lambda: normal(0, -1), roboss.ArgumentError, "bad-distribution"),
    (lambda: normal(0, 1, 2, 1), roboss.ArgumentError, "bad-distribution"),
    (lambda: choice([]), roboss.ArgumentError, "bad-distribution"),
    (lambda: choice([1, 2], [1, -1]), roboss.ArgumentError, "bad-distribution"),
    (lambda: choice([1, 2], [0, 0]), roboss.ArgumentError, "bad-distribution"),
    (lambda: choice(["a"]), roboss.ArgumentError, "bad-shape"),
    (lambda: joint("damping", 0.5), roboss.ArgumentError, "bad-type"),
    (lambda: joint("damping", uniform(-0.1, 1), "scale"), roboss.ArgumentError, "negative-scale"),
    (lambda: joint("damping", normal(1, 0.1), "scale"), roboss.ArgumentError, "negative-scale"),
    (lambda: joint("damping", uniform(0, 1), "divide"), roboss.UnknownNameError, "unknown-name"),
    (lambda: joint("damping", uniform(0, 1), when="sometimes"), roboss.UnknownNameError, "unknown-name"),
    (lambda: joint("damping", uniform(0, 1), when=(3, 2)), roboss.ArgumentError, "bad-interval"),
    (lambda: joint("damping", uniform(0, 1), joints=[]), roboss.ArgumentError, "no-part"),
    (lambda: kick(uniform(0, 1), when=0), roboss.ArgumentError, "bad-interval"),
    (lambda: kick(uniform(0, 1), when="step"), roboss.ArgumentError, "bad-interval"),
    (lambda: push(uniform(0, 1), duration=0), roboss.ArgumentError, "bad-value"),
    (lambda: latency(uniform(-1, 1)), roboss.ArgumentError, "bad-latency"),
    (lambda: latency(normal(1, 1, low=0)), roboss.ArgumentError, "bad-latency"),
    (lambda: noise(normal(0, 1), columns=[1, 1]), roboss.ArgumentError, "bad-column"),
    (lambda: pick([], 3), roboss.ArgumentError, "no-items")])
def test_terms_that_cannot_be_are_refused_at_the_call(make, error, code):
    with pytest.raises(error) as refused:
        make()
    assert refused.value.code == code and (refused.value.remedy or code in ("unknown-name", "bad-shape"))


@pytest.mark.parametrize("terms, error, code", [
    ([joint("dampin", uniform(0, 1))], roboss.UnknownNameError, "unknown-name"),
    ([joint("damping", uniform(0, 1), joints=["front_left", "rudder"])], roboss.UnknownNameError, "unknown-name"),
    ([joint("damping", uniform([0, 0], [1, 1]))], roboss.ArgumentError, "wrong-count"),
    ([joint("damping", uniform(0, 1)), joint("damping", uniform(0, 1))], roboss.ArgumentError, "name-taken"),
    ([kick(uniform(0, 1), name="a/when")], roboss.ArgumentError, "name-taken"),
    ([kick(uniform([0, 0, 0], 1))], roboss.ArgumentError, "wrong-count"),
    ([push(uniform(0, 1), link="keel")], roboss.UnknownNameError, "unknown-name"),
    ([noise(normal(0, 1))], roboss.ArgumentError, "no-observation"),
    (["damping"], roboss.ArgumentError, "bad-type")])
def test_terms_that_do_not_fit_the_robots_are_refused(terms, error, code):
    robots = cars()
    before = robots.simulation.state_hash
    with pytest.raises(error) as refused:
        Randomizer(robots, terms)
    assert refused.value.code == code and robots.simulation.state_hash == before


def test_wrong_calls_tell_what_to_do():
    robots = cars()
    randomizer = Randomizer(robots, [noise(normal(0, 1)), latency(choice([1]))], observation_columns=3)
    for call in (randomizer.update, lambda: randomizer.noisy(np.zeros((16, 3))),
                 lambda: randomizer.delayed(np.zeros((16, 4)))):
        with pytest.raises(roboss.StateError) as refused:
            call()
        assert refused.value.code == "not-reset"
    randomizer.reset()
    for agents in ([0, 1], np.ones(3, dtype=bool), np.ones((16, 1), dtype=bool)):
        with pytest.raises(roboss.ArgumentError) as refused:
            randomizer.reset(agents)
        assert refused.value.code == "bad-mask"
    for call in (lambda: randomizer.noisy(np.zeros((16, 2))), lambda: randomizer.noisy(np.zeros(16)),
                 lambda: randomizer.delayed(np.zeros((4, 4)))):
        with pytest.raises(roboss.ArgumentError) as refused:
            call()
        assert refused.value.code == "bad-shape"
    with pytest.raises(roboss.ArgumentError):
        Randomizer(robots.simulation, [])
    with pytest.raises(roboss.ArgumentError):
        Randomizer(robots[[1, 1]], [])
    robots.simulation.remove("car_1")
    with pytest.raises(roboss.StateError) as refused:
        Randomizer(robots, [joint("damping", uniform(0, 1))]).reset()
    assert refused.value.code == "changed-world"


def test_numbers_that_a_robot_refuses_change_nothing():
    batch = roboss.Batch(roboss.example(CARS), 3, threads=1)
    robots = batch.robots("car_*")
    terms = [joint("friction", uniform(0, 0.1)), kick(uniform(0, 1), when="reset"),
             joint("damping", normal(0.3, 0.1), when=(0.1, 0.2))]
    randomizer = Randomizer(robots, terms, seed=3)
    refused = failed = 0
    for _ in range(20):
        before, drawn, save = [sim.state_hash for sim in batch], randomizer.drawn, randomizer.save()
        try:
            randomizer.reset()
        except roboss.OrderError as error:
            refused += error.code == "bad-parameter"
            assert [sim.state_hash for sim in batch] == before
            now = randomizer.save()
            assert all(map(np.array_equal, (now.draws, now.waits, now.due, now.begun),
                           (save.draws, save.waits, save.due, save.begun)))
            assert all(np.array_equal(randomizer.drawn[name], drawn[name], equal_nan=True) for name in drawn)
            failed += 1
            randomizer.reseed(10 + failed)
        else:
            assert (robots.parameters["damping"] >= 0).all()
    assert refused == failed > 0 and failed < 20


def test_a_fixed_base_takes_no_kick():
    arm = roboss.Simulation(roboss.example("arm.sdf")).robots("arm")
    before = arm.simulation.state_hash
    randomizer = Randomizer(arm, [joint("damping", uniform(1, 2)), kick(uniform(0.5, 1), when="reset")])
    with pytest.raises(roboss.OrderError):
        randomizer.reset()
    assert arm.simulation.state_hash == before and not randomizer.begun
