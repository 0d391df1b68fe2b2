// Cells of directions: a look at one cell finds what a look at all vertices finds, whatever the body and the
// direction.
#include "geometry/direction_cells.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/convex_hull.h"
#include "geometry/shape.h"

namespace roboss {
namespace {

class RandomBodies {
  public:
    explicit RandomBodies(std::uint64_t seed) : engine_(seed) {}

    double in(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
    }
    Vec3 vector() { return {in(-1, 1), in(-1, 1), in(-1, 1)}; }

    /// Balls, boxes of points, needles, plates, ones far from the origin, ones with points on a grid (many
    /// equals), and ones with each point twice.
    std::vector<Vec3> points(std::size_t count, int kind) {
        std::vector<Vec3> result;
        while (result.size() < count) {
            Vec3 p = vector();
            if (kind == 0 || kind == 6) p = normalized(p);
            if (kind == 2) p.x *= 1e-4, p.z *= 1e-7;
            if (kind == 3) p.y = 0;
            if (kind == 4) p += Vec3{30, -20, 10};
            if (kind == 5) p = {std::floor(4 * p.x), std::floor(4 * p.y), std::floor(4 * p.z)};
            result.push_back(p);
            if (kind == 6) result.push_back(p);
        }
        return result;
    }

    /// Any, along axes and diagonals (where cells meet), and normals of planes through vertices (equals).
    Vec3 direction(std::span<const Vec3> vertices, int kind) {
        if (kind == 0) return vector() * std::pow(10.0, in(-200, 200));
        if (kind == 1) {
            const auto grid = [&] { return std::floor(in(-8, 9)) / 8; };
            return {grid(), grid(), grid()};
        }
        const auto any = [&] { return vertices[engine_() % vertices.size()]; };
        const Vec3 a = any();
        return cross(any() - a, any() - a);
    }

  private:
    std::mt19937_64 engine_;
};

TEST(DirectionCells, FindWhatALookAtAllVerticesFinds) {
    RandomBodies random(7);
    for (const std::size_t count : {4u, 12u, 32u, 33u, 48u, 60u, 96u, 97u, 300u, 401u, 2000u}) {
        for (int kind = 0; kind < 7; ++kind) {
            const std::vector<Vec3> vertices = random.points(count, kind);
            DirectionCells cells;
            cells.build(vertices);
            ASSERT_EQ(cells.empty(), vertices.size() <= 32) << count;
            for (int i = 0; i < 600; ++i) {
                const Vec3 d = random.direction(vertices, i % 3);
                ASSERT_EQ(cells.furthest(d, vertices), furthest_of_all(d, vertices))
                    << count << " vertices, kind " << kind << ", d " << d.x << " " << d.y << " " << d.z;
            }
        }
    }
}

TEST(DirectionCells, AnswerForEveryDirectionThereIs) {
    RandomBodies random(8);
    const std::vector<Vec3> vertices = random.points(60, 0);
    DirectionCells cells;
    cells.build(vertices);
    const double infinity = INFINITY, nan = std::nan("");
    EXPECT_EQ(cells.furthest({}, vertices), 0u);
    for (const double x : {0.0, 1e-300, -1e-310, 1e300, infinity, -infinity, nan})
        for (const double y : {0.0, -1.0, 1e-300, -infinity, nan})
            for (const double z : {1.0, 0.0, infinity, nan})
                EXPECT_LT(cells.furthest({x, y, z}, vertices), vertices.size());
    for (const double tiny : {1e-290, 1e-305, 5e-324}) {
        const Vec3 d = Vec3{0.3, -0.7, 0.2} * tiny;
        EXPECT_EQ(cells.furthest(d, vertices), furthest_of_all(d, vertices)) << tiny;
    }
}

TEST(DirectionCells, LeaveFewVerticesToLookAt) {
    RandomBodies random(9);
    for (const std::size_t count : {40u, 100u, 200u, 1000u, 4000u}) {
        const std::vector<Vec3> vertices = random.points(count, 0);
        DirectionCells cells;
        cells.build(vertices);
        EXPECT_LT(cells.entries(), 12 * cells.cells()) << count;
    }
}

TEST(DirectionCells, ABoxRoundAHullIsThatOfAllItsVertices) {
    RandomBodies random(10);
    for (const std::size_t count : {8u, 30u, 120u, 700u}) {
        const auto hull = build_hull(random.points(count, 0));
        ASSERT_TRUE(hull.ok());
        const Shape shape = hull_shape(hull.value());
        for (int i = 0; i < 200; ++i) {
            Transform X{{}, random.vector() * 5.0};
            const Vec3 x = normalized(random.vector());
            Vec3 y, z;
            tangents(x, y, z);
            if (i % 4 != 0) X.R = {x, y, z};
            Aabb all;
            for (const Vec3& v : hull.value().vertices) all.include(X * v);
            const Aabb box = bounds(shape, X);
            ASSERT_EQ(box.min, all.min);
            ASSERT_EQ(box.max, all.max);
        }
    }
}

}  // namespace
}  // namespace roboss
