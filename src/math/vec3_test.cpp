// Vectors and 3x3 matrices against written-out values and the laws that define them.
#include "math/vec3.h"

#include <gtest/gtest.h>

#include <limits>

namespace roboss {
namespace {

const Vec3 kA{1, -2, 3}, kB{0.5, 4, -1};
const Mat3 kM{{1, 2, 3}, {0, -1, 4}, {2, 0, 5}};

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(Vec3, ArithmeticIsByComponent) {
    EXPECT_EQ(kA + kB, (Vec3{1.5, 2, 2}));
    EXPECT_EQ(kA - kB, (Vec3{0.5, -6, 4}));
    EXPECT_EQ(-kA, (Vec3{-1, 2, -3}));
    EXPECT_EQ(kA * 2.0, 2.0 * kA);
    EXPECT_EQ(kA / 2.0, (Vec3{0.5, -1, 1.5}));
    EXPECT_EQ(dot(kA, kB), 0.5 - 8 - 3);
    EXPECT_EQ(kA[0], 1);
    EXPECT_EQ(kA[1], -2);
    EXPECT_EQ(kA[2], 3);
}

TEST(Vec3, SumsFromLeftToRightSoThatTheBitsAreFixed) {
    // (1e16 + 1) - 1e16 is 0 in doubles, 1e16 + (1 - 1e16) is not.
    EXPECT_EQ(dot(Vec3{1e16, 1, -1e16}, Vec3{1, 1, 1}), 0.0);
    EXPECT_EQ(dot(Vec3{1e16, -1e16, 1}, Vec3{1, 1, 1}), 1.0);
}

TEST(Vec3, CrossIsRightHandedAndPerpendicular) {
    EXPECT_EQ(cross(Vec3{1, 0, 0}, Vec3{0, 1, 0}), (Vec3{0, 0, 1}));
    EXPECT_EQ(dot(cross(kA, kB), kA), 0.0);
    EXPECT_EQ(dot(cross(kA, kB), kB), 0.0);
    EXPECT_EQ(cross(kA, kB), -cross(kB, kA));
}

TEST(Vec3, NormalizedHasLengthOne) {
    EXPECT_EQ(norm(Vec3{3, 4, 12}), 13.0);
    EXPECT_NEAR(norm(normalized(kA)), 1.0, 1e-15);
}

TEST(Vec3, OnlyFiniteNumbersAreFinite) {
    EXPECT_TRUE(is_finite(kA));
    EXPECT_FALSE(is_finite(Vec3{0, std::numeric_limits<double>::quiet_NaN(), 0}));
    EXPECT_FALSE(is_finite(Vec3{0, 0, -std::numeric_limits<double>::infinity()}));
}

TEST(Mat3, MultipliesAsRowsTimesColumns) {
    EXPECT_EQ(kM * kA, (Vec3{6, 14, 17}));
    EXPECT_EQ(kM * Mat3::identity() * kA, kM * kA);
    expect_near(kM * (kM * kA), (kM * kM) * kA, 1e-12);
    EXPECT_EQ(kM(1, 2), 4);
    EXPECT_EQ(kM.col(2), (Vec3{3, 4, 5}));
    EXPECT_EQ(Mat3::diagonal(1, 2, 3) * Vec3({1, 1, 1}), (Vec3{1, 2, 3}));
}

TEST(Mat3, TransposeTimesIsTheProductWithTheTranspose) {
    EXPECT_EQ(transpose_times(kM, kA), transpose(kM) * kA);
    EXPECT_EQ(transpose(transpose(kM)) * kB, kM * kB);
}

TEST(Tangents, CompleteAnyNormalToARightHandedFrame) {
    const Vec3 normals[] = {{0, 0, 1},
                            {0, 0, -1},
                            {1, 0, 0},
                            {0, -1, 0},
                            normalized(kA),
                            normalized(kB),
                            normalized(Vec3{1e-9, 1e-9, -1})};
    for (const Vec3& n : normals) {
        Vec3 t1, t2;
        tangents(n, t1, t2);
        EXPECT_NEAR(norm(t1), 1.0, 1e-12);
        EXPECT_NEAR(norm(t2), 1.0, 1e-12);
        EXPECT_NEAR(dot(t1, n), 0.0, 1e-12);
        expect_near(cross(t1, t2), n, 1e-12);
    }
}

}  // namespace
}  // namespace roboss
