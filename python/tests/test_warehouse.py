"""The warehouse: ways through the hall, fetching and delivering, charging, collisions, exact resets."""
import gymnasium
import numpy as np
import pytest
from pettingzoo.test import parallel_api_test, parallel_seed_test

import roboss
from roboss import envs
from roboss.envs.warehouse_hall import DOOR_M, Hall


def alone(**options):
    """An environment with one carrier, which was reset."""
    env = envs.WarehouseVectorEnv(num_envs=1, threads=1, **options)
    env.reset(seed=3)
    return env


def put(env, x, y, yaw=0.0):
    """The first carrier stands there."""
    env.task._robots_of[0][0].pose = [x, y, 0, 0, 0, np.sin(yaw / 2), np.cos(yaw / 2)]
    env.task._measure_ways()


def test_pettingzoo_accepts_the_environment():
    parallel_api_test(envs.WarehouseParallelEnv(carriers=4, threads=1, episode_s=3), num_cycles=100)
    parallel_seed_test(lambda: envs.WarehouseParallelEnv(carriers=4, threads=1), num_cycles=20)


def test_ways_lead_around_the_racks_and_are_not_much_longer_than_they_must_be():
    """Against Dijkstra's algorithm on a fine grid of the free floor, whose ways are at most 8.3 % too long."""
    hall = Hall(6)
    cell, reach = 0.1, 6.0
    xs, ys = (np.arange(-half, half + cell / 2, cell) for half in (hall.half_length, reach))
    free = np.ones((len(xs), len(ys)), bool)
    for (x, y, _), (length, width, _) in hall._solids():
        inside = (np.abs(xs - x) < length / 2)[:, None] & (np.abs(ys - y) < width / 2)
        free &= ~inside
    rng = np.random.default_rng(4)
    places = np.concatenate([hall.slots, hall.stations, hall.bays, hall.starts[:, :2]])
    goals = places[rng.integers(len(places), size=4)]
    for goal in goals:
        least = shortest(free, tuple(np.argmin(np.abs(axis - value)) for axis, value in zip((xs, ys), goal)), cell)
        ways, points = hall.ways(places, np.tile(goal, (len(places), 1)))
        grid = np.array([least[np.argmin(np.abs(xs - x)), np.argmin(np.abs(ys - y))] for x, y in places])
        assert (ways > grid / 1.083 - 0.3).all()          # no way leads through a rack
        assert (ways < grid + 5).all()                    # to keep right and clear of corners takes a little more
        assert (np.abs(points[:, 1]) <= np.maximum(np.abs(places[:, 1]), np.maximum(abs(goal[1]), DOOR_M))).all()


def shortest(free, start, cell):
    """Lengths of the ways of a king on the free cells, m."""
    import heapq
    least = np.full(free.shape, np.inf)
    least[start] = 0
    queue = [(0.0, start)]
    while queue:
        length, (i, j) = heapq.heappop(queue)
        if length > least[i, j]:
            continue
        for di in (-1, 0, 1):
            for dj in (-1, 0, 1):
                near, way = (i + di, j + dj), length + cell * np.hypot(di, dj)
                if min(near) >= 0 and near[0] < free.shape[0] and near[1] < free.shape[1] and free[near] and way < least[near]:
                    least[near] = way
                    heapq.heappush(queue, (way, near))
    return least


def test_a_carrier_that_drives_by_hand_fetches_and_delivers():
    env = alone()
    observations, _ = env.reset(seed=2)
    fetched = delivered = False
    for _ in range(1200):
        observations, rewards, terminated, _, infos = env.step(envs.fetch_and_carry(observations))
        assert not terminated.any() and env.observation_space.contains(observations)
        expected = infos["progress"] + 2 * infos["fetched"] + 5 * infos["delivered"]
        assert np.allclose(rewards, expected)
        fetched |= bool(infos["fetched"][0])
        if infos["delivered"][0]:
            delivered = True
            break
    assert fetched and delivered


def test_a_load_rides_on_the_carrier_and_makes_it_heavier():
    env = alone()
    put(env, *env.task._place_of_goal[0])
    observations, _, _, _, infos = env.step(np.zeros((1, 2)))
    assert infos["fetched"][0] and observations[0, 27] == 1 and env.task.loaded[0]
    load = env.task.simulation.robots("load_0")
    for _ in range(60):
        _, _, terminated, _, infos = env.step(np.array([[0.0, 0.5]]))
        assert not terminated[0]
    carrier = env.task.robots.pose[0]
    assert np.linalg.norm(load.pose[0, :2] - carrier[:2]) < 0.01 and load.pose[0, 2] == pytest.approx(0.401, abs=0.005)
    weight = -sum(env.task.simulation.contacts["force"][env.task.simulation.contacts["robot_b"] == -1][:, 2])
    assert abs(weight) == pytest.approx((25 + 3 + 8) * 9.8, rel=0.05)


def test_a_carrier_with_little_charge_docks_and_its_action_does_not_count():
    env = alone(charge_s=1.0, battery_s=100.0)
    task = env.task
    put(env, *task._place_of_goal[0])
    env.step(np.zeros((1, 2)))
    task.charge[0] = 0.2
    put(env, *task._place_of_goal[0])
    observations, _, _, _, infos = env.step(np.zeros((1, 2)))
    assert infos["delivered"][0] and observations[0, 28] == 1 and not task.loaded[0]   # its goal is its bay
    put(env, *task.hall.bays[0])
    *_, infos = env.step(np.zeros((1, 2)))
    assert not infos["in_service"][0]
    before = task.robots.pose[0].copy()
    for _ in range(19):
        *_, infos = env.step(np.ones((1, 2)))
        assert not infos["in_service"][0] and infos["present"][0]
    assert np.allclose(task.robots.pose[0], before, atol=0.01)
    observations, *_, infos = env.step(np.ones((1, 2)))
    assert infos["in_service"][0] and task.charge[0] == 1 and observations[0, 28] == 0


