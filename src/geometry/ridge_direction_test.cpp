// The routines for one triangle against the general ones, over random bodies on random hills.
#include "geometry/ridge_direction.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/convex_hull.h"
#include "geometry/height_field.h"
#include "geometry/plain_surface_contacts.h"
#include "geometry/triangle_mesh.h"
#include "math/quat.h"

namespace roboss {
namespace {

constexpr double kMargin = 4e-3;

struct Draw {
    std::mt19937_64 engine;
    explicit Draw(std::uint64_t seed) : engine(seed) {}
    double in(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine() >> 11) * 0x1p-53);
    }
};

struct Tried {
    const char* name;
    Shape shape;
    double size;  // the smallest, m
};

std::vector<Tried> tried() {
    static const ConvexHull hull =
        build_hull(std::vector<Vec3>{{-0.1, -0.1, -0.05}, {0.1, -0.1, -0.05}, {0, 0.12, -0.05}, {0, 0, 0.15}})
            .value();
    return {{"sphere", {ShapeKind::kSphere, {}, 0.1, 0}, 0.1},
            {"box", {ShapeKind::kBox, {0.1, 0.15, 0.05}, 0, 0}, 0.05},
            {"cylinder", {ShapeKind::kCylinder, {}, 0.1, 0.03}, 0.03},
            {"capsule", {ShapeKind::kCapsule, {}, 0.06, 0.1}, 0.06},
            {"ellipsoid", {ShapeKind::kEllipsoid, {0.1, 0.04, 0.1}, 0, 0}, 0.04},
            {"hull", hull_shape(hull), 0.02}};
}

HeightField hills(Draw& draw, double rough) {
    std::vector<double> heights;
    for (int k = 0; k < 9; ++k) heights.push_back(draw.in(-rough, rough));
    return {3, 3, heights, 0.8, 0.8};
}

/// The same triangles as a sheet.
TriangleMesh sheet_of(const HeightField& field) {
    std::vector<Vec3> points;
    std::vector<TriangleMesh::Corners> triangles;
    for (std::uint32_t t = 0; t < field.triangle_count(); ++t) {
        TriangleMesh::Corners corners;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 p = field.face(t).v[k];
            const auto known = std::find(points.begin(), points.end(), p);
            corners[k] = static_cast<std::uint32_t>(known - points.begin());
            if (known == points.end()) points.push_back(p);
        }
        triangles.push_back(corners);
    }
    return {points, triangles};
}

double least(const std::vector<SurfaceContact>& contacts) {
    double gap = 1e300;
    for (const SurfaceContact& c : contacts) gap = std::min(gap, c.gap);
    return gap;
}

/// How far the nearest of `all` is from c: in place, along the normal, in depth.
double miss(const SurfaceContact& c, const std::vector<SurfaceContact>& all, double size) {
    double best = 1e300;
    for (const SurfaceContact& o : all)
        best = std::min(best, std::max({norm(c.p_W - o.p_W) / size, norm(c.n_W - o.n_W),
                                        std::fabs(c.gap - o.gap) / size}));
    return best;
}

/// Puts the body where its deepest contact has a gap of about `gap`.
bool settle(const Shape& shape, const TriangleSurface& surface, double gap, Transform& X) {
    for (int round = 0; round < 30; ++round) {
        const auto contacts = test::plain_contacts(shape, X, surface, 0.5);
        if (contacts.empty()) return false;
        const double move = least(contacts) - gap;
        if (std::fabs(move) < 1e-6) return true;
        X.p.z -= move;
    }
    return least(test::plain_contacts(shape, X, surface, 0.5)) > -2e-3;
}

struct Counts {
    int touching = 0, ridges = 0;
    double worst = 0;  // of the bodies' size
};

void compare(const Tried& body, const TriangleSurface& surface, Draw& draw, Counts& counts) {
    Transform X;
    X.R = to_matrix(from_rpy(draw.in(-3, 3), draw.in(-1.5, 1.5), draw.in(-3, 3)));
    X.p = {draw.in(-0.2, 0.2), draw.in(-0.2, 0.2), 0.5};
    if (!settle(body.shape, surface, draw.in(-2e-4, 3e-3), X)) return;
    const auto expected = test::plain_contacts(body.shape, X, surface, kMargin);
    SurfaceContacts found;
    collide_surface(body.shape, X, surface, {}, kMargin, found);
    ASSERT_EQ(found.points.empty(), expected.empty()) << body.name;
    if (expected.empty()) return;
    ++counts.touching;
    EXPECT_NEAR(least(found.points), least(expected), 1e-9) << body.name;
    for (const SurfaceContact& c : found.points) {
        const double off = miss(c, expected, body.size);
        EXPECT_LT(off, 1e-4) << body.name << " gap " << c.gap;
        counts.worst = std::max(counts.worst, off);
        counts.ridges += (c.feature & 0xFu) != 6 ? 1 : 0;
    }
    // Where a point is left out, another one in its direction is as near: it is inside of those taken.
    for (const SurfaceContact& c : expected) {
        double gap = 1e300;
        for (const SurfaceContact& p : found.points)
            if (dot(p.n_W, c.n_W) > 0.9) gap = std::min(gap, p.gap);
        EXPECT_LE(gap, c.gap + 1e-9) << body.name;
    }
}

TEST(RidgeDirection, GivesTheContactsOfTheGeneralSearch) {
    for (const Tried& body : tried()) {
        Counts counts;
        Draw draw(7);
        for (int i = 0; i < 1500; ++i) {
            const HeightField field = hills(draw, i % 3 == 0 ? 0.02 : 0.12);
            if (i % 2 == 0)
                compare(body, field, draw, counts);
            else
                compare(body, sheet_of(field), draw, counts);
            if (testing::Test::HasFailure()) FAIL() << "seed 7, round " << i;
        }
        std::printf("    measured: %s: %d touch, %d points at ridges, off by %.1e of the size\n", body.name,
                    counts.touching, counts.ridges, counts.worst);
        EXPECT_GT(counts.touching, 500) << body.name;
        EXPECT_GT(counts.ridges, 50) << body.name;
    }
}

}  // namespace
}  // namespace roboss
