"""Performance criteria of arms on made-up data whose figures are known."""
import numpy as np
import pytest

import roboss
from roboss.analysis import analyse_arm, iso9283

DOWN = np.array([0.0, 1, 0, 0])


def poses(positions):
    positions = np.atleast_2d(positions)
    return np.hstack([positions, np.tile(DOWN, (len(positions), 1))])


def turned(angle, axis, quat):
    """A quaternion, turned about an axis of the base."""
    x, y, z, w = *np.sin(angle / 2) * np.asarray(axis, dtype=float), np.cos(angle / 2)
    v, s = quat[:3], quat[3]
    return np.array([*(w * v + s * np.array([x, y, z]) + np.cross([x, y, z], v)), w * s - np.dot([x, y, z], v)])


def test_accuracy_is_the_distance_to_the_mean():
    attained = poses([[0.03, 0, 0], [0.03, 0.08, 0]])
    score = iso9283.pose_score(attained, poses([0, 0, 0])[0])
    assert score.accuracy == pytest.approx(0.05) and score.accuracy_xyz == pytest.approx([0.03, 0.04, 0])


def test_repeatability_is_the_mean_distance_and_three_standard_deviations():
    corners = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]]) * 0.002
    assert iso9283.position_repeatability(corners) == pytest.approx(0.002)  # all as far from the mean
    ends = np.array([[0, 0, 0], [0, 0, 0], [0, 0, 0], [0.004, 0, 0]])  # distances 1 1 1 3 mm: mean 1.5, S 1
    assert iso9283.position_repeatability(ends) == pytest.approx(0.0015 + 3 * 0.001)


def test_orientations_are_compared_about_the_axes_of_the_base():
    attained = np.array([[0, 0, 0, *turned(angle, [0, 0, 1], DOWN)] for angle in (0.01, 0.02, 0.03)])
    attained[1, 3:] *= -1  # the same rotation
    score = iso9283.pose_score(attained, poses([0, 0, 0])[0])
    assert score.accuracy_abc == pytest.approx([0, 0, 0.02], abs=1e-12)
    assert score.repeatability_abc == pytest.approx([0, 0, 0.03], abs=1e-12)


def test_distances_are_compared_with_the_commanded_one():
    first, second = np.zeros((3, 3)), np.array([[0.1, 0, 0], [0, 0.102, 0], [0, 0, 0.104]])
    accuracy, repeatability = iso9283.distance_score(first, second, [0, 0, 0], [0.1, 0, 0])
    assert (accuracy, repeatability) == (pytest.approx(0.002), pytest.approx(0.006))


def test_variation_of_directions_is_the_largest_distance():
    assert iso9283.direction_variation(np.array([[0, 0, 0], [3, 4, 0], [1, 0, 0]]) * 1e-3) == pytest.approx(5e-3)


def test_a_damped_oscillation_settles_when_its_envelope_is_within_the_band():
    time = np.linspace(0, 2, 20001)
    x = np.exp(-3 * time) * np.cos(20 * time)
    settled, overshoot = iso9283.settling(time, np.column_stack([x, 0 * x, 0 * x]), np.zeros(3), 0.1)
    first = time[np.argmax(np.abs(x) <= 0.1)]
    last = time[np.flatnonzero(np.abs(x) > 0.1)[-1] + 1]
    assert settled == pytest.approx(last - first) and 0.5 < settled < np.log(10) / 3
    peak = np.pi / 20 - np.arctan(3 / 20) / 20  # of the first swing to the other side
    assert overshoot == pytest.approx(abs(np.exp(-3 * peak) * np.cos(20 * peak)), rel=1e-6)


def test_an_arrival_without_oscillation_has_no_overshoot():
    time = np.linspace(0, 2, 201)
    x = np.exp(-5 * time)
    assert iso9283.settling(time, np.column_stack([x, x, x]), np.zeros(3), 0.1) == (0, 0)


def test_what_is_never_at_rest_has_no_settling_time():
    time = np.linspace(0, 2, 201)
    x = np.cos(20 * time)
    assert np.isnan(iso9283.settling(time, np.column_stack([x, x, x]), np.zeros(3), 0.1)).all()


def test_paths_are_compared_in_planes_across_the_commanded_one():
    commanded = np.column_stack([np.linspace(0.1, 0.9, 9), np.zeros(9), np.zeros(9)])
    x = np.linspace(0, 1, 137)
    runs = [np.column_stack([x, 0 * x + 0.001 + side * 0.0005, 0.004 * x]) for side in (-1, 1)]  # two parallel lines
    crossings = np.array([iso9283.path_crossings(run, commanded) for run in runs])
    accuracy, repeatability = iso9283.path_score(crossings, commanded)
    assert accuracy == pytest.approx(np.hypot(0.001, 0.004 * 0.9))
    assert repeatability == pytest.approx(0.0005, abs=1e-12)  # both at the same distance from their mean
    with pytest.raises(roboss.ArgumentError):
        iso9283.path_score(crossings[:1], commanded)


