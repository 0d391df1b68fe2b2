// Rays against ellipsoids, hulls, triangle meshes and height fields: closed forms, and other shapes that look
// the same.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "geometry/height_field.h"
#include "geometry/triangle_mesh.h"
#include "model/model.h"
#include "sensors/ray_shape.h"
#include "sensors/readings.h"
#include "sensors/test_model.h"

namespace roboss {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

std::vector<Vec3> corners(const Vec3& h) {
    std::vector<Vec3> points;
    for (int k = 0; k < 8; ++k)
        points.push_back({k & 1 ? h.x : -h.x, k & 2 ? h.y : -h.y, k & 4 ? h.z : -h.z});
    return points;
}

TriangleMesh box_surface(const Vec3& h) {
    const std::vector<TriangleMesh::Corners> triangles{{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                                       {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                                       {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return {corners(h), triangles};
}

TEST(RaySurface, EllipsoidIsMetAtItsRadii) {
    const Shape egg{ShapeKind::kEllipsoid, {1, 2, 3}, 0, 0};
    EXPECT_NEAR(ray_distance(egg, {}, {-5, 0, 0}, {1, 0, 0}), 4, 1e-14);
    EXPECT_NEAR(ray_distance(egg, {}, {0, -5, 0}, {0, 1, 0}), 3, 1e-14);
    EXPECT_NEAR(ray_distance(egg, {}, {0, 0, 0}, {0, 0, 1}), 3, 1e-14) << "from inside";
    EXPECT_NEAR(ray_distance(egg, {}, {-5, 1, 0}, {1, 0, 0}), 5 - std::sqrt(0.75), 1e-14);
    EXPECT_EQ(ray_distance(egg, {}, {-5, 2.01, 0}, {1, 0, 0}), kNone);
}

TEST(RaySurface, BoxesAsHullAndAsMeshLookLikeTheBox) {
    const Vec3 half{0.5, 0.7, 0.4};
    const ConvexHull hull = build_hull(corners(half)).value();
    const TriangleMesh mesh = box_surface(half);
    EXPECT_EQ(mesh.sides(), SurfaceSides::kSolid);
    const Shape box{ShapeKind::kBox, half, 0, 0}, as_hull = hull_shape(hull), as_mesh = surface_shape(mesh);
    const Transform X = to_transform({{10, -20, 5}, from_rpy(0.3, -1.1, 2.2)});
    std::mt19937_64 engine(1);
    const auto in = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
    };
    int hits = 0;
    for (int i = 0; i < 5000; ++i) {
        const Vec3 origin{in(-2, 2), in(-2, 2), in(-2, 2)}, target{in(-1, 1), in(-1, 1), in(-1, 1)};
        const Vec3 d = normalized(target - origin);
        const double expected = ray_distance(box, X, X * origin, X.R * d);
        for (const Shape& shape : {as_hull, as_mesh}) {
            const double found = ray_distance(shape, X, X * origin, X.R * d);
            if (expected == kNone) {
                EXPECT_EQ(found, kNone);
            } else {
                EXPECT_NEAR(found, expected, 1e-9);
            }
        }
        hits += expected < kNone ? 1 : 0;
    }
    EXPECT_GT(hits, 1000);
}

TEST(RaySurface, HeightFieldIsMetWhereEveryTriangleTestedOneByOneIsMet) {
    std::mt19937_64 engine(2);
    const auto in = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
    };
    std::vector<double> heights(17 * 9);
    for (double& h : heights) h = in(0, 1);
    const HeightField field(17, 9, heights, 8, 4);
    const Shape shape = surface_shape(field);
    int hits = 0;
    for (int i = 0; i < 3000; ++i) {
        const Vec3 origin{in(-6, 6), in(-4, 4), in(-1, 4)}, target{in(-4, 4), in(-2, 2), in(0, 1)};
        const Vec3 d = i % 10 == 0 ? Vec3{0, 0, -1} : normalized(target - origin);
        double expected = kNone;
        for (std::uint32_t t = 0; t < field.triangle_count(); ++t)
            expected = std::fmin(expected, ray_triangle(origin, d, field.triangle(t).v));
        const double found = ray_distance(shape, {}, origin, d);
        if (expected == kNone) {
            EXPECT_EQ(found, kNone) << i;
        } else {
            EXPECT_NEAR(found, expected, 1e-12) << i;
            ++hits;
        }
    }
    EXPECT_GT(hits, 1500);
}

TEST(RaySurface, NoRaySlipsThroughTheSeamsOfAMesh) {
    std::vector<Vec3> points;
    std::vector<TriangleMesh::Corners> triangles;
    for (int j = 0; j <= 20; ++j)
        for (int i = 0; i <= 20; ++i) points.push_back({i * 0.1 - 1, j * 0.1 - 1, 0});
    for (std::uint32_t j = 0; j < 20; ++j)
        for (std::uint32_t i = 0; i < 20; ++i) {
            const std::uint32_t a = j * 21 + i;
            triangles.push_back({a, a + 1, a + 22}), triangles.push_back({a, a + 22, a + 21});
        }
    const TriangleMesh mesh(points, triangles);
    for (const Vec3& p : points)
        EXPECT_NEAR(ray_distance(surface_shape(mesh), {}, {p.x, p.y, 3}, {0, 0, -1}), 3, 1e-12);
}

TEST(RaySurface, AScenesRaysSeeMeshesAndGround) {
    auto model = std::make_shared<Model>();
    model->surfaces.push_back(std::make_shared<const TriangleMesh>(box_surface({1, 1, 1})));
    model->surfaces.push_back(
        std::make_shared<const HeightField>(2, 2, std::vector<double>{0, 0, 0, 0}, 100, 100));
    model->hulls.push_back(std::make_shared<const ConvexHull>(build_hull(corners({0.5, 0.5, 0.5})).value()));
    sensors_test::add_static(*model, surface_shape(*model->surfaces[0]), {Mat3::identity(), {5, 0, 1}});
    sensors_test::add_static(*model, surface_shape(*model->surfaces[1]), {});
    sensors_test::add_static(*model, hull_shape(*model->hulls[0]), {Mat3::identity(), {0, 5, 0.5}});
    RayScene scene(model);
    scene.update({});
    std::vector<RayScene::Ray> rays(3);
    rays[0].direction_W = {1, 0, 0}, rays[1].direction_W = {0, 0, -1}, rays[2].direction_W = {0, 1, 0};
    for (RayScene::Ray& ray : rays) ray.origin_W = {0, 0, 0.75}, ray.max_range = 50;
    std::vector<double> distances(3);
    scene.cast(rays, distances);
    EXPECT_NEAR(distances[0], 4, 1e-12);
    EXPECT_NEAR(distances[1], 0.75, 1e-12);
    EXPECT_NEAR(distances[2], 4.5, 1e-12);
}

}  // namespace
}  // namespace roboss
