// What stacks, standing cylinders and rolling wheels need of their manifolds: the same features from tick to
// tick under noise, and gaps and points that move no faster than the shapes do.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "geometry/collide.h"
#include "math/quat.h"

namespace roboss {
namespace {

constexpr double kMargin = 0.01;

struct Resting {
    const char* name;
    Shape top;
    Pose X_top;
    Shape bottom;
    Pose X_bottom;
    int points;
};
void PrintTo(const Resting& pair, std::ostream* out) {
    *out << pair.name;
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

const Quat kLying = from_rpy(kPi / 2, 0, 0);

std::vector<Resting> resting_pairs() {
    const Shape ground = box(10, 10, 0.5), plane{ShapeKind::kPlane, {}, 0, 0};
    const Pose below{{0, 0, -0.5}, {}}, origin;
    return {
        {"box on plane", box(0.2, 0.3, 0.1), {{0, 0, 0.1}, {}}, plane, origin, 4},
        {"box on box", box(0.2, 0.3, 0.1), {{0, 0, 0.1}, {}}, ground, below, 4},
        {"cube on equal cube", box(0.5, 0.5, 0.5), {{0, 0, 0.5}, {}}, box(0.5, 0.5, 0.5), below, 4},
        {"overhanging box", box(0.2, 0.3, 0.1), {{0.4, 0, 0.1}, {}}, box(0.5, 0.5, 0.5), below, 4},
        {"wheel on plane", cylinder(0.1, 0.03), {{0, 0, 0.1}, kLying}, plane, origin, 2},
        {"wheel on box", cylinder(0.1, 0.03), {{0, 0, 0.1}, kLying}, ground, below, 2},
        {"wheel over the edge", cylinder(0.1, 0.1), {{0, 0.45, 0.1}, kLying}, box(0.5, 0.5, 0.5), below, 2},
        {"can on plane", cylinder(0.1, 0.3), {{0, 0, 0.3}, {}}, plane, origin, 4},
        {"can on box", cylinder(0.1, 0.3), {{0, 0, 0.3}, {}}, ground, below, 4},
        {"can on equal can", cylinder(0.1, 0.5), {{0, 0, 0.5}, {}}, cylinder(0.1, 0.5), below, 4},
        {"box on can", box(0.3, 0.3, 0.3), {{0, 0, 0.3}, {}}, cylinder(0.1, 0.5), below, 4},
        {"capsule on plane", capsule(0.1, 0.2), {{0, 0, 0.1}, kLying}, plane, origin, 2},
        {"capsule on box", capsule(0.1, 0.2), {{0, 0, 0.1}, kLying}, ground, below, 2},
        {"capsule on capsule",
         capsule(0.1, 0.2),
         {{0, 0, 0.1}, kLying},
         capsule(0.1, 0.3),
         {{0, 0, -0.1}, kLying},
         2},
        {"log on log",
         cylinder(0.1, 0.2),
         {{0, 0, 0.1}, kLying},
         cylinder(0.1, 0.3),
         {{0, 0, -0.1}, kLying},
         2},
    };
}

class RestingPair : public testing::TestWithParam<Resting> {};

TEST_P(RestingPair, KeepsItsFeaturesAndPlacesUnderNoise) {
    const Resting& r = GetParam();
    std::mt19937_64 engine(1);
    const auto noise = [&](double size) {
        return size * (static_cast<double>(engine() >> 11) * 0x1p-52 - 1.0);
    };
    std::map<std::uint32_t, Vec3> places;
    for (const double size : {0.0, 1e-15, 1e-12, 1e-9, 1e-7, 5e-6}) {
        for (int i = 0; i < 200; ++i) {
            Pose X = r.X_top;
            X.p += Vec3{noise(size), noise(size), noise(size)};
            X.q = exponential(Vec3{noise(size), noise(size), noise(size)}) * X.q;
            const Manifold m = collide(r.top, to_transform(X), r.bottom, to_transform(r.X_bottom), kMargin);
            ASSERT_EQ(m.count, r.points) << "noise " << size;
            ASSERT_GT(m.n_W.z, 0.999999);
            for (int k = 0; k < m.count; ++k) {
                const ContactPoint& p = m.points[static_cast<std::size_t>(k)];
                ASSERT_NEAR(p.gap, 0.0, 10 * size + 1e-14);
                const auto [place, is_new] = places.emplace(p.feature, p.p_W);
                ASSERT_NEAR(norm(place->second - p.p_W), 0.0, 1e-3) << "feature " << p.feature;
            }
        }
    }
    EXPECT_EQ(places.size(), static_cast<std::size_t>(r.points));
}

TEST_P(RestingPair, GapsFollowTheDepth) {
    const Resting& r = GetParam();
    for (const double gap : {-5e-3, -1e-3, -1e-6, 1e-6, 1e-3, 9e-3}) {
        Pose X = r.X_top;
        X.p.z += gap;
        const Manifold m = collide(r.top, to_transform(X), r.bottom, to_transform(r.X_bottom), kMargin);
        ASSERT_EQ(m.count, r.points) << gap;
        for (int k = 0; k < m.count; ++k) EXPECT_NEAR(m.points[static_cast<std::size_t>(k)].gap, gap, 1e-13);
    }
}

INSTANTIATE_TEST_SUITE_P(Collide, RestingPair, testing::ValuesIn(resting_pairs()), [](const auto& pair) {
    std::string name = pair.param.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
});

double deepest(const Manifold& m) {
    double gap = 1e300;
    for (int k = 0; k < m.count; ++k) gap = std::min(gap, m.points[static_cast<std::size_t>(k)].gap);
    return gap;
}

TEST(CollideRolling, DeepestGapOfATippingCylinderIsContinuous) {
    for (const Shape& ground : {Shape{ShapeKind::kPlane, {}, 0, 0}, box(10, 10, 0.5)}) {
        const Transform X_ground{Mat3::identity(), {0, 0, ground.kind == ShapeKind::kBox ? -0.5 : 0.0}};
        const Shape can = cylinder(0.1, 0.3);
        double before = 0;
        for (int i = 0; i <= 20000; ++i) {
            const double tilt = kPi / 2 * i / 20000;
            const SinCos t = fixed_sincos(tilt);
            const Pose X{{0, 0, 0.3 * t.cos + 0.1 * t.sin}, from_rpy(0, tilt, 0)};
            const double gap = deepest(collide(can, to_transform(X), ground, X_ground, kMargin));
            ASSERT_NEAR(gap, 0.0, 3e-5 * 0.1) << tilt;  // exact but for the blend below 1e-4 rad
            ASSERT_NEAR(gap, before, 4e-6);
            before = gap;
        }
    }
}

TEST(CollideRolling, AWheelRollingOverAKerbMovesItsNormalContinuously) {
    const Shape kerb = box(0.5, 0.5, 0.05), wheel = cylinder(0.1, 0.03);
    Vec3 before;
    for (int i = 0; i <= 4000; ++i) {
        const double x =
            -0.65 + 0.3 * i / 4000;  // from beside the kerb to its top, over the edge at x = -0.5
        const double beyond = std::max(-0.5 - x, 0.0);
        const double height = beyond < 0.1 ? std::sqrt(0.01 - beyond * beyond) : 0.0;
        const Pose X{{x, 0, 0.05 + height}, kLying};
        const Manifold m = collide(wheel, to_transform(X), kerb, Transform{}, 0.06);
        ASSERT_EQ(m.count, 2) << x;
        ASSERT_NEAR(deepest(m), beyond < 0.1 ? 0.0 : beyond - 0.1, 1e-7) << x;
        ASSERT_TRUE(i == 0 || beyond > 0.0999 || norm(m.n_W - before) < 0.025) << x;
        before = m.n_W;
    }
}

}  // namespace
}  // namespace roboss