def test_speeds_along_a_path():
    speeds = np.array([[0.9, 1.1, 1.0], [1.0, 1.3, 1.0]])  # means 1.0 and 1.1
    accuracy, repeatability, fluctuation = iso9283.path_velocity_score(speeds, 1.0)
    assert accuracy == pytest.approx(0.05) and fluctuation == pytest.approx(0.3)
    assert repeatability == pytest.approx(3 * 0.1 / np.sqrt(2))


def test_drift_is_the_change_of_accuracy_and_repeatability():
    corners = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]])
    first, last = poses([0.003, 0, 0] + 0.001 * corners), poses([0, 0.005, 0] + 0.0004 * corners)
    last[:, 3:] = turned(0.02, [0, 0, 1], DOWN)
    drift = iso9283.pose_drift(first, last, poses([0, 0, 0])[0])
    assert drift.accuracy == pytest.approx(0.002) and drift.repeatability == pytest.approx(0.0006)  # 3 to 5 mm, 1 to 0.4 mm
    assert drift.accuracy_abc == pytest.approx([0, 0, 0.02], abs=1e-12)
    assert drift.moved == pytest.approx(np.hypot(0.003, 0.005))


def test_exchangeability_is_the_largest_distance_between_the_means_of_arms():
    assert iso9283.exchangeability(np.array([[0, 0, 0], [3, 4, 0], [1, 0, 0]]) * 1e-3) == pytest.approx(5e-3)


CORNER = np.array([1.0, 2, 3])


def test_a_path_that_cuts_a_corner_by_an_arc_has_its_round_off_error():
    angle, r = np.linspace(0, np.pi / 2, 9001), 0.01  # of an arc that touches both lines
    arc = CORNER + np.column_stack([r * (np.sin(angle) - 1), r * (1 - np.cos(angle)), 0 * angle])
    round_off, overshoot = iso9283.cornering(arc, CORNER, [1, 0, 0], [0, 1, 0])
    assert round_off == pytest.approx(r * (np.sqrt(2) - 1), rel=1e-6) and overshoot == pytest.approx(0, abs=1e-12)


def test_overshoot_is_counted_beyond_the_second_line_and_across_it():
    path = CORNER + np.array([[-0.1, 0.02, 0], [0, 0, 0], [0.003, 0.001, 0.004], [0.001, 0.01, 0], [-0.02, 0.05, 0]])
    round_off, overshoot = iso9283.cornering(path, CORNER, [2, 0, 0], [0, 3, 0])
    assert round_off == 0 and overshoot == pytest.approx(0.005)  # not the 20 mm on the inner side
    slanted = iso9283.cornering(path, CORNER, [1, -1, 0], [0, 1, 0])  # an acute corner has the same second line
    assert slanted == pytest.approx((round_off, overshoot))
    with pytest.raises(roboss.ArgumentError):
        iso9283.cornering(path, CORNER, [1, 0, 0], [-1, 0, 0])


def test_compliance_is_the_slope():
    forces = np.array([0.0, 10, 20])
    assert iso9283.compliance(forces, 2e-6 * forces) == pytest.approx(2e-6)


def test_the_cube_has_its_poses_on_the_diagonals_of_a_plane():
    points = iso9283.cube_poses(np.array([1.0, 2, 3]), 0.4)
    assert points[0] == pytest.approx([1, 2, 3])
    diagonal = 0.4 * np.sqrt(3)
    for first, second in ((1, 3), (2, 4)):
        assert np.linalg.norm(points[first] - points[second]) == pytest.approx(0.8 * diagonal)
        assert points[[first, second]].mean(axis=0) == pytest.approx(points[0])
    assert np.linalg.matrix_rank(points - points[0], tol=1e-9) == 2


def recorded(offset, spread, cycles=5):
    """Commanded and attained poses of an arm between two places; it arrives at `offset`, and +- spread in z by turns."""
    commanded, attained, dt = [], [], 0.01
    places = np.array([[0.0, 0, 0], [0.5, 0, 0]])
    share = np.linspace(0, 1, 51)[1:, None]
    for cycle in range(cycles):
        for first, second in ((0, 1), (1, 0)):
            line = places[first] + share * (places[second] - places[first])
            commanded += [*line, *np.tile(places[second], (50, 1))]
            error = offset + np.array([0, 0, spread * (-1) ** cycle])
            attained += [*(line + error), *np.tile(places[second] + error, (50, 1))]
    return np.arange(len(commanded)) * dt, poses(attained), poses(commanded)


def test_poses_and_paths_are_found_in_a_recording():
    condition = analyse_arm(*recorded(np.array([0, 0.003, 0]), 0.0004, cycles=4))
    assert [(p.name, len(p.attained)) for p in condition.poses] == [("P1", 4), ("P2", 4)]
    for pose in condition.poses:
        assert pose.score.accuracy == pytest.approx(0.003)
        assert pose.score.repeatability == pytest.approx(0.0004)
        assert (pose.settling_time, pose.overshoot) == (0, 0)
    there, back = condition.paths
    assert (there.name, there.runs, back.name, back.runs) == ("P1 to P2", 4, "P2 to P1", 3)
    assert there.accuracy == pytest.approx(0.003) and there.repeatability == pytest.approx(0.0004)
    assert back.accuracy == pytest.approx(np.hypot(0.003, 0.0004 / 3))  # up, down, up: their mean is a third up
    assert back.repeatability == pytest.approx(0.0004 * (8 / 9 + 3 * np.std([2 / 3, 4 / 3, 2 / 3], ddof=1)))
    (name, accuracy, repeatability), = condition.distances
    assert name == "P1 to P2" and accuracy == pytest.approx(0, abs=1e-12) and repeatability == pytest.approx(0, abs=1e-9)


