// See over_triangle.h.
#include "geometry/over_triangle.h"

#include "geometry/closest_point.h"

namespace roboss::narrow {
namespace {

constexpr double kBorder = 2e-6, kMerge = 1e-4;  // of the body's size
constexpr double kApart = 1e-5;                  // of the body's size: nearer, rounding turns the direction

}  // namespace

ClippedFeature points_over(const ConvexBody& body, const std::array<Vec3, 3>& corners, const Vec3& n) {
    const double border = kBorder * body.size();
    ClippedFeature over;
    if (!body.is_pointed()) {
        Feature face;
        face.n = n;
        face.face_part = kTriangleFace;
        for (std::uint32_t k = 0; k < 3; ++k) face.add(corners[k], k, 3 + k);
        return clip_over(face, body.feature(-n), body.ball(), border, kMerge * body.size());
    }
    const Vec3 p = body.centre() + body.support(-n);
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 inward = cross(n, corners[(k + 1) % 3] - corners[k]);
        const double depth = dot(inward, p - corners[k]);
        if (depth < 0 && depth * depth > border * border * norm_squared(inward)) return over;
    }
    over.points.push_back({p, dot(n, p - corners[0]) - body.ball(), 0, kTriangleFace});
    return over;
}

std::optional<Separation> corner_separation(const ConvexBody& body, const std::array<Vec3, 3>& corners) {
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& corner = corners[k];
        const std::optional<Vec3> closest = body.closest_to(corner);
        if (!closest) continue;
        const Vec3 away = *closest - corner;
        if (dot(away, corners[(k + 1) % 3] - corner) > 0 || dot(away, corners[(k + 2) % 3] - corner) > 0)
            continue;
        const double distance = norm(away);
        if (distance > kApart * body.size()) return Separation{away / distance, distance};
    }
    return std::nullopt;
}

std::optional<Separation> plain_separation(const ConvexBody& body, const SurfaceFace& face, double enough) {
    if (body.is_round()) {
        const Vec3 away = body.centre() - closest_point(face.v, body.centre());
        const double distance = norm(away);
        return Separation{distance > 0 ? away / distance : face.n, distance};
    }
    const double height = dot(face.n, body.centre() - face.v[0]), s = height - body.reach(-face.n);
    if (s > enough) return Separation{face.n, s};
    if (height < 0 || s - body.ball() < -kShallow * body.size()) return std::nullopt;
    const double deepest = points_over(body, face.v, face.n).deepest();
    if (deepest > s - body.ball() + kLowest * body.size()) return corner_separation(body, face.v);
    return Separation{face.n, s};
}

}  // namespace roboss::narrow
