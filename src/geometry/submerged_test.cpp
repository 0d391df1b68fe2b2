// Submerged parts against closed forms, against Monte Carlo sums and against each other.
#include "geometry/submerged.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/fixed_math.h"
#include "core/noise.h"
#include "geometry/convex_hull.h"

namespace roboss {
namespace {

Shape shape_of(ShapeKind kind) {
    Shape s;
    s.kind = kind;
    s.half = {0.3, 0.5, 0.2};
    s.radius = 0.4, s.half_length = 0.6;
    return s;
}

constexpr ShapeKind kSolids[] = {ShapeKind::kSphere, ShapeKind::kBox, ShapeKind::kCylinder,
                                 ShapeKind::kCapsule, ShapeKind::kEllipsoid};

bool holds(const Shape& s, const Vec3& x) {
    switch (s.kind) {
        case ShapeKind::kSphere:
            return norm(x) < s.radius;
        case ShapeKind::kBox:
            return std::fabs(x.x) < s.half.x && std::fabs(x.y) < s.half.y && std::fabs(x.z) < s.half.z;
        case ShapeKind::kCylinder:
            return x.x * x.x + x.y * x.y < s.radius * s.radius && std::fabs(x.z) < s.half_length;
        case ShapeKind::kCapsule: {
            const double z = std::max(std::fabs(x.z) - s.half_length, 0.0);
            return x.x * x.x + x.y * x.y + z * z < s.radius * s.radius;
        }
        default:
            return norm(Vec3{x.x / s.half.x, x.y / s.half.y, x.z / s.half.z}) < 1;
    }
}

class Draws {
  public:
    explicit Draws(std::uint64_t seed) : stream_{seed, 0, 0, 0} {}
    double between(double low, double high) { return low + (high - low) * random_uniform(stream_, index_++); }
    Quat turn() {
        Quat q;
        do {
            q = {between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1)};
        } while (!(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z < 1));
        return normalized(q);
    }

