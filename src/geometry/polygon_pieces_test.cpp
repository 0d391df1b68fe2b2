// Pieces of polygons are convex and make up the whole.
#include "geometry/polygon_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/fixed_math.h"

namespace roboss {
namespace {

double area(const std::vector<Vec3>& loop) {
    double twice = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec3 &a = loop[i], &b = loop[(i + 1) % loop.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * twice;
}

void expect_pieces(std::vector<Vec3> outline, double whole, std::size_t count_max) {
    for (int displacement = 0; displacement < 2; ++displacement) {
        const auto pieces = convex_pieces(outline);
        ASSERT_TRUE(pieces.ok()) << pieces.error().message;
        EXPECT_LE(pieces.value().size(), count_max);
        double sum = 0;
        for (const auto& piece : pieces.value()) {
            sum += area(piece);
            for (std::size_t i = 0; i < piece.size(); ++i) {
                const Vec3 &a = piece[i], &b = piece[(i + 1) % piece.size()],
                           &c = piece[(i + 2) % piece.size()];
                EXPECT_GE((b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x), -1e-9);
            }
        }
        EXPECT_NEAR(sum, whole, 1e-12);
        std::reverse(outline.begin(), outline.end());
    }
}

TEST(PolygonPieces, AreConvexAndMakeUpTheWhole) {
    expect_pieces({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 1, 1);
    expect_pieces({{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}}, 1, 1);
    expect_pieces({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}}, 6, 2);
    expect_pieces({{0, 0, 0}, {5, 0, 0}, {5, 3, 0}, {4, 3, 0}, {4, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}, 9,
                  4);
    std::vector<Vec3> star;
    for (int i = 0; i < 14; ++i) {
        const SinCos a = fixed_sincos(2 * kPi * i / 14);
        const double r = i % 2 == 0 ? 1.0 : 0.4;
        star.push_back({r * a.cos, r * a.sin, 0});
    }
    expect_pieces(star, 7 * 1.0 * 0.4 * fixed_sin(2 * kPi / 14), 10);
}

TEST(PolygonPieces, BadOutlinesAreRefused) {
    EXPECT_FALSE(convex_pieces({}).ok());
    EXPECT_FALSE(convex_pieces(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}).ok());
    EXPECT_FALSE(convex_pieces(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}).ok()) << "no area";
    EXPECT_FALSE(convex_pieces(std::vector<Vec3>{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 1, 0}}).ok())
        << "bow tie";
    EXPECT_FALSE(convex_pieces(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, std::nan(""), 0}}).ok());
}

}  // namespace
}  // namespace roboss
