// Known contacts of planes, spheres and boxes.
#include "geometry/collide.h"

#include <gtest/gtest.h>

#include <set>

#include "math/quat.h"

namespace roboss {
namespace {

constexpr double kEps = 1e-12;

Shape plane() {
    return {ShapeKind::kPlane, {}, 0, 0};
}
Shape sphere(double r) {
    return {ShapeKind::kSphere, {}, r, 0};
}
Shape box(double x, double y, double z) {
    return {ShapeKind::kBox, {x, y, z}, 0, 0};
}
Shape cylinder(double r, double l) {
    return {ShapeKind::kCylinder, {}, r, l};
}
Shape capsule(double r, double l) {
    return {ShapeKind::kCapsule, {}, r, l};
}
Transform at(double x, double y, double z) {
    return {Mat3::identity(), {x, y, z}};
}
Transform turned(double x, double y, double z, double roll, double pitch, double yaw) {
    return {to_matrix(from_rpy(roll, pitch, yaw)), {x, y, z}};
}

std::set<std::uint32_t> features(const Manifold& m) {
    std::set<std::uint32_t> out;
    for (int i = 0; i < m.count; ++i) out.insert(m.points[static_cast<std::size_t>(i)].feature);
    return out;
}

void expect_all_gaps(const Manifold& m, double gap, double tolerance = kEps) {
    for (int i = 0; i < m.count; ++i) EXPECT_NEAR(m.points[static_cast<std::size_t>(i)].gap, gap, tolerance);
}

TEST(CollidePlane, BoxStandsOnItsFourCorners) {
    const Manifold m = collide(box(0.5, 0.3, 0.2), at(1, 2, 0.199), plane(), at(0, 0, 0), 0.01);
    ASSERT_EQ(m.count, 4);
    EXPECT_EQ(m.n_W, (Vec3{0, 0, 1}));
    EXPECT_EQ(features(m), (std::set<std::uint32_t>{0, 1, 2, 3}));
    expect_all_gaps(m, -0.001);
    for (int i = 0; i < 4; ++i) {
        const Vec3& p = m.points[static_cast<std::size_t>(i)].p_W;
        EXPECT_NEAR(std::fabs(p.x - 1), 0.5, kEps);
        EXPECT_NEAR(std::fabs(p.y - 2), 0.3, kEps);
        EXPECT_NEAR(p.z, -0.0005, kEps);
    }
}

TEST(CollidePlane, CylinderLyingTouchesWithItsTwoEnds) {
    const Manifold m =
        collide(cylinder(0.1, 0.05), turned(0, 0, 0.102, kPi / 2, 0, 0.4), plane(), at(0, 0, 0), 0.01);
    ASSERT_EQ(m.count, 2);
    EXPECT_EQ(features(m), (std::set<std::uint32_t>{0, 1}));
    expect_all_gaps(m, 0.002);
    EXPECT_NEAR(norm(m.points[0].p_W - m.points[1].p_W), 0.1, kEps);
}

TEST(CollidePlane, CylinderStandingTouchesWithFourRimPoints) {
    const Manifold m = collide(cylinder(0.1, 0.3), turned(0, 0, 0.3, 0, 0, 0.7), plane(), at(0, 0, 0), 0.01);
    ASSERT_EQ(m.count, 4);
    EXPECT_EQ(features(m), (std::set<std::uint32_t>{2, 3, 4, 5}));
    expect_all_gaps(m, 0.0);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(norm(m.points[static_cast<std::size_t>(i)].p_W), 0.1, kEps);
}

TEST(CollidePlane, NoiseDoesNotTurnTheRimPointsOfAStandingCylinder) {
    const Manifold a =
        collide(cylinder(0.1, 0.3), turned(0, 0, 0.3, 1e-9, -2e-9, 0.7), plane(), at(0, 0, 0), 0.01);
    const Manifold b =
        collide(cylinder(0.1, 0.3), turned(0, 0, 0.3, -3e-9, 1e-9, 0.7), plane(), at(0, 0, 0), 0.01);
    ASSERT_EQ(a.count, 4);
    ASSERT_EQ(b.count, 4);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(a.points[i].feature, b.points[i].feature);
        EXPECT_NEAR(norm(a.points[i].p_W - b.points[i].p_W), 0, 1e-8);
    }
}

TEST(CollidePlane, CapsuleLyingTouchesWithItsTwoEnds) {
    const Manifold m =
        collide(capsule(0.1, 0.5), turned(0, 0, 0.1, 0, kPi / 2, 0), plane(), at(0, 0, 0), 0.01);
    ASSERT_EQ(m.count, 2);
    expect_all_gaps(m, 0.0);
}

TEST(CollidePlane, PlaneAgainstPlaneGivesNothing) {
    EXPECT_EQ(collide(plane(), at(0, 0, 0), plane(), turned(0, 0, 0, 1, 0, 0), 1.0).count, 0);
}

TEST(CollideSphere, CentreInsideABoxIsPushedOutOfTheNearestFace) {
    const Manifold m = collide(sphere(0.1), at(0.45, 0.1, 0), box(0.5, 0.5, 0.5), at(0, 0, 0), 0.01);
    ASSERT_EQ(m.count, 1);
    EXPECT_EQ(m.n_W, (Vec3{1, 0, 0}));
    EXPECT_NEAR(m.points[0].gap, -0.15, kEps);
}

TEST(CollideSphere, CoincidentCentresGiveAFiniteUnitNormal) {
    for (const Shape& other : {sphere(0.2), box(0.1, 0.1, 0.1), cylinder(0.2, 0.2), capsule(0.2, 0.2)}) {
        const Manifold m = collide(sphere(0.1), at(1, 2, 3), other, at(1, 2, 3), 0.01);
        ASSERT_EQ(m.count, 1);
        EXPECT_NEAR(norm(m.n_W), 1.0, kEps);
        EXPECT_TRUE(is_finite(m.points[0].p_W));
        EXPECT_LT(m.points[0].gap, 0.0);
    }
}

TEST(CollideBoxBox, AlignedBoxesOfOneSizeStandOnFourPoints) {
    for (double noise : {0.0, 1e-15, -1e-12, 1e-9, -1e-7}) {
        const Shape cube = box(0.5, 0.5, 0.5);
        const Manifold m =
            collide(cube, turned(noise, -noise, 0.9995, noise, -noise, noise), cube, at(0, 0, 0), 0.01);
        ASSERT_EQ(m.count, 4);
        expect_all_gaps(m, -0.0005, 1e-6);
        EXPECT_NEAR(m.n_W.z, 1.0, kEps);
        const Manifold still = collide(cube, at(0, 0, 0.9995), cube, at(0, 0, 0), 0.01);
        EXPECT_EQ(features(m), features(still));
    }
}

TEST(CollideBoxBox, TurnedByFortyFiveDegreesStandsOnAnOctagon) {
    const Shape cube = box(0.5, 0.5, 0.5);
    const Manifold m = collide(cube, turned(0, 0, 1.001, 0, 0, kPi / 4), cube, at(0, 0, 0), 0.01);
    EXPECT_EQ(m.count, 8);
    EXPECT_EQ(features(m).size(), 8u);
    expect_all_gaps(m, 0.001);
}

TEST(CollideBoxBox, CrossedEdgesTouchInOnePoint) {
    const Shape cube = box(0.5, 0.5, 0.5);
    const double rise = std::sqrt(0.5);
    const Manifold m = collide(cube, turned(0, 0, 2 * rise - 0.01, kPi / 4, 0, kPi / 2), cube,
                               turned(0, 0, 0, kPi / 4, 0, 0), 0.01);
    ASSERT_EQ(m.count, 1);
    EXPECT_NEAR(m.n_W.z, 1.0, kEps);
    EXPECT_NEAR(m.points[0].gap, -0.01, kEps);
    EXPECT_NEAR(norm(m.points[0].p_W - Vec3{0, 0, rise - 0.005}), 0, kEps);
}

TEST(CollideBoxBox, SmallBoxStandsOnItsCornersOnALargeOne) {
    const Manifold m =
        collide(box(50, 50, 0.5), at(0, 0, -0.5), box(0.1, 0.1, 0.1), turned(3, 4, 0.1, 0, 0, 0.3), 0.01);
    ASSERT_EQ(m.count, 4);
    EXPECT_NEAR(m.n_W.z, -1.0, kEps);
    expect_all_gaps(m, 0.0);
}

}  // namespace
}  // namespace roboss
