// Shells: spheres, cylinders and boxes from any table. The shell of an ellipsoid has no closed form: MuJoCo
// takes Thomsen's approximation of its area, and for its moments the difference of two ellipsoids.
#include "mjcf/mass.h"

#include <algorithm>
#include <cmath>

#include "core/fixed_math.h"
#include "mjcf/principal.h"

namespace roboss::mjcf {
namespace {

constexpr double kLeastMass = 1e-14;  // kg; of MuJoCo (mjEPS)

/// The part of a shell: its area, and its moments about its own centre.
struct Part {
    double area = 0;
    Vec3 moments;
};

Mat3 diagonal_of(const Vec3& m) {
    return Mat3::diagonal(m.x, m.y, m.z);
}

Part tube(double r, double l) {
    const double area = 2 * kPi * r * l, across = area * (6 * r * r + l * l) / 12;
    return {area, {across, across, area * r * r}};
}

Solid shell_sphere(double r) {
    const double area = 4 * kPi * r * r, moment = 2.0 / 3.0 * area * r * r;
    return {area, {}, diagonal_of({moment, moment, moment})};
}

Solid shell_cylinder(double r, double l) {
    const Part side = tube(r, l);
    const double disk = kPi * r * r, across = disk * (r * r / 4 + l * l / 4);
    return {side.area + 2 * disk, {}, diagonal_of(side.moments + Vec3{2 * across, 2 * across, disk * r * r})};
}

Solid shell_capsule(double r, double l) {
    const Part side = tube(r, l);
    const double sphere = 4 * kPi * r * r, own = 2.0 / 3.0 * sphere * r * r;
    const double off = l / 2 + r / 2;  // of the centre of a hemispherical shell
    const double across = own + sphere * (off * off - r * r / 4);
    return {side.area + sphere, {}, diagonal_of(side.moments + Vec3{across, across, own})};
}

Solid shell_box(const Vec3& e) {
    const double yz = e.y * e.z, xz = e.x * e.z, xy = e.x * e.y;
    const auto moment = [](double along_a, double along_b, double across, double a, double b) {
        // Two faces at right angles to a, two to b, and the two across, about the third axis.
        return 2 * (along_a * (b * b / 12 + a * a / 4) + along_b * (a * a / 12 + b * b / 4) +
                    across * (a * a + b * b) / 12);
    };
    return {2 * (yz + xz + xy),
            {},
            diagonal_of(
                {moment(xz, xy, yz, e.y, e.z), moment(yz, xy, xz, e.x, e.z), moment(yz, xz, xy, e.x, e.y)})};
}

Solid shell_ellipsoid(const Vec3& r) {
    constexpr double kPower = 1.6075, kThick = 1e-6;
    const auto power = [](double x, double exponent) { return fixed_exp(exponent * fixed_log(x)); };
    const double sum = power(r.x * r.y, kPower) + power(r.y * r.z, kPower) + power(r.z * r.x, kPower);
    const double area = 4 * kPi * power(sum / 3, 1 / kPower);
    const Solid inner = solid_ellipsoid(r), outer = solid_ellipsoid(r + Vec3{kThick, kThick, kThick});
    return {area, {}, (outer.inertia - inner.inertia) * (area / (outer.volume - inner.volume))};
}

Mat3 about_point(double mass, const Vec3& d) {
    const double dd = dot(d, d);
    const Mat3 outer{d * d.x, d * d.y, d * d.z};
    return (Mat3::diagonal(dd, dd, dd) - outer) * mass;
}

}  // namespace

std::optional<Solid> shell_of(const GeometrySpec& shape) {
    switch (shape.kind) {
        case GeometryKind::kSphere:
            return shell_sphere(shape.radius);
        case GeometryKind::kCapsule:
            return shell_capsule(shape.radius, shape.length);
        case GeometryKind::kCylinder:
            return shell_cylinder(shape.radius, shape.length);
        case GeometryKind::kEllipsoid:
            return shell_ellipsoid(shape.size);
        case GeometryKind::kBox:
            return shell_box(shape.size);
        default:
            return std::nullopt;
    }
}

std::optional<Solid> solid_of(const GeometrySpec& shape) {
    switch (shape.kind) {
        case GeometryKind::kSphere:
            return solid_ellipsoid({shape.radius, shape.radius, shape.radius});
        case GeometryKind::kCapsule:
            return solid_capsule(shape.radius, shape.length);
        case GeometryKind::kCylinder:
            return solid_cylinder(shape.radius, shape.length);
        case GeometryKind::kEllipsoid:
            return solid_ellipsoid(shape.size);
        case GeometryKind::kBox:
            return solid_box(shape.size);
        default:
            return std::nullopt;
    }
}

Mass placed(const Solid& solid, const Pose& X, double density) {
    const Mat3 R = to_matrix(X.q);
    return {solid.volume * density, X * solid.centre, R * solid.inertia * transpose(R) * density};
}

std::optional<Mass> sum_of(std::span<const GeomMass> geoms, const Settings& settings) {
    const auto counts = [&](const GeomMass& geom) {
        return geom.mass.mass > kLeastMass && geom.group >= settings.inertia_group_first &&
               geom.group <= settings.inertia_group_last;
    };
    Mass sum;
    for (const GeomMass& geom : geoms) {
        if (!counts(geom)) continue;
        sum.mass += geom.mass.mass;
        sum.centre += geom.mass.centre * geom.mass.mass;
    }
    if (!(sum.mass > 0)) return std::nullopt;
    sum.centre = sum.centre / sum.mass;
    for (const GeomMass& geom : geoms)
        if (counts(geom))
            sum.inertia =
                sum.inertia + geom.mass.inertia + about_point(geom.mass.mass, geom.mass.centre - sum.centre);
    return sum;
}

Mass bounded(const Mass& given, const Settings& settings) {
    Mass mass = given;
    mass.mass = std::max(mass.mass, settings.least_mass);
    if (!(settings.least_inertia > 0) && !settings.balance_inertia) return mass;
    const PrincipalAxes axes = principal_axes(mass.inertia);
    Vec3 moments{axes.moments[0], axes.moments[1], axes.moments[2]};
    for (std::size_t k = 0; k < 3; ++k) moments[k] = std::max(moments[k], settings.least_inertia);
    const bool real = moments.x <= moments.y + moments.z && moments.y <= moments.x + moments.z &&
                      moments.z <= moments.x + moments.y;
    const double mean = (moments.x + moments.y + moments.z) / 3;
    if (!real && settings.balance_inertia) moments = {mean, mean, mean};
    mass.inertia = from_principal(moments, axes.q);
    return mass;
}

}  // namespace roboss::mjcf
