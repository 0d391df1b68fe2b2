// See exact_hit.h.
#include "render/exact_hit.h"

#include <algorithm>
#include <cmath>

#include "core/fixed_math.h"
#include "render/shape_rays.h"

namespace roboss::render {
namespace {

Inside<double> cross_item(const TraceItem& item, const Vec3& o, const Vec3& d) {
    const double* s = item.size;
    switch (item.kind) {
        case TraceKind::kPlane:
            return cross_rectangle(o, d, s[0], s[1]);
        case TraceKind::kBox:
            return cross_box(o, d, {s[0], s[1], s[2]});
        case TraceKind::kSphere:
            return cross_ball(o, d, s[0]);
        case TraceKind::kCylinder:
            return cross_cylinder(o, d, s[0], s[1]);
        case TraceKind::kCapsule:
            return cross_capsule(o, d, s[0], s[1]);
        case TraceKind::kEllipsoid:
            return cross_ellipsoid(o, d, {s[0], s[1], s[2]});
        case TraceKind::kCone:
            return cross_cone(o, d, s[0], s[1]);
        case TraceKind::kMesh:
            break;
    }
    return {kNever, -kNever};
}

Vec3 unit(const Vec3& v) {
    const double length = norm(v);
    return length > 0 ? v / length : Vec3{0, 0, 1};
}

/// Round about z from 0 to 1.
double around(const Vec3& p) {
    return 0.5 + fixed_atan2(p.y, p.x) / (2 * kPi);
}

/// Normal and place on the picture at p on the face of a box.
void on_box(const TraceItem& item, const Vec3& p, ExactHit& hit) {
    std::size_t axis = 0;
    double most = -1;
    for (std::size_t k = 0; k < 3; ++k) {
        const double share = std::fabs(p[k]) / std::max(item.size[k], 1e-12);
        if (share > most) most = share, axis = k;
    }
    hit.n_S = {};
    hit.n_S[axis] = p[axis] < 0 ? -1 : 1;
    const std::size_t a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;
    hit.u = 0.5 + 0.5 * p[a] / std::max(item.size[a], 1e-12) *
                      (axis == 1   ? -hit.n_S[axis]
                       : axis == 0 ? hit.n_S[axis]
                                   : 1);
    hit.v = 0.5 + 0.5 * p[b] / std::max(item.size[b], 1e-12);
    hit.uv_density = 0.5 / std::max(std::min(item.size[a], item.size[b]), 1e-6);
}

void on_shape(const TraceItem& item, const Vec3& p, ExactHit& hit) {
    const double radius = std::max(item.size[0], 1e-12), half = std::max(item.size[1], 1e-12);
    switch (item.kind) {
        case TraceKind::kPlane:
            hit.n_S = {0, 0, 1};
            hit.u = 0.5 + 0.5 * p.x / radius, hit.v = 0.5 + 0.5 * p.y / half;
            hit.uv_density = 0.5 / std::min(radius, half);
            return;
        case TraceKind::kBox:
            return on_box(item, p, hit);
        case TraceKind::kCylinder:
        case TraceKind::kCone: {
            const double slope = item.kind == TraceKind::kCone ? 0.5 * radius / half : 0;
            const double rim = item.kind == TraceKind::kCone ? radius * 0.5 * (1 - p.z / half) : radius;
            const double out = std::sqrt(p.x * p.x + p.y * p.y);
            const bool top = item.kind == TraceKind::kCylinder && half - p.z < std::fabs(rim - out);
            const bool bottom = half + p.z < std::fabs(rim - out);
            if (top || bottom) {
                hit.n_S = {0, 0, top ? 1.0 : -1.0};
                hit.u = 0.5 + 0.5 * p.x / radius, hit.v = 0.5 + 0.5 * p.y / radius;
            } else {
                hit.n_S = unit({p.x, p.y, slope * out});
                hit.u = around(p), hit.v = 0.5 + 0.5 * p.z / half;
            }
            hit.uv_density = 0.5 / std::min(radius, half);
            return;
        }
        case TraceKind::kCapsule:
            hit.n_S = unit({p.x, p.y, p.z - std::clamp(p.z, -item.size[1], item.size[1])});
            hit.u = around(p), hit.v = 0.5 + 0.5 * p.z / (half + radius);
            hit.uv_density = 0.5 / radius;
            return;
        case TraceKind::kSphere:
        case TraceKind::kEllipsoid: {
            const Vec3 q{p.x / radius, p.y / half, p.z / std::max(item.size[2], 1e-12)};
            hit.n_S = unit({q.x / radius, q.y / half, q.z / std::max(item.size[2], 1e-12)});
            hit.u = around(q), hit.v = 0.5 + fixed_asin(std::clamp(q.z, -1.0, 1.0)) / kPi;
            hit.uv_density = 0.3 / radius;
            return;
        }
        case TraceKind::kMesh:
            return;
    }
}

}  // namespace

ExactHit exact_hit(const TraceItem& item, const VisualMesh* mesh, std::uint32_t triangle, const Vec3& o,
                   const Vec3& d, double t_min, bool hollow) {
    ExactHit hit;
    if (item.kind == TraceKind::kMesh) {
        VisualMesh::Place place{triangle, 0, 0};
        hit.t = mesh->cross(o, d, place);
        hit.flat_S = mesh->flat_normal(triangle);
        hit.n_S = mesh->smooth_normal(place);
        if (!mesh->has_uv()) return hit;
        const std::array<double, 2> uv = mesh->uv(place);
        hit.u = uv[0], hit.v = uv[1], hit.uv_density = mesh->uv_density(triangle);
        return hit;
    }
    const Inside<double> in = cross_item(item, o, d);
    hit.t = in.enter > t_min || hollow ? in.enter : in.leave;
    on_shape(item, o + d * hit.t, hit);
    hit.flat_S = hit.n_S;
    return hit;
}

}  // namespace roboss::render
