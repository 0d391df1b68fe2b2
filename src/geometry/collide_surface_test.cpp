// Contacts with triangles: what a flat mesh gives is what a box or plane gives, seams are not felt, ridges
// are, and the sides of sheets and solids.
#include "geometry/collide_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "geometry/collide.h"
#include "geometry/convex_hull.h"
#include "geometry/height_field.h"
#include "geometry/triangle_mesh.h"
#include "math/quat.h"

namespace roboss {
namespace {

constexpr double kMargin = 0.01;

struct Random {
    std::mt19937_64 engine;
    explicit Random(std::uint64_t seed) : engine(seed) {}
    double in(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine() >> 11) * 0x1p-53);
    }
};

TriangleMesh floor_mesh(std::uint32_t cells, double size) {
    std::vector<Vec3> points;
    std::vector<TriangleMesh::Corners> triangles;
    const double step = size / cells;
    for (std::uint32_t j = 0; j <= cells; ++j)
        for (std::uint32_t i = 0; i <= cells; ++i)
            points.push_back({i * step - size / 2, j * step - size / 2, 0});
    for (std::uint32_t j = 0; j < cells; ++j)
        for (std::uint32_t i = 0; i < cells; ++i) {
            const std::uint32_t a = j * (cells + 1) + i, b = a + 1, c = b + cells + 1, d = c - 1;
            triangles.push_back({a, b, c}), triangles.push_back({a, c, d});
        }
    return {points, triangles};
}