  private:
    NoiseStream stream_;
    std::uint64_t index_ = 0;
};

Transform turned(const Quat& q, const Vec3& p) {
    return {to_matrix(q), p};
}

TEST(Submerged, VolumeAndCentreAreThoseOfMonteCarlo) {
    Draws draws(1);
    for (const ShapeKind kind : kSolids) {
        const Shape s = shape_of(kind);
        for (int attitude = 0; attitude < 6; ++attitude) {
            const Transform X = turned(draws.turn(), {1, 2, 3});
            const double height = 3 + draws.between(-0.5, 0.5);
            constexpr int kPoints = 200000;
            const double side = 1.1;
            Submerged counted;
            for (int i = 0; i < kPoints; ++i) {
                const Vec3 x{draws.between(-side, side), draws.between(-side, side),
                             draws.between(-side, side)};
                const Vec3 at = X * x;
                if (!holds(s, x) || at.z >= height) continue;
                counted.volume += 1, counted.moment += at - X.p;
            }
            const double each = 8 * side * side * side / kPoints;
            const Submerged part = submerged_part(s, X, height);
            EXPECT_NEAR(part.volume, counted.volume * each, 0.012) << static_cast<int>(kind);
            EXPECT_LT(norm(part.moment - counted.moment * each), 0.009) << static_cast<int>(kind);
        }
    }
}

// The derivative of the volume by the height is the area of the cut, and that of the moment is its first
// moment: so the moment's vertical part is height * volume less the integral of the volume (by parts).
TEST(Submerged, MomentIsTheIntegralOfTheVolume) {
    Draws draws(2);
    for (const ShapeKind kind : kSolids) {
        const Shape s = shape_of(kind);
        for (int attitude = 0; attitude < 8; ++attitude) {
            const Transform X = turned(draws.turn(), {});
            const double top = draws.between(-0.3, 0.6), bottom = -1.1;
            constexpr int kSteps = 4000;
            double integral = 0;  // Simpson
            for (int i = 0; i <= kSteps; ++i) {
                const double z = bottom + (top - bottom) * i / kSteps;
                const double weight = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
                integral += weight * submerged_part(s, X, z).volume;
            }
            integral *= (top - bottom) / kSteps / 3;
            const Submerged part = submerged_part(s, X, top);
            EXPECT_NEAR(part.moment.z, top * part.volume - integral, 1e-8) << static_cast<int>(kind);
        }
    }
}

TEST(Submerged, BothSidesOfThePlaneMakeTheWhole) {
    Draws draws(3);
    for (const ShapeKind kind : kSolids) {
        const Shape s = shape_of(kind);
        for (int i = 0; i < 2000; ++i) {
            const Quat q = draws.turn();
            const Transform X = turned(q, {});
            const Transform flipped = turned(Quat{0, 1, 0, 0} * q, {});
            const double d = draws.between(-0.7, 0.7);
            const Submerged below = submerged_part(s, X, d), above = submerged_part(s, flipped, -d);
            ASSERT_NEAR(below.volume + above.volume, solid_volume(s), 2e-13) << static_cast<int>(kind) << i;
            const Vec3 back{above.moment.x, -above.moment.y, -above.moment.z};
            ASSERT_LT(norm(below.moment + back), 2e-13) << static_cast<int>(kind) << i;
        }
    }
}

TEST(Submerged, AxesAlongAndAcrossThePlaneAreNoExceptions) {
    for (const ShapeKind kind : {ShapeKind::kCylinder, ShapeKind::kCapsule}) {
        const Shape s = shape_of(kind);
        for (const double base : {0.0, 0.5 * kPi, kPi, -0.5 * kPi}) {
            for (const double d : {-0.3, 0.0, 0.2}) {
                const auto at = [&](double off) {
                    const double half = 0.5 * (base + off);
                    return submerged_part(s, turned({std::cos(half), std::sin(half), 0, 0}, {}), d);
                };
                const Submerged here = at(0);
                for (const double off : {1e-15, -1e-13, 1e-9, -1e-7, 3e-6, 2e-5, 1e-3}) {
                    ASSERT_NEAR(at(off).volume, here.volume, 1e-12 + std::fabs(off)) << base << " " << off;
                    ASSERT_LT(norm(at(off).moment - here.moment), 1e-12 + std::fabs(off))
                        << base << " " << off;
                }
            }
        }
    }
}

TEST(Submerged, AHalfSunkCapsuleOnItsSide) {
    const Shape s = shape_of(ShapeKind::kCapsule);
    const Submerged part = submerged_part(s, turned({std::sqrt(0.5), std::sqrt(0.5), 0, 0}, {}), 0);
    const double r = s.radius, L = s.half_length;
    EXPECT_NEAR(part.volume, 0.5 * solid_volume(s), 1e-14);
    const double expected = -2 * L * 2.0 / 3 * r * r * r - kPi * r * r * r * r / 4;  // half discs, half ball
    EXPECT_NEAR(part.moment.z, expected, 1e-14);
    EXPECT_NEAR(norm(Vec3{part.moment.x, part.moment.y, 0}), 0, 1e-14);
}

TEST(Submerged, AHullIsAsItsBox) {
    const Shape box = shape_of(ShapeKind::kBox);
    std::vector<Vec3> corners;
    for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0})
            for (const double z : {-1.0, 1.0})
                corners.push_back({x * box.half.x, y * box.half.y, z * box.half.z});
    const auto hull = build_hull(corners);
    ASSERT_TRUE(hull);
    const Shape as_hull = hull_shape(hull.value());
    Draws draws(4);
    for (int i = 0; i < 500; ++i) {
        const Transform X = turned(draws.turn(), {});
        const double d = draws.between(-0.7, 0.7);
        const Submerged a = submerged_part(box, X, d), b = submerged_part(as_hull, X, d);
        ASSERT_NEAR(a.volume, b.volume, 1e-14);
        ASSERT_LT(norm(a.moment - b.moment), 1e-14);
    }
}

TEST(Submerged, AnUprightBoxIsItsDepth) {
    const Shape box = shape_of(ShapeKind::kBox);
    for (const double d : {-0.2, -0.1, 0.0, 0.15, 0.2}) {
        const Submerged part = submerged_part(box, Transform{}, d);
        EXPECT_NEAR(part.volume, 0.6 * 1.0 * (0.2 + d), 1e-15);
        EXPECT_NEAR(part.moment.z, part.volume * 0.5 * (d - 0.2), 1e-15);
    }
}

TEST(Submerged, WhatIsFarBelowIsWhole) {
    for (const ShapeKind kind : kSolids) {
        const Shape s = shape_of(kind);
        EXPECT_EQ(submerged_part(s, turned({1, 0, 0, 0}, {0, 0, -1e4}), 0).volume, solid_volume(s));
        EXPECT_EQ(submerged_part(s, turned({1, 0, 0, 0}, {0, 0, 1e4}), 0).volume, 0);
    }
}

}  // namespace
}  // namespace roboss
