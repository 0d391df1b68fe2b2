// Sorts the shapes' boxes along x, sweeps, and asks the narrow phase of src/geometry about those that meet.
#include "scenes/overlap.h"

#include <algorithm>

#include "geometry/collide.h"

namespace roboss::bench {
namespace {

constexpr double kTouching = 1e-3;  // m

struct PlacedShape {
    Shape shape;
    Transform X_WS;
    Aabb box;
    std::size_t instance = 0;
    bool is_static = false;
};

Shape to_shape(const GeometrySpec& geometry) {
    Shape shape;
    shape.half = geometry.size * 0.5;
    shape.radius = geometry.radius;
    shape.half_length = 0.5 * geometry.length;
    shape.kind = geometry.kind == GeometryKind::kPlane      ? ShapeKind::kPlane
                 : geometry.kind == GeometryKind::kBox      ? ShapeKind::kBox
                 : geometry.kind == GeometryKind::kCylinder ? ShapeKind::kCylinder
                 : geometry.kind == GeometryKind::kCapsule  ? ShapeKind::kCapsule
                                                            : ShapeKind::kSphere;
    return shape;
}

std::vector<PlacedShape> place_all(const World& world, const Engine& engine) {
    std::vector<PlacedShape> placed;
    for (std::size_t i = 0; i < world.instances.size(); ++i) {
        const ModelSpec& model = world.prototypes[world.instances[i].prototype];
        for (std::size_t l = 0; l < model.links.size(); ++l) {
            const Pose X_WL =
                model.is_static ? world.instances[i].X_WM * model.links[l].X_ML : engine.link({i, l}).X_WL;
            for (const CollisionSpec& collision : model.links[l].collisions) {
                PlacedShape s{to_shape(collision.geometry),
                              to_transform(X_WL * collision.X_LS),
                              {},
                              i,
                              model.is_static};
                s.box = bounds(s.shape, s.X_WS);
                placed.push_back(s);
            }
        }
    }
    std::sort(placed.begin(), placed.end(),
              [](const PlacedShape& a, const PlacedShape& b) { return a.box.min.x < b.box.min.x; });
    return placed;
}

}  // namespace

Overlap measure_overlap(const World& world, const Engine& engine) {
    const std::vector<PlacedShape> placed = place_all(world, engine);
    std::vector<char> touches(world.instances.size(), 0);
    Overlap overlap;
    for (std::size_t a = 0; a < placed.size(); ++a) {
        for (std::size_t b = a + 1; b < placed.size(); ++b) {
            const PlacedShape &A = placed[a], &B = placed[b];
            if (B.box.min.x > A.box.max.x + kTouching) break;
            if (A.instance == B.instance || (A.is_static && B.is_static)) continue;
            const Manifold manifold = collide(A.shape, A.X_WS, B.shape, B.X_WS, kTouching);
            for (int p = 0; p < manifold.count; ++p)
                overlap.deepest_m =
                    std::max(overlap.deepest_m, -manifold.points[static_cast<std::size_t>(p)].gap);
            const bool plane = A.shape.kind == ShapeKind::kPlane || B.shape.kind == ShapeKind::kPlane;
            if (manifold.count > 0 && !plane) touches[A.instance] = touches[B.instance] = 1;
        }
    }
    for (std::size_t i = 0; i < touches.size(); ++i)
        overlap.touching += touches[i] && !world.prototypes[world.instances[i].prototype].is_static;
    return overlap;
}

}  // namespace roboss::bench