def test_a_carrier_without_charge_or_that_touches_a_wall_is_terminated():
    env = alone(autoreset_mode="Disabled")
    env.task.charge[0] = 1e-6
    _, rewards, terminated, _, infos = env.step(np.ones((1, 2)))
    assert terminated[0] and infos["flat"][0] and not infos["collided"][0] and rewards[0] < -4
    env.reset(options={"reset_mask": np.array([True])})
    assert env.task.present[0]
    put(env, 0, -5.4, -np.pi / 2)
    for _ in range(40):
        _, rewards, terminated, _, infos = env.step(np.array([[1.0, 0.0]]))
        if terminated[0]:
            break
    assert infos["collided"][0] and rewards[0] < -4 and not env.task.present[0]


@pytest.mark.parametrize("mode", list(gymnasium.vector.AutoresetMode))
@pytest.mark.parametrize("worlds", [1, 2])
def test_the_same_seed_gives_the_same_bits(mode, worlds):
    ways = []
    for threads in (1, 3):
        env = envs.WarehouseVectorEnv(num_envs=8, worlds=worlds, threads=threads, autoreset_mode=mode)
        env.reset(seed=0)
        env.step(env.action_space.sample())
        observations, _ = env.reset(seed=5)
        way = [observations]
        for _ in range(250):
            observations, rewards, *_, infos = env.step(envs.fetch_and_carry(observations))
            way += [observations, rewards]
        ways.append((way, env.state_hashes))
        assert all(env.observation_space.contains(seen) for seen in [way[0], *way[1::2]])
    assert ways[0][1] == ways[1][1] and len(set(ways[0][1])) == worlds
    assert all(np.array_equal(one, other) for one, other in zip(*(way for way, _ in ways)))


def test_carriers_of_a_traffic_control_deliver_without_collisions():
    env = envs.WarehouseVectorEnv(num_envs=16, worlds=2, threads=2)
    env.reset(seed=1)
    drive = envs.CarrierTraffic(env.task)
    fetched = delivered = 0
    for _ in range(1200):
        _, _, terminated, _, infos = env.step(drive())
        assert not infos["collided"].any()
        fetched, delivered = fetched + infos["fetched"].sum(), delivered + infos["delivered"].sum()
    assert fetched >= 20 and delivered >= 12          # 30 and 21


def test_lanes_lead_from_everywhere_to_everywhere_and_keep_their_distance():
    from roboss.envs.warehouse_traffic import Lanes, distances
    for carriers in (1, 3, 8, 40):
        lanes = Lanes(envs.WarehouseTask(carriers=carriers).hall)
        nodes = lanes.nodes
        far = np.hypot(*(nodes[:, None] - nodes[None]).transpose(2, 0, 1))
        assert (far + 10 * np.eye(len(nodes))).min() > 0.8
        free = np.zeros(len(nodes))
        for start in range(0, len(nodes), 7):
            for goal in range(0, len(nodes), 11):
                way = lanes.way(start, goal, free, set())
                assert start == goal or way[-1] == goal
                for one, other in zip([start, *way], way):
                    assert other in [node for node, _ in lanes.edges[one]]
    crossing = distances(np.array([[0.0, 0], [2, 0]]), np.array([[[1.0, -1], [1, 1]], [[0, 1], [2, 1]], [[3, 0], [4, 0]]]))
    assert crossing == pytest.approx([0, 1, 1])


def test_a_loaded_carrier_stops_after_turns():
    """The wheels carry it, not the sliders: a carrier whose sliders bore its weight slid without brakes."""
    env = alone()
    put(env, *env.task._place_of_goal[0])
    env.step(np.zeros((1, 2)))
    assert env.task.loaded[0]
    put(env, float(env.task.hall.aisles[0]), -4.2, 0.0)
    for step in range(40):
        _, _, terminated, _, _ = env.step(np.array([[0.5, 0.4 if step < 20 else 0.0]]))
        assert not terminated[0]
    for _ in range(12):
        env.step(np.zeros((1, 2)))
    assert np.hypot(*env.task.robots.twist[0, :2]) < 0.02


def test_no_two_carriers_have_an_order_for_the_same_slot():
    env = envs.WarehouseVectorEnv(num_envs=12, threads=1, episode_s=4)
    env.reset(seed=1)
    for _ in range(200):
        env.step(env.action_space.sample())
        slots = env.task._slot[env.task._slot >= 0]
        assert len(set(slots)) == len(slots)


def test_errors_tell_what_to_do():
    for make in (lambda: envs.WarehouseVectorEnv(num_envs=0), lambda: envs.WarehouseVectorEnv(num_envs=5, worlds=2),
                 lambda: envs.WarehouseEnv(others=-1), lambda: envs.WarehouseTask(carriers=201),
                 lambda: envs.WarehouseTask(battery_s=0)):
        with pytest.raises(roboss.ArgumentError) as error:
            make()
        assert error.value.remedy