def test_drift_is_taken_between_the_first_and_the_last_visits():
    time, measured, commanded = recorded(np.zeros(3), 0.0, cycles=6)
    measured[3 * 200:, 1] += 0.002  # from the fourth cycle on
    assert all(pose.drift is None for pose in analyse_arm(time, measured, commanded).poses)  # ten visits are not there
    for pose in analyse_arm(time, measured, commanded, drift_visits=3).poses:
        assert pose.drift.accuracy == pytest.approx(0.002) and pose.drift.repeatability == pytest.approx(0, abs=1e-12)


def cornered(points=401):
    """Positions along an L of 0.4 m, there and back, three times, with a rest at each end."""
    side = np.linspace(0, 0.4, points)[1:, None]
    along, across = side * [1.0, 0, 0], [0.4, 0, 0] + side * [0, 1.0, 0]
    one = np.vstack([np.zeros((50, 3)), along, across, np.tile(across[-1], (50, 1))])
    return np.vstack([one, one[::-1]] * 3)


def corners_of(commanded):
    return analyse_arm(np.arange(len(commanded)) * 0.01, poses(commanded), poses(commanded)).corners


def test_corners_are_found_where_the_commanded_path_turns_without_a_rest():
    commanded = cornered()
    late = np.vstack([np.tile(commanded[0], (10, 1)), commanded[:-10]])
    late[:, 2] += 0.002  # so the corner is missed by 2 mm
    corners = analyse_arm(np.arange(len(commanded)) * 0.01, poses(late), poses(commanded)).corners
    assert [(corner.place.tolist(), corner.runs) for corner in corners] == [([0.4, 0, 0], 3)] * 2  # there and back
    for corner in corners:
        assert corner.round_off == pytest.approx(0.002) and corner.overshoot == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("points", [3, 41, 137, 4001, 40001])
def test_corners_are_found_at_any_sampling(points):
    found = [(corner.place.tolist(), corner.runs) for corner in corners_of(cornered(points))]
    assert found == [([0.4, 0, 0], 3)] * 2


def test_rounded_positions_of_a_slanting_line_make_no_corners():
    turn = np.array([[0.8, -0.6, 0], [0.6, 0.8, 0], [0, 0, 1]]) @ [[1, 0, 0], [0, 0.96, -0.28], [0, 0.28, 0.96]]
    for points in (401, 4001, 40001):  # steps of 1, 0.1, 0.01 mm
        found = corners_of(np.round(cornered(points) @ turn.T, 5))
        assert [corner.place == pytest.approx(turn @ [0.4, 0, 0], abs=1e-4) for corner in found] == [True] * 2


@pytest.mark.parametrize("places", [5, 15])
@pytest.mark.parametrize("points", [41, 401, 4001])
def test_a_path_that_goes_back_on_its_line_has_no_corner(points, places):
    side = np.linspace(0, 0.4, points)[1:, None] * [0.6, 0.64, 0.48]
    one = np.round(np.vstack([np.zeros((50, 3)), side, side[::-1]]), places)
    assert corners_of(np.vstack([one, one, one, np.zeros((50, 3))])) == []


def test_arms_of_one_type_are_compared_at_the_poses_that_they_share():
    from roboss.analysis.arm import exchangeability
    arms = [analyse_arm(*recorded(np.array([x, 0, 0]), 0.0)) for x in (0.0, 0.001, 0.003)]
    assert exchangeability(arms) == [("P1", pytest.approx(0.003)), ("P2", pytest.approx(0.003))]
    with pytest.raises(roboss.ArgumentError):
        exchangeability(arms[:1])


def test_both_signs_of_a_quaternion_are_one_pose():
    from roboss.analysis.arm import exchangeability
    time, measured, commanded = recorded(np.array([0, 0.001, 0]), 0.0)
    flipped = commanded.copy()
    flipped[np.arange(len(time)) // 130 % 2 == 0, 3:] *= -1  # also within rests, and from visit to visit
    one, other = analyse_arm(time, measured, commanded), analyse_arm(time, measured, flipped)
    assert [(p.name, len(p.attained)) for p in other.poses] == [(p.name, len(p.attained)) for p in one.poses]
    assert exchangeability([one, other]) == [("P1", pytest.approx(0)), ("P2", pytest.approx(0))]


def test_a_single_cycle_is_refused():
    with pytest.raises(roboss.ArgumentError) as caught:
        analyse_arm(*recorded(np.zeros(3), 0.0, cycles=1))
    assert caught.value.code == "too-few-cycles"
