// Rays against closed-form cases.
#include "sensors/ray_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace roboss {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

Shape sphere(double radius) {
    return {ShapeKind::kSphere, {}, radius, 0};
}
Shape box(double x, double y, double z) {
    return {ShapeKind::kBox, {x, y, z}, 0, 0};
}
Shape cylinder(double radius, double half_length) {
    return {ShapeKind::kCylinder, {}, radius, half_length};
}
Shape capsule(double radius, double half_length) {
    return {ShapeKind::kCapsule, {}, radius, half_length};
}
const Shape kPlane{ShapeKind::kPlane, {}, 0, 0};

TEST(RayShape, SphereIsMetOneRadiusBeforeItsCentre) {
    EXPECT_EQ(ray_distance(sphere(0.5), {}, {-3, 0, 0}, {1, 0, 0}), 2.5);
    EXPECT_DOUBLE_EQ(ray_distance(sphere(0.5), {}, {-3, 0.3, 0}, {1, 0, 0}), 2.6);
    EXPECT_EQ(ray_distance(sphere(0.5), {}, {-3, 0.51, 0}, {1, 0, 0}), kNone);
}

TEST(RayShape, FromInsideTheFarSurfaceIsSeen) {
    EXPECT_EQ(ray_distance(sphere(0.5), {}, {0.25, 0, 0}, {1, 0, 0}), 0.25);
    EXPECT_EQ(ray_distance(box(1, 2, 3), {}, {0, 0, 0}, {0, 0, -1}), 3.0);
    EXPECT_EQ(ray_distance(cylinder(1, 2), {}, {0, 0, 0}, {0, 0, 1}), 2.0);
    EXPECT_EQ(ray_distance(capsule(1, 2), {}, {0, 0, 0}, {0, 0, 1}), 3.0);
}

TEST(RayShape, NothingBehindTheOriginIsSeen) {
    for (const Shape& shape : {sphere(0.5), box(0.5, 0.5, 0.5), cylinder(0.5, 0.5), capsule(0.5, 0.5)})
        EXPECT_EQ(ray_distance(shape, {}, {3, 0.1, 0.1}, {1, 0, 0}), kNone);
    EXPECT_EQ(ray_distance(kPlane, {}, {0, 0, 2}, {0, 0, 1}), kNone);
}

TEST(RayShape, PlaneIsMetWhereTheHeightIsUsedUp) {
    EXPECT_EQ(ray_distance(kPlane, {}, {5, 5, 2}, {0, 0, -1}), 2.0);
    EXPECT_DOUBLE_EQ(ray_distance(kPlane, {}, {5, 5, 2}, {0.6, 0, -0.8}), 2.5);
    EXPECT_EQ(ray_distance(kPlane, {}, {5, 5, 2}, {1, 0, 0}), kNone);
}

TEST(RayShape, BoxIsMetAtItsFaceAndMissedAtItsCorner) {
    EXPECT_EQ(ray_distance(box(1, 2, 3), {}, {-4, 1.9, 2.9}, {1, 0, 0}), 3.0);
    EXPECT_EQ(ray_distance(box(1, 2, 3), {}, {-4, 2.1, 0}, {1, 0, 0}), kNone);
    const double s = std::sqrt(0.5);
    EXPECT_DOUBLE_EQ(ray_distance(box(1, 1, 1), {}, {-3, -2.5, 0}, {s, s, 0}), 2.0 / s);
    EXPECT_EQ(ray_distance(box(1, 1, 1), {}, {-3, -0.9, 0}, {s, s, 0}), kNone);
}

TEST(RayShape, CylinderShowsItsSideAndItsEnds) {
    EXPECT_EQ(ray_distance(cylinder(0.5, 1), {}, {-3, 0, 0.9}, {1, 0, 0}), 2.5);
    EXPECT_EQ(ray_distance(cylinder(0.5, 1), {}, {-3, 0, 1.1}, {1, 0, 0}), kNone);
    EXPECT_EQ(ray_distance(cylinder(0.5, 1), {}, {0.3, 0.3, 5}, {0, 0, -1}), 4.0);
    EXPECT_EQ(ray_distance(cylinder(0.5, 1), {}, {0.4, 0.4, 5}, {0, 0, -1}), kNone);
    EXPECT_DOUBLE_EQ(ray_distance(cylinder(0.5, 1), {}, {-1.2, 0, 2.6}, {0.6, 0, -0.8}),
                     2.0);  // through the top
}

TEST(RayShape, CapsuleShowsItsCaps) {
    EXPECT_EQ(ray_distance(capsule(0.5, 1), {}, {0, 0, 5}, {0, 0, -1}), 3.5);
    EXPECT_DOUBLE_EQ(ray_distance(capsule(0.5, 1), {}, {-3, 0, 1.3}, {1, 0, 0}), 2.6);
    EXPECT_EQ(ray_distance(capsule(0.5, 1), {}, {-3, 0, -0.5}, {1, 0, 0}), 2.5);
    EXPECT_EQ(ray_distance(capsule(0.5, 1), {}, {-3, 0, 1.6}, {1, 0, 0}), kNone);
}

TEST(RayShape, TurningTheWorldTurnsNothing) {
    const Transform X_WV = to_transform({{10, -20, 5}, from_rpy(0.3, -1.1, 2.2)});
    for (const Shape& shape :
         {sphere(0.5), box(0.5, 0.7, 0.4), cylinder(0.5, 0.7), capsule(0.3, 0.6), kPlane}) {
        const Vec3 origin{2, 1.5, 1.8}, direction = normalized(Vec3{-2, -1.4, -1.7});
        const double still = ray_distance(shape, {}, origin, direction);
        ASSERT_LT(still, 10.0);
        EXPECT_NEAR(ray_distance(shape, X_WV, X_WV * origin, X_WV.R * direction), still, 1e-13);
    }
}

TEST(RayShape, ASmallSphereAKilometreAwayKeepsItsPrecision) {
    const double distance = ray_distance(sphere(0.05), {}, {-1000, 0.03, 0}, {1, 0, 0});
    EXPECT_NEAR(distance, 1000 - 0.04, 1e-12);
}

}  // namespace
}  // namespace roboss
