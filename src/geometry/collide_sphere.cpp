// Sphere against sphere, box, cylinder and capsule: the point of the other shape closest to the centre, or
// the nearest face when the centre is inside. Always one point, so the feature is 0.
#include <algorithm>

#include "geometry/narrow.h"

namespace roboss::narrow {
namespace {

/// One point between a sphere round p_W and the surface point at signed distance `distance` below p_W along
/// n.
void add_single(Manifold& out, const Vec3& p_W, const Vec3& n, double distance, double radius) {
    const double gap = distance - radius;
    out.n_W = n;
    out.add(p_W - n * (radius + 0.5 * gap), gap, 0);
}

/// Two balls; `aside` is the normal when the centres coincide.
void ball_ball(const Vec3& a_W, double a_radius, const Vec3& b_W, double b_radius, const Vec3& aside,
               double margin, Manifold& out) {
    const Vec3 d = a_W - b_W;
    const double reach = a_radius + b_radius + margin;
    const double distance_squared = norm_squared(d);
    if (reach < 0.0 || distance_squared > reach * reach) return;
    const double distance = std::sqrt(distance_squared);
    const Vec3 n =
        distance > 1e-12 * (a_radius + b_radius) ? d / distance : aside;  // nearer, d is all rounding
    add_single(out, a_W, n, distance - b_radius, a_radius);
}

}  // namespace

void sphere_sphere(const Posed& a, const Posed& b, double margin, Manifold& out) {
    ball_ball(a.X.p, a.shape.radius, b.X.p, b.shape.radius, a.axis(2), margin, out);
}

void sphere_capsule(const Posed& sphere, const Posed& capsule, double margin, Manifold& out) {
    const Vec3 u = capsule.axis(2);
    const double l = capsule.shape.half_length;
    const double along = std::clamp(dot(u, sphere.X.p - capsule.X.p), -l, l);
    ball_ball(sphere.X.p, sphere.shape.radius, capsule.X.p + u * along, capsule.shape.radius, capsule.axis(0),
              margin, out);
}

void sphere_box(const Posed& sphere, const Posed& box, double margin, Manifold& out) {
    const Vec3 p = transpose_times(box.X.R, sphere.X.p - box.X.p);  // centre in the box's frame
    const Vec3& h = box.shape.half;
    const Vec3 d{p.x - std::clamp(p.x, -h.x, h.x), p.y - std::clamp(p.y, -h.y, h.y),
                 p.z - std::clamp(p.z, -h.z, h.z)};
    const double r = sphere.shape.radius, reach = r + margin;
    const double distance_squared = norm_squared(d);
    if (reach < 0.0 || distance_squared > reach * reach) return;
    if (distance_squared > 1e-300) {
        const double distance = std::sqrt(distance_squared);
        add_single(out, sphere.X.p, box.X.R * (d / distance), distance, r);
        return;
    }
    const Vec3 depth{h.x - std::fabs(p.x), h.y - std::fabs(p.y), h.z - std::fabs(p.z)};
    const std::size_t k = depth.z <= depth.x && depth.z <= depth.y ? 2 : depth.y <= depth.x ? 1 : 0;
    if (-depth[k] > reach) return;
    add_single(out, sphere.X.p, p[k] < 0.0 ? -box.axis(k) : box.axis(k), -depth[k], r);
}

void sphere_cylinder(const Posed& sphere, const Posed& cylinder, double margin, Manifold& out) {
    const Vec3 p = transpose_times(cylinder.X.R, sphere.X.p - cylinder.X.p);
    const double r = cylinder.shape.radius, l = cylinder.shape.half_length,
                 reach = sphere.shape.radius + margin;
    const double radial = std::sqrt(p.x * p.x + p.y * p.y);
    const Vec3 out_of_axis = radial > 1e-150 ? Vec3{p.x / radial, p.y / radial, 0.0} : Vec3{1.0, 0.0, 0.0};
    const double beyond_side = radial - r, beyond_cap = std::fabs(p.z) - l;
    const double up = p.z < 0.0 ? -1.0 : 1.0;

    const double ds = std::max(beyond_side, 0.0), dz = std::max(beyond_cap, 0.0);
    const double distance = std::sqrt(ds * ds + dz * dz);
    if (distance > reach) return;
    if (distance > 1e-150) {
        const Vec3 n{out_of_axis.x * ds, out_of_axis.y * ds, up * dz};
        add_single(out, sphere.X.p, cylinder.X.R * (n / distance), distance, sphere.shape.radius);
    } else if (beyond_cap >= beyond_side) {
        if (beyond_cap <= reach)
            add_single(out, sphere.X.p, cylinder.axis(2) * up, beyond_cap, sphere.shape.radius);
    } else if (beyond_side <= reach) {
        add_single(out, sphere.X.p, cylinder.X.R * out_of_axis, beyond_side, sphere.shape.radius);
    }
}

}  // namespace roboss::narrow
