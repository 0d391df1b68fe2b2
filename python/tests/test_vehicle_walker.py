"""Figures of vehicles and walkers on made-up data whose answers are known."""
import numpy as np
import pytest

import roboss
from roboss.analysis import vehicle, walker


def test_a_circle_has_its_radius_and_speed():
    time = np.linspace(0, 10, 300)
    xy = np.column_stack([3 + 2 * np.cos(0.4 * time), -1 + 2 * np.sin(0.4 * time)])
    score = vehicle.circle_score(time, xy)
    assert (score.radius, score.speed, score.yaw_rate) == (pytest.approx(2), pytest.approx(0.8), pytest.approx(0.4))
    assert score.lateral_acceleration == pytest.approx(0.32) and score.radius_spread == pytest.approx(0, abs=1e-9)
    assert vehicle.circle_score(time, xy[::-1]).yaw_rate == pytest.approx(-0.4)


def test_a_stop_at_a_constant_deceleration():
    time = np.linspace(0, 4, 4001)
    braking = np.clip(time - 1, 0, 2)  # from 1 s on with 1.5 m/s^2, from 3 m/s
    way = 3 * np.minimum(time, 1) + 3 * braking - 0.75 * braking**2
    score = vehicle.stop_score(time, np.column_stack([0.6 * way, 0.8 * way]), 1.0)
    assert score.speed == pytest.approx(3, rel=1e-3) and score.distance == pytest.approx(3, rel=2e-3)
    assert score.mean_deceleration == pytest.approx(1.5, rel=3e-3) and score.time == pytest.approx(2, abs=0.01)
    assert score.deviation < 1e-6
    with pytest.raises(roboss.ArgumentError):
        vehicle.stop_score(time[:1500], np.column_stack([way, way])[:1500], 1.0)


def test_a_weave_has_its_gain_and_lag():
    time = np.linspace(0, 10, 5001)
    command = 0.5 * np.sin(2 * np.pi * 0.5 * time)
    yaw = -0.4 / (np.pi) * np.cos(2 * np.pi * 0.5 * (time - 0.1))  # rate: 0.4 sin, 0.1 s later
    score = vehicle.weave_score(time, yaw, np.full(len(time), 2.0), command, 0.5)
    assert (score.gain, score.lag) == (pytest.approx(0.8, rel=1e-3), pytest.approx(0.1, abs=1e-3))
    assert score.lateral_acceleration == pytest.approx(0.8, rel=1e-3)


def driven(way, side, ratio, track_ratio, track=0.3, radius=0.05):
    """Return position error of a square driven by odometry: the right wheel is larger by `ratio`, the track by `track_ratio`."""
    left_radius, right_radius = 2 * radius / (1 + ratio), 2 * radius * ratio / (1 + ratio)
    left, right = [0.0], [0.0]
    for _ in range(4):
        straight, turn = side / radius, way * np.pi / 2 * track / 2 / radius
        for step_left, step_right in ((straight, straight), (-turn, turn)):
            left += list(left[-1] + step_left * np.linspace(0, 1, 400)[1:])
            right += list(right[-1] + step_right * np.linspace(0, 1, 400)[1:])
    computed = vehicle.odometry(np.array(left), np.array(right), radius, track)
    # What it really does: the same arcs with the true wheels; odometry() takes one radius, so the angles are scaled.
    actual = vehicle.odometry(np.array(left) * left_radius, np.array(right) * right_radius, 1.0, track * track_ratio)
    return actual[-1, :2] - computed[-1, :2]


def test_odometry_of_a_square_returns():
    assert driven(1, 4.0, 1.0, 1.0) == pytest.approx([0, 0], abs=1e-9)


@pytest.mark.parametrize("ratio, track_ratio", [(1.001, 1.0), (1.0, 1.01), (0.999, 0.995)])
def test_umbmark_finds_the_wheels_and_the_track(ratio, track_ratio):
    errors = {way: np.array([driven(way, 4.0, ratio, track_ratio)]) for way in (-1, 1)}
    score = vehicle.umbmark_score(errors[-1], errors[1], 4.0, 0.3)
    assert score.wheel_ratio == pytest.approx(ratio, abs=1e-4)
    assert score.track_ratio == pytest.approx(track_ratio, abs=5e-4)
    assert score.max_systematic == pytest.approx(max(np.linalg.norm(errors[way]) for way in (-1, 1)))


def test_transport_costs_the_work_per_weight_and_way():
    time = np.linspace(0, 10, 1001)
    power = np.column_stack([np.full(1001, 30.0), np.full(1001, -10.0)])
    xy = np.column_stack([0.5 * time, 0 * time])
    score = walker.transport_score(time, power, xy, mass=6.0, gravity=10.0)
    assert (score.cost, score.cost_net) == (pytest.approx(300 / (60 * 5)), pytest.approx(200 / (60 * 5)))
    assert (score.energy, score.power, score.speed) == (pytest.approx(300), pytest.approx(30), pytest.approx(0.5))
    assert np.isinf(walker.transport_score(time, power, 0 * xy, 6.0).cost)


def test_a_joint_under_sines_has_their_figures():
    time = np.linspace(0, 1, 20001)
    effort, velocity = 3 * np.sin(2 * np.pi * time), 2 * np.sin(2 * np.pi * time)
    demand = walker.joint_demand(time, effort, velocity)
    assert demand.effort_rms == pytest.approx(3 / np.sqrt(2)) and demand.effort_peak == pytest.approx(3)
    assert demand.effort_quantiles[0] == pytest.approx(3 * np.sin(np.pi / 4), rel=1e-3)
    assert demand.effort_quantiles[1] == pytest.approx(3 * np.sin(0.95 * np.pi / 2), rel=1e-3)
    assert demand.speed_peak == pytest.approx(2) and demand.power_peak == pytest.approx(6)
    assert demand.power_mean == pytest.approx(3) and demand.power_rms == pytest.approx(6 * np.sqrt(3 / 8))