TriangleMesh block_mesh(const Vec3& h) {
    std::vector<Vec3> points;
    for (int k = 0; k < 8; ++k)
        points.push_back({k & 1 ? h.x : -h.x, k & 2 ? h.y : -h.y, k & 4 ? h.z : -h.z});
    const std::vector<TriangleMesh::Corners> triangles{{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                                       {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                                       {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return {points, triangles};
}

std::vector<Shape> bodies() {
    static const ConvexHull hull =
        build_hull(std::vector<Vec3>{{-0.1, -0.1, -0.05}, {0.1, -0.1, -0.05}, {0, 0.12, -0.05}, {0, 0, 0.15}})
            .value();
    return {{ShapeKind::kSphere, {}, 0.1, 0},
            {ShapeKind::kBox, {0.1, 0.15, 0.05}, 0, 0},
            {ShapeKind::kCylinder, {}, 0.1, 0.08},
            {ShapeKind::kCapsule, {}, 0.06, 0.1},
            {ShapeKind::kEllipsoid, {0.1, 0.15, 0.07}, 0, 0},
            hull_shape(hull)};
}

double smallest_gap(const SurfaceContacts& c) {
    double gap = 1e300;
    for (const SurfaceContact& p : c.points) gap = std::min(gap, p.gap);
    return gap;
}

TEST(CollideSurface, AFlatMeshGivesThePlanesDeepestGapAndOnlyItsNormal) {
    const TriangleMesh floor = floor_mesh(40, 4);
    const HeightField field(41, 41, std::vector<double>(41 * 41, 0.0), 4, 4);
    const Shape plane{ShapeKind::kPlane, {}, 0, 0};
    Random random(1);
    SurfaceContacts contacts;
    int touching = 0;
    for (int i = 0; i < 3000; ++i) {
        for (const Shape& body : bodies()) {
            Transform X;
            const Vec3 rpy{random.in(-3, 3), random.in(-3, 3), random.in(-3, 3)};
            X.R = to_matrix(i % 3 == 0 ? from_rpy(0, 0, rpy.z) : from_rpy(rpy.x, rpy.y, rpy.z));
            X.p = {random.in(-1, 1), random.in(-1, 1), 0};
            X.p.z = -bounds(body, X).min.z + random.in(-0.002, 0.015);
            const Manifold expected = collide(body, X, plane, {}, kMargin);
            double gap = 1e300;
            for (int k = 0; k < expected.count; ++k)
                gap = std::min(gap, expected.points[static_cast<std::size_t>(k)].gap);
            for (const TriangleSurface* surface :
                 {static_cast<const TriangleSurface*>(&floor), static_cast<const TriangleSurface*>(&field)}) {
                collide_surface(body, X, *surface, {}, kMargin, contacts);
                ASSERT_EQ(contacts.points.empty(), expected.count == 0) << i;
                if (expected.count == 0) continue;
                ++touching;
                // Four points of a cylinder's rim stand for it on a plane, eight here.
                ASSERT_NEAR(smallest_gap(contacts), gap, body.kind == ShapeKind::kCylinder ? 1e-5 : 1e-12)
                    << i;
                std::set<std::uint32_t> features;
                for (const SurfaceContact& c : contacts.points) {
                    ASSERT_NEAR(norm(c.n_W - Vec3{0, 0, 1}), 0, 1e-9);
                    ASSERT_NEAR(c.p_W.z, 0.5 * c.gap, 1e-12);
                    ASSERT_TRUE(features.insert(c.feature).second);
                }
                ASSERT_LE(contacts.points.size(), 8u);
            }
        }
    }
    EXPECT_GT(touching, 10000);
}

TEST(CollideSurface, AMeshBlockGivesABoxsGap) {
    const Vec3 half{0.5, 0.4, 0.3};
    const TriangleMesh block = block_mesh(half);
    const Shape box{ShapeKind::kBox, half, 0, 0};
    Random random(2);
    SurfaceContacts contacts;
    int touching = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto all = bodies();
        const Shape& body = all[static_cast<std::size_t>(i) % all.size()];
        Transform X;
        X.R = to_matrix(from_rpy(random.in(-3, 3), random.in(-3, 3), random.in(-3, 3)));
        X.p = {random.in(-0.8, 0.8), random.in(-0.7, 0.7), random.in(-0.6, 0.6)};
        const Manifold expected = collide(body, X, box, {}, kMargin);
        double gap = 1e300;
        for (int k = 0; k < expected.count; ++k)
            gap = std::min(gap, expected.points[static_cast<std::size_t>(k)].gap);
        collide_surface(body, X, block, {}, kMargin, contacts);
        if (expected.count == 0) {
            ASSERT_TRUE(contacts.points.empty()) << i;
        } else if (gap > -0.001) {  // deep inside a mesh there is no one way out
            ++touching;
            ASSERT_FALSE(contacts.points.empty()) << i;
            // An edge against an edge may be replaced by a face a degree aside (see docs/physics.md).
            EXPECT_NEAR(smallest_gap(contacts), gap, 2e-3 * std::fabs(gap) + 2e-4) << i;
        }
    }
    EXPECT_GT(touching, 300);
}

TEST(CollideSurface, ASheetHoldsOnBothSidesASolidOnlyOutside) {
    const TriangleMesh sheet = floor_mesh(4, 4), block = block_mesh({1, 1, 1});
    EXPECT_EQ(sheet.sides(), SurfaceSides::kBoth);
    EXPECT_EQ(block.sides(), SurfaceSides::kSolid);
    const Shape ball{ShapeKind::kSphere, {}, 0.1, 0};
    SurfaceContacts contacts;
    for (const double side : {1.0, -1.0}) {
        collide_surface(ball, {Mat3::identity(), {0.3, 0.2, 0.099 * side}}, sheet, {}, kMargin, contacts);
        ASSERT_EQ(contacts.points.size(), 1u);
        EXPECT_NEAR(contacts.points[0].n_W.z, side, 1e-12);
        EXPECT_NEAR(contacts.points[0].gap, -0.001, 1e-12);
    }
    collide_surface(ball, {Mat3::identity(), {0.3, 0.2, 0.95}}, block, {}, kMargin, contacts);
    EXPECT_TRUE(contacts.points.empty()) << "the centre is inside";
}

TEST(CollideSurface, GroundPushesUpWhatHasSunkIntoIt) {
    const HeightField field(9, 9, std::vector<double>(81, 0.5), 8, 8);
    SurfaceContacts contacts;
    collide_surface({ShapeKind::kSphere, {}, 0.1, 0}, {Mat3::identity(), {0.3, 0.2, 0.1}}, field, {}, kMargin,
                    contacts);
    ASSERT_EQ(contacts.points.size(), 1u);
    EXPECT_NEAR(contacts.points[0].n_W.z, 1, 1e-12);
    EXPECT_NEAR(contacts.points[0].gap, -0.5, 1e-12);
}

TEST(CollideSurface, FeaturesHoldStillWhileABoxSlidesOverTheSeams) {
    const TriangleMesh floor = floor_mesh(40, 4);
    const Shape box{ShapeKind::kBox, {0.1, 0.15, 0.05}, 0, 0};
    SurfaceContacts contacts;
    std::set<std::uint32_t> seen;
    for (int i = 0; i < 500; ++i) {
        collide_surface(box, {Mat3::identity(), {0.002 * i - 0.5, 0.03, 0.05}}, floor, {}, kMargin, contacts);
        ASSERT_EQ(contacts.points.size(), 4u) << i;
        for (const SurfaceContact& c : contacts.points) seen.insert(c.feature);
    }
    EXPECT_LE(seen.size(), 12u) << "a corner exactly on a seam may have another name for a tick";
}

/// The way out of a triangle alone would be sideways, by half its thickness; but there the sheet goes on.
TEST(CollideSurface, AThinRodStuckThroughASheetIsHeldByItsFace) {
    const TriangleMesh mesh = floor_mesh(6, 3.0);
    const TriangleSurface& surface = mesh;
    Random random(5);
    SurfaceContacts out;
    for (int i = 0; i < 200; ++i) {
        const double depth = random.in(1e-3, 0.05);
        const Quat q = from_rpy(random.in(-0.5, 0.5), random.in(-0.5, 0.5), random.in(-3, 3));
        const Shape rod{ShapeKind::kBox, {0.0025, 0.0025, 0.15}, 0, 0};
        const Mat3 R = to_matrix(q);
        const double reach =
            std::fabs(R.r2.x) * 0.0025 + std::fabs(R.r2.y) * 0.0025 + std::fabs(R.r2.z) * 0.15;
        const Transform X{R, {random.in(-0.6, 0.6), random.in(-0.6, 0.6), reach - depth}};
        collide_surface(rod, X, surface, {}, kMargin, out);
        ASSERT_FALSE(out.points.empty()) << "depth " << depth;
        EXPECT_NEAR(smallest_gap(out), -depth, 1e-9);
        for (const SurfaceContact& c : out.points) EXPECT_NEAR(c.n_W.z, 1, 1e-12);
    }
}

}  // namespace
}  // namespace roboss
