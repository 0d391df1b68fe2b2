// Poses and transforms: they compose, invert and convert into each other without a change of meaning.
#include "math/pose.h"

#include <gtest/gtest.h>

#include <limits>

namespace roboss {
namespace {

const Pose kX_AB{{1, 2, 3}, from_rpy(0.3, -1.1, 2.5)};
const Pose kX_BC{{-0.5, 0.25, 4}, from_rpy(-2.0, 0.4, 0.1)};
const Vec3 kPoint{0.7, -0.2, 1.9};

void expect_near(const Vec3& a, const Vec3& b) {
    EXPECT_NEAR(a.x, b.x, 1e-14);
    EXPECT_NEAR(a.y, b.y, 1e-14);
    EXPECT_NEAR(a.z, b.z, 1e-14);
}

TEST(Pose, ComposesFromRightToLeft) {
    expect_near((kX_AB * kX_BC) * kPoint, kX_AB * (kX_BC * kPoint));
}

TEST(Pose, InverseTakesThePointBack) {
    expect_near(inverse(kX_AB) * (kX_AB * kPoint), kPoint);
    expect_near((inverse(kX_AB) * kX_AB).p, {0, 0, 0});
}

TEST(Pose, MovesTheOriginToItsPosition) {
    EXPECT_EQ(kX_AB * Vec3{}, kX_AB.p);
}

TEST(Transform, IsThePoseWithAMatrix) {
    expect_near(to_transform(kX_AB) * kPoint, kX_AB * kPoint);
    expect_near((to_transform(kX_AB) * to_transform(kX_BC)) * kPoint, (kX_AB * kX_BC) * kPoint);
    expect_near(inverse(to_transform(kX_AB)) * kPoint, inverse(kX_AB) * kPoint);
    expect_near(to_pose(to_transform(kX_AB)) * kPoint, kX_AB * kPoint);
}

TEST(Pose, IsFiniteOnlyWithAllItsNumbers) {
    EXPECT_TRUE(is_finite(kX_AB));
    Pose broken = kX_AB;
    broken.q.z = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(is_finite(broken));
    broken = kX_AB;
    broken.p.x = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(is_finite(broken));
}

}  // namespace
}  // namespace roboss
