// Trajectories keep their ends, and their velocities and accelerations are derivatives.
#include "kinematics/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <support/random.h>

namespace roboss::test {
namespace {

using Numbers = std::vector<double>;

struct Joints {
    Joints(const JointMotion& motion, const Numbers& times)
        : q(times.size() * motion.q0.size()), v(q.size()), a(q.size()) {
        joint_trajectory(motion, times, {q, v, a});
    }
    Numbers q, v, a;
};

TEST(JointTrajectory, KeepsPositionsVelocitiesAndRestAtItsEnds) {
    Random random(31);
    const Numbers times{2.0, 2.7, 5.5};
    for (int i = 0; i < 20; ++i) {
        const Numbers q0{random.uniform(-3, 3)}, q1{random.uniform(-3, 3)}, v0{random.uniform(-3, 3)},
            v1{random.uniform(-3, 3)};
        const Joints t({q0, q1, v0, v1}, times);
        EXPECT_NEAR(t.q[0], q0[0], 1e-14);
        EXPECT_NEAR(t.q[2], q1[0], 1e-13);
        EXPECT_NEAR(t.v[0], v0[0], 1e-14);
        EXPECT_NEAR(t.v[2], v1[0], 1e-13);
        EXPECT_NEAR(t.a[0], 0, 1e-14);
        EXPECT_NEAR(t.a[2], 0, 1e-12);
    }
}

TEST(JointTrajectory, VelocitiesAndAccelerationsAreDerivatives) {
    constexpr double kStep = 1e-4;
    const Numbers times{0, 0.7 - kStep, 0.7, 0.7 + kStep, 2.0}, q0{0.3, -1}, q1{2, 1}, v0{0.5, 0},
        v1{-0.4, 1};
    const Joints t({q0, q1, v0, v1}, times);
    for (std::size_t c = 0; c < 2; ++c) {
        EXPECT_NEAR(t.v[4 + c], (t.q[6 + c] - t.q[2 + c]) / (2 * kStep), 1e-7);
        EXPECT_NEAR(t.a[4 + c], (t.v[6 + c] - t.v[2 + c]) / (2 * kStep), 1e-7);
    }
}

TEST(JointTrajectory, IsHalfWayAtHalfTimeBetweenTwoRests) {
    const Numbers q0{1}, q1{3};
    const Joints t({q0, q1, {}, {}}, {0, 1, 2});
    EXPECT_NEAR(t.q[1], 2, 1e-15);
    EXPECT_NEAR(t.v[1], 15.0 / 8 * 2 / 2, 1e-14);  // 15/8 of the mean speed, the most of a quintic
}

TEST(CartesianTrajectory, GoesStraightAndTurnsAboutOneAxis) {
    const Pose X0{{1, 2, 3}, from_rpy(0.2, -0.3, 0.4)}, X1{{2, 0, 3.5}, from_rpy(-1, 0.8, 2)};
    Numbers times, poses(101 * 7), twists(101 * 6);
    for (int i = 0; i <= 100; ++i) times.push_back(1 + 0.02 * i);
    cartesian_trajectory(X0, X1, 0.25, times, poses, twists);
    const auto pose = [&](std::size_t i) {
        const double* p = &poses[i * 7];
        return Pose{{p[0], p[1], p[2]}, {p[6], p[3], p[4], p[5]}};
    };
    EXPECT_LT(norm(pose(0).p - X0.p) + norm(pose(100).p - X1.p), 1e-14);
    EXPECT_LT(norm(logarithm(conjugate(X1.q) * pose(100).q)), 1e-12);
    const Vec3 way = X1.p - X0.p, turn = logarithm(X1.q * conjugate(X0.q));
    for (std::size_t i = 1; i < 100; ++i) {
        const Vec3 along = pose(i).p - X0.p, turned = logarithm(pose(i).q * conjugate(X0.q));
        EXPECT_LT(norm(cross(along, way)), 1e-13);
        EXPECT_NEAR(norm(along) / norm(way), norm(turned) / norm(turn), 1e-12);
        const Vec3 speed = (pose(i + 1).p - pose(i - 1).p) / 0.04;
        const Vec3 angular = logarithm(pose(i + 1).q * conjugate(pose(i - 1).q)) / 0.04;
        const double* w = &twists[i * 6];
        const double bound =
            i % 25 == 0 && i != 50 ? 0.05 : 1e-11;  // at the corners of the trapezoid, a mean
        EXPECT_LT(norm(speed - Vec3{w[0], w[1], w[2]}), bound) << i;
        EXPECT_LT(norm(angular - Vec3{w[3], w[4], w[5]}), bound) << i;
    }
    EXPECT_NEAR(norm(Vec3{twists[300], twists[301], twists[302]}), norm(way) / 2 / 0.75, 1e-13);
}

TEST(CartesianTrajectory, TakesTheShorterWayRound) {
    const Quat far = axis_angle<double>({0, 0, 1}, 3.5);  // 3.5 rad: 2.78 the other way
    Numbers poses(21), twists(18);
    cartesian_trajectory({}, {{}, far}, 0.0, Numbers{0, 1, 2}, poses, twists);
    EXPECT_NEAR(twists[11], (3.5 - 2 * kPi) / 2, 1e-12);
    cartesian_trajectory({}, {{}, {-1, 0, 0, 0}}, 0.5, Numbers{0, 1, 2}, poses,
                         twists);  // no rotation at all
    EXPECT_NEAR(norm(Vec3{twists[9], twists[10], twists[11]}), 0, 1e-15);
}

}  // namespace
}  // namespace roboss::test
