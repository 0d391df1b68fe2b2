// Points made fit for a hull: flat sets get a thickness, large ones lose what a hull hardly misses.
#include "geometry/hull_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/convex_hull.h"

namespace roboss {
namespace {

TEST(HullPoints, FlatStraightAndSinglePointSetsGetAThickness) {
    const std::vector<std::vector<Vec3>> sets{
        {{0, 0, 0}, {1, 0, 1}, {1, 1, 1}, {0, 1, 0}}, {{0, 0, 0}, {1, 2, 3}, {2, 4, 6}}, {{4, 5, 6}}};
    for (const auto& points : sets) {
        const auto hull = build_hull(thickened(points, 0.01));
        ASSERT_TRUE(hull.ok()) << points.size() << " points: " << hull.error().message;
        EXPECT_NEAR(2 * hull.value().inradius, 0.01, 1e-6) << points.size() << " points";
    }
}

TEST(HullPoints, ASolidSetStaysAsItIs) {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    EXPECT_EQ(thickened(points, 0.01), points);
}

TEST(HullPoints, ExtremePointsSpanNearlyTheWholeHull) {
    std::mt19937_64 engine(5);
    const auto coordinate = [&] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1; };
    std::vector<Vec3> ball;
    while (ball.size() < 5000) {
        const Vec3 p{coordinate(), coordinate(), coordinate()};
        if (norm(p) > 0.1 && norm(p) < 1) ball.push_back(p / norm(p));
    }
    const std::vector<Vec3> few = extreme_points(ball);
    EXPECT_LT(few.size(), 1700u);
    const auto hull = build_hull(few);
    ASSERT_TRUE(hull.ok());
    for (const Vec3& p : ball)
        for (const ConvexHull::Face& face : hull.value().faces)
            ASSERT_LT(dot(face.n, p - hull.value().centroid) - face.offset, 0.02);
}

}  // namespace
}  // namespace roboss
