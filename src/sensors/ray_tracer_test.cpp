// The tracers of all instruction sets against asking every shape, to the last bit, and against triangles one
// by one.
#include <gtest/gtest.h>

#include <cmath>

#include "core/noise.h"
#include "geometry/triangle_surface.h"
#include "sensors/infinity.h"
#include "sensors/ray_shape.h"
#include "sensors/ray_tracer.h"
#include "sensors/ray_tree.h"
#include "sensors/test_draws.h"

namespace roboss {
namespace {

using sensors_test::Draws;

/// A bowl of triangles.
std::shared_ptr<const TriangleSurface> bowl() {
    constexpr std::uint32_t kRing = 24;
    MeshSource source;
    source.vertices.push_back({0, 0, -0.5});
    for (std::uint32_t ring = 1; ring <= 4; ++ring)
        for (std::uint32_t i = 0; i < kRing; ++i) {
            const double a = 2 * 3.14159265 * i / kRing, r = 0.25 * ring;
            source.vertices.push_back({r * std::cos(a), r * std::sin(a), 0.5 * r * r - 0.5});
        }
    for (std::uint32_t i = 0; i < kRing; ++i) {
        const std::uint32_t j = (i + 1) % kRing;
        source.triangles.push_back({0, 1 + i, 1 + j});
        for (std::uint32_t ring = 0; ring < 3; ++ring) {
            const std::uint32_t a = 1 + ring * kRing, b = a + kRing;
            source.triangles.push_back({a + i, b + i, b + j});
            source.triangles.push_back({a + i, b + j, a + j});
        }
    }
    return build_surface(source).value();
}

/// Random shapes of all kinds in a cube about `centre`.
struct Shapes {
    Shapes(std::uint64_t seed, const Vec3& centre, double half) : draws(seed), surface(bowl()) {
        std::vector<Vec3> points;
        for (int i = 0; i < 20; ++i) points.push_back(draws.in_cube(0.7));
        hull = build_hull(points).value();
        for (int i = 0; i < 120; ++i) {
            RayItem item;
            item.shape.kind = static_cast<ShapeKind>(1 + static_cast<int>(draws.between(0, 7)));
            item.shape.half = {draws.between(0.05, 1), draws.between(0.05, 1), draws.between(0.05, 1)};
            item.shape.radius = draws.between(0.05, 0.8), item.shape.half_length = draws.between(0.05, 1);
            if (item.shape.kind == ShapeKind::kHull)
                item.shape.hull = &hull, item.faces = hull.faces.data(), item.face_count = hull.faces.size();
            if (item.shape.kind == ShapeKind::kSurface) {
                item.shape = surface_shape(*surface);
            }
            item.X_WS = to_transform(Pose{centre + draws.in_cube(half), exponential(draws.direction() * 2)});
            items.push_back(item), boxes.push_back(bounds(item.shape, item.X_WS));
        }
        RayItem floor;
        floor.shape.kind = ShapeKind::kPlane, floor.X_WS.p = centre - Vec3{0, 0, half};
        planes.push_back(floor);
        tree.update(boxes);
    }
    RayWorld world() const { return {{planes, {}}, {tree.view(items), {}}}; }
    double oracle(const Vec3& o, const Vec3& d, double limit) const {
        double nearest = limit;
        for (const auto* all : {&planes, &items})
            for (const RayItem& item : *all)
                nearest = std::fmin(nearest, ray_distance(item.shape, item.X_WS, o, d));
        return nearest;
    }

