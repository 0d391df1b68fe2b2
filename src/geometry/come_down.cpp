// Conservative advancement along z: the plane between the closest points of two convex shapes, with the
// normal n from the lower to the upper one, keeps them apart while the upper one comes down by less than gap
// / n.z.
#include "geometry/come_down.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/collide_general.h"
#include "geometry/triangle_surface.h"

namespace roboss {
namespace {

using namespace narrow;

constexpr double kTouching = 1e-8;    // m
constexpr int kAdvancesMax = 500;     // of one pair
constexpr double kSteepPlane = 0.1;   // z of a plane's normal: on steeper ones nothing stands
constexpr double kFlatEnough = 1e-9;  // z of a normal that still looks up

Transform lifted(const Transform& X, double by) {
    return {X.R, X.p + Vec3{0, 0, by}};
}

/// Onto a plane, exactly.
std::optional<double> onto_plane(const ConvexBody& a, const Transform& X_WP) {
    const Vec3 n = X_WP.R.col(2);
    if (n.z < kSteepPlane) return {};
    const double height = dot(n, a.centre() - X_WP.p) - a.reach(-n) - a.ball();
    return -height / n.z;
}

/// Onto a convex body, from `from` down to `least`.
std::optional<double> onto_body(const Shape& a, const Transform& X_WA, double from, double least,
                                const ConvexBody& b) {
    double t = from;
    for (int i = 0; i < kAdvancesMax; ++i) {
        const Transform X = lifted(X_WA, t);
        const Posed posed{a, X};
        const ConvexBody body(posed);
        const double balls = body.ball() + b.ball();
        const Separation best = best_separation(body, b, 1e300);
        const double gap = best.s - balls;
        if (i == 0 && gap <= 0) return {};
        if (best.n.z <= kFlatEnough) return gap <= kTouching ? std::optional(t) : std::nullopt;
        const double step = gap / best.n.z;
        if (gap <= kTouching) return t;
        t -= step;
        if (t < least) return {};
    }
    return t;
}

/// The box in the frame of X_WF that holds a box of the world.
Aabb seen_from(const Aabb& box, const Transform& X_WF) {
    const Transform X_FW = inverse(X_WF);
    Aabb seen;
    for (const double x : {box.min.x, box.max.x})
        for (const double y : {box.min.y, box.max.y})
            for (const double z : {box.min.z, box.max.z}) seen.include(X_FW * Vec3{x, y, z});
    return seen;
}

Aabb box_of(const std::array<Vec3, 3>& corners) {
    Aabb box;
    for (const Vec3& corner : corners) box.include(corner);
    return box;
}

/// Triangle by triangle: the highest that it meets. Solids carry on the sides that look up.
class Descent {
  public:
    Descent(const Shape& a, const Transform& X_WA, double from, const Shape& surface, const Transform& X_WS)
        : a_(a), X_WA_(X_WA), from_(from), surface_(*surface.surface), X_WS_(X_WS), box_(bounds(a, X_WA)) {
        const Aabb whole = bounds(surface, X_WS);
        if (surface_.is_ground()) from_ = std::max(from_, whole.max.z - box_.min.z + 1e-3);
        low_ = whole.min.z - box_.max.z;
        Aabb column = box_;
        column.min.z = std::min(whole.min.z, column.min.z), column.max.z += from_;
        surface_.query(seen_from(column, X_WS), triangles_);
    }

    std::optional<double> highest() const {
        std::optional<double> best;
        for (const std::uint32_t number : triangles_) {
            const SurfaceTriangle triangle = surface_.triangle(number);
            std::array<Vec3, 3> corners{X_WS_ * triangle.v[0], X_WS_ * triangle.v[1], X_WS_ * triangle.v[2]};
            Vec3 n = X_WS_.R * triangle.n;
            const Aabb box = box_of(corners);
            const bool beside = box.max.x < box_.min.x || box.min.x > box_.max.x || box.max.y < box_.min.y ||
                                box.min.y > box_.max.y;
            if (beside || (best && box.max.z - box_.min.z <= *best)) continue;
            if (n.z <= kFlatEnough && surface_.sides() == SurfaceSides::kSolid) continue;
            if (n.z < 0) n = -n, std::swap(corners[1], corners[2]);
            const auto met = onto_body(a_, X_WA_, from_, best.value_or(low_), ConvexBody(corners, n));
            if (met && (!best || *met > *best)) best = met;
        }
        return best;
    }

  private:
    const Shape& a_;
    const Transform& X_WA_;
    double from_, low_ = 0;
    const TriangleSurface& surface_;
    const Transform& X_WS_;
    Aabb box_;
    std::vector<std::uint32_t> triangles_;
};

bool is_closed(const TriangleSurface& surface) {
    return surface.sides() == SurfaceSides::kSolid && !surface.is_ground();
}

/// The way to the first triangle above, if it looks up: then the point is below it, inside.
std::optional<double> out_of_surface(const Vec3& p_W, double top, const TriangleSurface& surface,
                                     const Transform& X_WS) {
    std::vector<std::uint32_t> triangles;
    surface.query(seen_from({p_W, {p_W.x, p_W.y, top}}, X_WS), triangles);
    std::optional<double> nearest;
    bool looks_up = false;
    for (const std::uint32_t number : triangles) {
        const SurfaceFace face = surface.face(number);
        const double t = ray_triangle(p_W, {0, 0, 1}, {X_WS * face.v[0], X_WS * face.v[1], X_WS * face.v[2]});
        if (!std::isfinite(t) || (nearest && t >= *nearest)) continue;
        nearest = t, looks_up = (X_WS.R * face.n).z > 0;
    }
    return looks_up ? nearest : std::nullopt;
}

}  // namespace

std::optional<double> rise_out(const Vec3& p_W, const Shape& b, const Transform& X_WB) {
    const bool holds =
        b.kind != ShapeKind::kPlane && (b.kind != ShapeKind::kSurface || is_closed(*b.surface));
    const Aabb box = holds ? bounds(b, X_WB) : Aabb();
    if (!holds || !overlaps(box, {p_W, p_W})) return {};
    if (b.kind == ShapeKind::kSurface) return out_of_surface(p_W, box.max.z, *b.surface, X_WB);
    Shape point;
    point.radius = 0;
    const Transform X_WP{Mat3::identity(), p_W};
    const Posed posed_point{point, X_WP}, posed_b{b, X_WB};
    const ConvexBody body(posed_b);
    if (best_separation(ConvexBody(posed_point), body, 1e300).s - body.ball() > 0) return {};
    return onto_body(point, X_WP, box.max.z - p_W.z + 1e-3, 0, body);
}

std::optional<double> come_down(const Shape& a, const Transform& X_WA, double from, const Shape& b,
                                const Transform& X_WB) {
    const Posed posed_a{a, X_WA};
    if (b.kind == ShapeKind::kPlane) return onto_plane(ConvexBody(posed_a), X_WB);
    if (b.kind == ShapeKind::kSurface) return Descent(a, X_WA, from, b, X_WB).highest();
    const Posed posed_b{b, X_WB};
    const double least = bounds(b, X_WB).min.z - bounds(a, X_WA).max.z;
    return onto_body(a, X_WA, from, least, ConvexBody(posed_b));
}

}  // namespace roboss
