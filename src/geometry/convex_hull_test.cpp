// Hulls: what is on them, that they enclose everything, and that merging leaves the faces of a box.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "geometry/convex_hull.h"

namespace roboss {
namespace {

double in(std::mt19937_64& engine, double low, double high) {
    return low + (high - low) * (static_cast<double>(engine() >> 11) * 0x1p-53);
}

std::vector<Vec3> box_grid(const Vec3& half, int cells) {
    std::vector<Vec3> points;
    for (int i = 0; i <= cells; ++i)
        for (int j = 0; j <= cells; ++j)
            for (int k = 0; k <= cells; ++k)
                points.push_back({half.x * (2.0 * i / cells - 1), half.y * (2.0 * j / cells - 1),
                                  half.z * (2.0 * k / cells - 1)});
    return points;
}

TEST(ConvexHull, OfAGridInABoxHasSixFacesTwelveEdgesAndEightCorners) {
    for (const int cells : {1, 2, 7}) {
        const auto hull = build_hull(box_grid({0.5, 0.3, 0.2}, cells));
        ASSERT_TRUE(hull.ok());
        EXPECT_EQ(hull.value().vertices.size(), 8u);
        EXPECT_EQ(hull.value().faces.size(), 6u);
        EXPECT_EQ(hull.value().edges.size(), 12u);
        EXPECT_NEAR(hull.value().volume, 8 * 0.5 * 0.3 * 0.2, 1e-15);
        EXPECT_NEAR(norm(hull.value().centroid), 0, 1e-15);
        EXPECT_NEAR(hull.value().inradius, 0.2, 1e-15);
    }
}

TEST(ConvexHull, CoordinatesInSinglePrecisionStillGiveSixFaces) {
    std::mt19937_64 engine(3);
    for (int round = 0; round < 50; ++round) {
        const Vec3 x = normalized(Vec3{in(engine, -1, 1), in(engine, -1, 1), in(engine, 0.1, 1)});
        Vec3 y, z;
        tangents(x, y, z);
        std::vector<Vec3> points;
        for (const Vec3& p : box_grid({0.5, 0.3, 0.2}, 4)) {
            const Vec3 q = x * p.x + y * p.y + z * p.z;
            points.push_back({static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)});
        }
        const auto hull = build_hull(points);
        ASSERT_TRUE(hull.ok());
        EXPECT_EQ(hull.value().faces.size(), 6u);
        EXPECT_EQ(hull.value().vertices.size(), 8u);
    }
}

TEST(ConvexHull, HoldsAllItsPointsAndIsConvex) {
    std::mt19937_64 engine(1);
    for (int round = 0; round < 200; ++round) {
        const auto count = 4 + engine() % 400;
        const bool round_body = round % 2 == 0;
        std::vector<Vec3> points;
        for (std::size_t i = 0; i < count; ++i) {
            Vec3 p{in(engine, -1, 1), in(engine, -1, 1), in(engine, -1, 1)};
            if (round_body) p = normalized(p);
            if (round % 3 == 0) p = {std::floor(4 * p.x), std::floor(4 * p.y), std::floor(4 * p.z)};
            points.push_back(p);
        }
        const auto built = build_hull(points);
        if (!built) continue;
        const ConvexHull& hull = built.value();
        for (const ConvexHull::Face& face : hull.faces) {
            for (const Vec3& p : points) EXPECT_LE(dot(face.n, p - hull.centroid), face.offset + 1e-5);
        }
        EXPECT_EQ(hull.vertices.size() + hull.faces.size(), hull.edges.size() + 2);
        for (int i = 0; i < 20; ++i) {
            const Vec3 d = normalized(Vec3{in(engine, -1, 1), in(engine, -1, 1), in(engine, -1, 1)});
            EXPECT_EQ(hull.furthest(d), furthest_of_all(d, hull.vertices));
        }
    }
}

TEST(ConvexHull, FlatThinOrWrongPointsAreRefused) {
    EXPECT_FALSE(build_hull({}).ok());
    EXPECT_FALSE(build_hull(std::vector<Vec3>(10, Vec3{1, 2, 3})).ok());
    EXPECT_FALSE(build_hull(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).ok());
    EXPECT_FALSE(
        build_hull(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3, 0.2, 0}}).ok());
    EXPECT_FALSE(build_hull(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::nan("")}}).ok());
    EXPECT_FALSE(build_hull(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1e300}}).ok());
}

}  // namespace
}  // namespace roboss
