// Rotations: quaternion, matrix, rotation vector and roll-pitch-yaw say the same, also at the awkward places.
#include "math/quat.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

const Vec3 kA{1, -2, 3};

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

/// Equal as rotations: q and -q turn alike.
void expect_same_rotation(const Quat& a, const Quat& b, double tolerance) {
    const double sign = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z < 0 ? -1.0 : 1.0;
    EXPECT_NEAR(a.w, sign * b.w, tolerance);
    EXPECT_NEAR(a.x, sign * b.x, tolerance);
    EXPECT_NEAR(a.y, sign * b.y, tolerance);
    EXPECT_NEAR(a.z, sign * b.z, tolerance);
}

TEST(Quat, QuarterTurnAboutZTakesXToY) {
    expect_near(rotate(axis_angle({0, 0, 1}, kPi / 2), {1, 0, 0}), {0, 1, 0}, 1e-15);
}

TEST(Quat, ProductTurnsByTheRightFactorFirst) {
    const Quat about_z = axis_angle({0, 0, 1}, kPi / 2), about_x = axis_angle({1, 0, 0}, kPi / 2);
    expect_near(rotate(about_z * about_x, {0, 1, 0}), rotate(about_z, rotate(about_x, {0, 1, 0})), 1e-15);
    expect_near(rotate(about_z * about_x, {0, 1, 0}), {0, 0, 1}, 1e-15);
}

TEST(Quat, MatrixAndQuaternionRotateAlike) {
    const Quat q = from_rpy(0.3, -1.1, 2.5);
    expect_near(to_matrix(q) * kA, rotate(q, kA), 1e-14);
    expect_near(rotate(conjugate(q), rotate(q, kA)), kA, 1e-14);
}

TEST(Quat, RollPitchYawTurnAboutFixedAxesInThisOrder) {
    const Quat q = from_rpy(0.3, -1.1, 2.5);
    const Vec3 by_hand = rotate(axis_angle({0, 0, 1}, 2.5),
                                rotate(axis_angle({0, 1, 0}, -1.1), rotate(axis_angle({1, 0, 0}, 0.3), kA)));
    expect_near(rotate(q, kA), by_hand, 1e-14);
}

TEST(Quat, ComesBackFromItsMatrixForEveryBranch) {
    // Half turns about x, y and z take each branch of Shepperd's method; the identity takes the first.
    const Quat samples[] = {{},
                            axis_angle({1, 0, 0}, kPi),
                            axis_angle({0, 1, 0}, kPi),
                            axis_angle({0, 0, 1}, kPi),
                            from_rpy(3.0, 0.1, -0.2),
                            from_rpy(0.1, 0.2, 3.1),
                            from_rpy(3.0, 0.1, 3.0),
                            from_rpy(0.3, -1.1, 2.5)};
    for (const Quat& q : samples) expect_same_rotation(to_quat(to_matrix(q)), q, 1e-15);
}

TEST(Quat, ExponentialAndLogarithmInvertEachOther) {
    for (const double angle : {0.0, 1e-14, 1e-10, 1e-5, 0.5, 3.0, kPi - 1e-9}) {
        const Vec3 rotation = normalized(kA) * angle;
        expect_near(logarithm(exponential(rotation)), rotation, 1e-9 * angle);
    }
}

TEST(Quat, LogarithmTakesTheShortWay) {
    const Vec3 rotation = logarithm(axis_angle({0, 0, 1}, 1.5 * kPi));
    expect_near(rotation, {0, 0, -0.5 * kPi}, 1e-15);
}

TEST(Quat, NormalizedHasLengthOneAndTheSameRotation) {
    const Quat q = from_rpy(0.3, -1.1, 2.5);
    expect_same_rotation(normalized(Quat{3 * q.w, 3 * q.x, 3 * q.y, 3 * q.z}), q, 1e-15);
}

}  // namespace
}  // namespace roboss