    Draws draws;
    std::shared_ptr<const TriangleSurface> surface;
    ConvexHull hull;
    std::vector<RayItem> items, planes;
    std::vector<Aabb> boxes;
    RayTree tree;
};

/// Eight rays that are near each other or not.
RayPacket packet_of(Draws& draws, const Vec3& centre, double half, bool fan) {
    RayPacket packet{};
    const Vec3 origin = centre + draws.in_cube(1.3 * half), ahead = draws.direction();
    for (std::size_t i = 0; i < kRays; ++i) {
        const Vec3 o = fan ? origin : centre + draws.in_cube(1.3 * half);
        Vec3 d = fan ? normalized(ahead + draws.in_cube(0.03)) : draws.direction();
        if (!fan && i == 0) d = {0, 0, -1};  // along an axis
        for (std::size_t k = 0; k < 3; ++k) packet.origin[k][i] = o[k], packet.direction[k][i] = d[k];
        packet.nearest[i] = i == 3 ? 1.0 : i == 4 ? kInfinity : 5 * half;
    }
    packet.active = static_cast<unsigned>(draws.between(1, 256));
    return packet;
}

int compare(const RayTracer& tracer, std::uint64_t seed, const Vec3& centre) {
    constexpr double kHalf = 4;
    Shapes shapes(seed, centre, kHalf);
    int hits = 0;
    for (int n = 0; n < 400; ++n) {
        RayPacket packet = packet_of(shapes.draws, centre, kHalf, n % 2 == 0);
        const RayPacket asked = packet;
        tracer.trace(shapes.world(), packet);
        for (std::size_t i = 0; i < kRays; ++i) {
            if ((packet.active >> i & 1u) == 0) continue;
            const Vec3 o{asked.origin[0][i], asked.origin[1][i], asked.origin[2][i]};
            const Vec3 d{asked.direction[0][i], asked.direction[1][i], asked.direction[2][i]};
            const double expected = shapes.oracle(o, d, asked.nearest[i]);
            EXPECT_EQ(packet.nearest[i], expected) << "seed " << seed << " packet " << n << " ray " << i;
            EXPECT_EQ(packet.hit[i] != nullptr, expected < asked.nearest[i]);
            if (packet.hit[i] == nullptr) continue;
            ++hits;
            EXPECT_EQ(ray_distance(packet.hit[i]->shape, packet.hit[i]->X_WS, o, d), expected);
        }
    }
    return hits;
}

TEST(RayTracer, OfEveryInstructionSetGivesTheBitsOfAskingEveryShape) {
    for (const auto& tracer : {make_any_ray_tracer(), make_avx2_ray_tracer()}) {
        if (!tracer) continue;  // not on this processor
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            EXPECT_GT(compare(*tracer, seed, {}), 500);
            EXPECT_GT(compare(*tracer, seed, {4e5, -3e5, 100}), 500);
        }
    }
}

TEST(RayTree, FollowsBoxesThatMoveAndIsBuiltAnewWhenTheyHaveMovedFar) {
    Shapes shapes(9, {}, 4);
    for (int step = 0; step < 60; ++step) {
        for (std::size_t i = 0; i < shapes.items.size(); ++i) {
            RayItem& item = shapes.items[i];
            item.X_WS.p += Vec3{i % 2 == 0 ? 0.2 : -0.1, 0.05 * static_cast<double>(i % 5), 0};
            shapes.boxes[i] = bounds(item.shape, item.X_WS);
        }
        shapes.tree.update(shapes.boxes);
        for (int n = 0; n < 20; ++n) {
            RayPacket packet = packet_of(shapes.draws, {}, 6, n % 2 == 0);
            const RayPacket asked = packet;
            best_ray_tracer().trace(shapes.world(), packet);
            for (std::size_t i = 0; i < kRays; ++i) {
                if ((packet.active >> i & 1u) == 0) continue;
                const Vec3 o{asked.origin[0][i], asked.origin[1][i], asked.origin[2][i]};
                const Vec3 d{asked.direction[0][i], asked.direction[1][i], asked.direction[2][i]};
                EXPECT_EQ(packet.nearest[i], shapes.oracle(o, d, asked.nearest[i]));
            }
        }
    }
}

TEST(RayTracer, OfShapesAtOneDistanceTheFirstCounts) {
    std::vector<RayItem> items(9);
    std::vector<Aabb> boxes;
    for (RayItem& item : items) {
        item.shape.kind = ShapeKind::kBox, item.shape.half = {1, 1, 1}, item.X_WS.p = {5, 0, 0};
        boxes.push_back(bounds(item.shape, item.X_WS));
    }
    RayTree tree;
    tree.update(boxes);
    RayPacket packet{};
    for (std::size_t i = 0; i < kRays; ++i) packet.direction[0][i] = 1, packet.nearest[i] = 100;
    packet.active = 0xFF;
    best_ray_tracer().trace({{}, {tree.view(items), {}}}, packet);
    for (const RayItem* hit : packet.hit) EXPECT_EQ(hit, &items[0]);
}

}  // namespace
}  // namespace roboss
