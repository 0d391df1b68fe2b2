// Dispatch of the narrow phase. Every pair is computed in one fixed order of its shapes and flipped when the
// caller's order is the other, so swapping the arguments gives the same points and the opposite normal to the
// last bit.
#include "geometry/collide.h"

#include <utility>

#include "geometry/narrow.h"

namespace roboss {
namespace {

using namespace narrow;

void nothing(const Posed&, const Posed&, double, Manifold&) {}

// [kind of the first][kind of the second], first <= second.
constexpr PairFunction kPairs[7][7] = {
    {nothing, plane_sphere, plane_box, plane_cylinder, plane_capsule, plane_ellipsoid, plane_hull},
    {nullptr, sphere_sphere, sphere_box, sphere_cylinder, sphere_capsule, general_general, general_general},
    {nullptr, nullptr, box_box, convex_convex, convex_convex, general_general, general_general},
    {nullptr, nullptr, nullptr, convex_convex, convex_convex, general_general, general_general},
    {nullptr, nullptr, nullptr, nullptr, capsule_capsule, general_general, general_general},
    {nullptr, nullptr, nullptr, nullptr, nullptr, general_general, general_general},
    {nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, general_general},
};

int compare(const Vec3& a, const Vec3& b) {
    if (a.x != b.x) return a.x < b.x ? -1 : 1;
    if (a.y != b.y) return a.y < b.y ? -1 : 1;
    if (a.z != b.z) return a.z < b.z ? -1 : 1;
    return 0;
}

int compare(double a, double b) {
    return a < b ? -1 : a > b ? 1 : 0;
}

/// Order of two shapes of one kind: by size, then by where each sees the other in its own frame (which holds
/// still while one rests on the other), then by the poses themselves.
bool in_order(const Posed& a, const Posed& b) {
    if (int c = compare(a.shape.half, b.shape.half)) return c > 0;
    if (int c = compare(a.shape.radius, b.shape.radius)) return c > 0;
    if (int c = compare(a.shape.half_length, b.shape.half_length)) return c > 0;
    const Vec3 weights{1.0, 1.7, 2.9};  // generic: no symmetric arrangement makes both sides equal
    const Vec3 d = b.X.p - a.X.p;
    if (int c = compare(dot(weights, transpose_times(a.X.R, d)), -dot(weights, transpose_times(b.X.R, d))))
        return c > 0;
    if (int c = compare(a.X.p, b.X.p)) return c > 0;
    for (std::size_t i = 0; i < 3; ++i) {
        if (int c = compare(a.X.R.row(i), b.X.R.row(i))) return c > 0;
    }
    return true;
}

/// Features are (part of the first) << 8 | (part of the second) in the pairs of one kind; << 16 for the
/// general ones.
void flip_features(Manifold& m, bool general) {
    for (int i = 0; i < m.count; ++i) {
        std::uint32_t& f = m.points[static_cast<std::size_t>(i)].feature;
        f = general ? f << 16 | f >> 16 : (f & 0xFFu) << 8 | f >> 8;
    }
}

}  // namespace

Manifold collide(const Shape& a, const Transform& X_WA, const Shape& b, const Transform& X_WB,
                 double margin) {
    const auto has_box = [](const Shape& s) {
        return s.kind != ShapeKind::kPlane && s.kind != ShapeKind::kSurface;
    };
    // The guarantee of the header, to the last bit: what the broad phase may leave out is left out here too.
    if (has_box(a) && has_box(b) &&
        !overlaps(bounds(a, X_WA).inflated(0.5 * margin), bounds(b, X_WB).inflated(0.5 * margin)))
        return {};
    return collide_near(a, X_WA, b, X_WB, margin);
}

Manifold collide_near(const Shape& a, const Transform& X_WA, const Shape& b, const Transform& X_WB,
                      double margin) {
    Manifold out;
    if (a.kind == ShapeKind::kSurface || b.kind == ShapeKind::kSurface) return out;
    const Posed A{a, X_WA}, B{b, X_WB};
    const bool same_kind = a.kind == b.kind;
    const bool straight = same_kind ? in_order(A, B) : a.kind < b.kind;
    const Posed& first = straight ? A : B;
    const Posed& second = straight ? B : A;
    kPairs[static_cast<int>(first.shape.kind)][static_cast<int>(second.shape.kind)](first, second, margin,
                                                                                    out);
    if (!straight) {
        out.n_W = -out.n_W;
        if (same_kind) flip_features(out, a.kind >= ShapeKind::kEllipsoid);
    }
    return out;
}

}  // namespace roboss
