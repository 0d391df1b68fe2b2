// A proof must never accept a direction that the search of all directions beats, and must spare most
// searches.
#include "geometry/best_of_all.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include <support/random.h>

#include "geometry/closest_direction.h"

namespace roboss::narrow {
namespace {

class BestOfAll : public testing::Test {
  protected:
    /// A box, cylinder or capsule.
    Shape shape() {
        constexpr ShapeKind kKinds[] = {ShapeKind::kBox, ShapeKind::kCylinder, ShapeKind::kCapsule};
        Shape shape;
        shape.kind = kKinds[random_.integer(0, 2)];
        shape.half = {in(0.02, 1), in(0.02, 1), in(0.02, 1)};
        shape.radius = in(0.02, 1), shape.half_length = in(0.02, 1);
        return shape;
    }
    double in(double low, double high) { return random_.uniform(low, high); }
    Transform pose() {
        Transform X;
        X.R = to_matrix(random_.rotation());
        return X;
    }
    /// Moves the first shape along a random ray to where the distance is `distance`, so that all features
    /// meet as often as they make up the surface of the sum.
    void place(const Shape& a, const Shape& b, double distance, Transform& X_WA, const Transform& X_WB) {
        X_WA.p = X_WB.p;
        const ConvexSum sum({a, X_WA}, {b, X_WB});
        const Vec3 ray = normalized(random_.vector(1));
        double low = 0, high = 10;
        for (int k = 0; k < 40; ++k) {
            const double middle = 0.5 * (low + high);
            const ConvexSum moved = sum.moved(ray * middle);
            (closest_direction(moved, moved.best_natural(1e300), 1e300).s < distance ? low : high) = middle;
        }
        X_WA.p += ray * low;
    }

  private:
    test::Random random_{7};
};

TEST_F(BestOfAll, NoSearchFindsABetterDirectionThanAProvenOne) {
    constexpr int kPairs = 3'000;
    int proven = 0, apart = 0;
    for (int i = 0; i < kPairs; ++i) {
        Shape a = shape(), b = shape();
        if (a.kind > b.kind) std::swap(a, b);
        const double size = ConvexSum({a, pose()}, {b, pose()}).scale();
        const double distance = (i % 4 == 0 ? 1 : -1) * size * std::pow(10.0, in(-6, -0.5));
        Transform X_WA = pose();
        const Transform X_WB = pose();
        place(a, b, distance, X_WA, X_WB);
        const Posed first{a, X_WA}, second{b, X_WB};
        const ConvexSum sum(first, second);
        const Separation natural = sum.best_natural(1e300);
        Separation best = sum.at_kink(natural);
        if (!is_best_of_all(first, second, sum, best)) best = sum.polished(natural);
        if (!is_best_of_all(first, second, sum, best)) continue;
        (best.s < 0 ? proven : apart) += 1;
        EXPECT_LE(closest_direction(sum, natural, 1e300).s, best.s + 3e-6 * sum.scale()) << i;
    }
    EXPECT_GT(proven, 1'200) << "of 2250 that overlap";
    EXPECT_GT(apart, 450) << "of 750";
}

}  // namespace
}  // namespace roboss::narrow
