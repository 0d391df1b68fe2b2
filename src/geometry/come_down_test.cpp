// Shapes that come down onto others: closed forms.
#include <gtest/gtest.h>

#include <support/random.h>

#include <cmath>

#include "geometry/collide.h"
#include "geometry/come_down.h"
#include "geometry/height_field.h"
#include "geometry/triangle_mesh.h"

namespace roboss::test {
namespace {

Shape ball(double radius) {
    Shape s;
    s.radius = radius;
    return s;
}

Shape box(const Vec3& half) {
    Shape s;
    s.kind = ShapeKind::kBox, s.half = half;
    return s;
}

Shape rod(ShapeKind kind, double radius, double half_length) {
    Shape s;
    s.kind = kind, s.radius = radius, s.half_length = half_length;
    return s;
}

Shape plane() {
    Shape s;
    s.kind = ShapeKind::kPlane;
    return s;
}

Transform at(const Vec3& p, const Quat& q = {}) {
    return to_transform(Pose{p, q});
}

constexpr double kClose = 1e-7;

TEST(ComeDown, OntoAPlaneFromAboveAndFromBelow) {
    for (const double z : {5.0, 0.1, -3.0})
        EXPECT_NEAR(come_down(ball(0.2), at({1, 2, z}), 0.1, plane(), {}).value(), 0.2 - z, kClose);
    const double tilt = 0.3;
    const Transform slope = at({}, from_rpy(0, tilt, 0));  // it falls towards +x
    const double t = come_down(ball(0.2), at({1, 0, 4}), 0.1, plane(), slope).value();
    EXPECT_NEAR(4 + t, 0.2 / std::cos(tilt) - std::tan(tilt), kClose);
    EXPECT_FALSE(come_down(ball(0.2), at({}), 1, plane(), at({}, from_rpy(kPi / 2, 0, 0)))) << "a wall";
    EXPECT_FALSE(come_down(ball(0.2), at({}), 1, plane(), at({}, from_rpy(kPi, 0, 0)))) << "a ceiling";
}

TEST(ComeDown, APointRisesOutOfTheSolidThatItLiesIn) {
    const Shape block = box({1, 1, 0.5});
    EXPECT_NEAR(rise_out({0.3, 0, 1.7}, block, at({0, 0, 2})).value(), 0.8, kClose);
    EXPECT_FALSE(rise_out({0.3, 0, 1.4}, block, at({0, 0, 2}))) << "below it";
    EXPECT_FALSE(rise_out({1.1, 0, 2}, block, at({0, 0, 2}))) << "beside it";
    EXPECT_NEAR(rise_out({0.3, 0, 0.1}, ball(0.5), {}).value(), 0.4 - 0.1, kClose);
    EXPECT_FALSE(rise_out({0.4, 0.4, 0.4}, ball(0.5), {})) << "in its bounds alone";
    EXPECT_NEAR(rise_out({0.2, 0, 0}, rod(ShapeKind::kCapsule, 0.3, 1), {}).value(), 1 + std::sqrt(0.05),
                kClose);
    EXPECT_FALSE(rise_out({0, 0, -1}, plane(), {}));
    const double tilt = 0.2;
    EXPECT_NEAR(rise_out({}, block, at({}, from_rpy(tilt, 0, 0))).value(), 0.5 / std::cos(tilt), kClose);
}

TEST(ComeDown, OntoConvexShapes) {
    const Shape table = box({1, 1, 0.5});
    EXPECT_NEAR(come_down(box({0.1, 0.1, 0.1}), at({0.9, 0, 2}), 0, table, {}).value(), -1.4, kClose);
    EXPECT_FALSE(come_down(box({0.1, 0.1, 0.1}), at({1.2, 0, 2}), 0, table, {})) << "it passes by";
    EXPECT_FALSE(come_down(box({0.1, 0.1, 0.1}), at({0, 0, -2}), 0.2, table, {})) << "it is below";
    EXPECT_NEAR(come_down(box({0.1, 0.1, 0.1}), at({0, 0, 0.45}), 0.2, table, {}).value(), 0.15, kClose)
        << "lifted out of it";
    // A ball beside the top edge of a box: 0.3 beyond the edge, radius 0.5.
    EXPECT_NEAR(come_down(ball(0.5), at({1.3, 0, 2}), 0, table, {}).value(), 0.5 + 0.4 - 2, kClose);
    EXPECT_NEAR(come_down(ball(0.5), at({0.3, 0.4, 3}), 0, ball(1), {}).value(), std::sqrt(2.25 - 0.25) - 3,
                kClose);
    // A lying cylinder over a crossing one.
    const Transform along_x = at({0, 0, 3}, from_rpy(0, kPi / 2, 0)),
                    along_y = at({}, from_rpy(kPi / 2, 0, 0));
    for (const ShapeKind kind : {ShapeKind::kCylinder, ShapeKind::kCapsule})
        EXPECT_NEAR(come_down(rod(kind, 0.2, 1), along_x, 0, rod(kind, 0.3, 1), along_y).value(), 0.5 - 3,
                    kClose);
}

TEST(ComeDown, OntoAHeightFieldFromInsideTheGroundToo) {
    // z = x / 2 over 4 m by 4 m: a slope of triangles.
    const std::vector<double> heights{-1, 0, 1, -1, 0, 1, -1, 0, 1};
    const HeightField field(3, 3, heights, 4, 4);
    const Shape ground = surface_shape(field);
    const double on_it = 0.3 * std::sqrt(1.25);  // height of the centre of a ball over a point of the slope
    for (const double z : {7.0, 0.2, -6.0})
        EXPECT_NEAR(z + come_down(ball(0.3), at({0.5, 0.3, z}), 0.1, ground, {}).value(), 0.25 + on_it,
                    kClose);
    EXPECT_FALSE(come_down(ball(0.3), at({9, 0, 1}), 0.1, ground, {})) << "beside it";
}

Shape random_shape(Random& random) {
    Shape s;
    constexpr ShapeKind kKinds[] = {ShapeKind::kSphere, ShapeKind::kBox, ShapeKind::kCylinder,
                                    ShapeKind::kCapsule, ShapeKind::kEllipsoid};
    s.kind = kKinds[random.integer(0, 4)];
    s.half = {random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1)};
    s.radius = random.uniform(0.1, 1), s.half_length = random.uniform(0.1, 1);
    return s;
}

double least_gap_of(const Manifold& m) {
    double gap = 1e300;
    for (int i = 0; i < m.count; ++i) gap = std::min(gap, m.points[static_cast<std::size_t>(i)].gap);
    return gap;
}

TEST(ComeDown, TouchesAtTheEndAndNeverOnTheWayThere) {
    int met = 0;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const Shape a = random_shape(random), b = random_shape(random);
        const Transform X_A =
            at({random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), 0}, random.rotation());
        const Transform X_B = at({0, 0, random.uniform(-2, 2)}, random.rotation());
        const auto gap_at = [&](double t) {
            return least_gap_of(collide(a, {X_A.R, X_A.p + Vec3{0, 0, t}}, b, X_B, 1e-3));
        };
        const auto t = come_down(a, X_A, 10, b, X_B);
        met += t ? 1 : 0;
        for (double up = t.value_or(-10) + 1e-5; up < 10; up += 0.03) ASSERT_GT(gap_at(up), -1e-7);
        if (t) {
            EXPECT_NEAR(gap_at(*t), 0, 1e-6);
        }
    }
    EXPECT_GT(met, 200);
}

TEST(ComeDown, OntoTheHighestTriangleOfAMeshThatIsBelow) {
    // Two sheets: a floor at 0 and a roof at 3.
    const std::vector<Vec3> v{{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0},
                              {-2, -2, 3}, {2, -2, 3}, {2, 2, 3}, {-2, 2, 3}};
    const std::vector<TriangleMesh::Corners> t{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
    const TriangleMesh mesh(v, t);
    const Shape house = surface_shape(mesh);
    EXPECT_NEAR(come_down(ball(0.5), at({0.2, 0.3, 1}), 1, house, {}).value(), -0.5, kClose);
    EXPECT_NEAR(come_down(ball(0.5), at({0.2, 0.3, 0.1}), 1, house, {}).value(), 0.4, kClose);
    EXPECT_NEAR(come_down(ball(0.5), at({0.2, 0.3, 4}), 1, house, {}).value(), -0.5, kClose) << "on the roof";
    const Transform moved = at({10, 0, 1}, from_rpy(0, 0, 0.7));
    EXPECT_NEAR(come_down(ball(0.5), at({10.2, 0.3, 2}), 1, house, moved).value(), -0.5, kClose);
}

}  // namespace
}  // namespace roboss::test
