// Solids of uniform density: volumes and second moments from any table (box, ellipsoid, cylinder, cone,
// capsule).
#include "sdf/automatic_inertia.h"

#include <cstring>
#include <vector>

namespace roboss::sdf_import {
namespace {

constexpr double kWater = 1000.0;  // kg/m^3, SDFormat's default density

/// About the shape's own centre of mass, which lies at `centre` in its frame, per unit of density.
struct Solid {
    double volume = 0;
    Vec3 centre;
    Vec3 moments;  // of inertia, principal: the shape's axes
};

Solid box(const Vec3& s) {
    const double v = s.x * s.y * s.z;
    return {v, {}, Vec3{s.y * s.y + s.z * s.z, s.x * s.x + s.z * s.z, s.x * s.x + s.y * s.y} * (v / 12.0)};
}

Solid ellipsoid(const Vec3& r) {
    const double v = 4.0 / 3.0 * kPi * r.x * r.y * r.z;
    return {v, {}, Vec3{r.y * r.y + r.z * r.z, r.x * r.x + r.z * r.z, r.x * r.x + r.y * r.y} * (v / 5.0)};
}

Solid cylinder(double r, double l) {
    const double v = kPi * r * r * l;
    const double across = v * (3.0 * r * r + l * l) / 12.0;
    return {v, {}, {across, across, v * r * r / 2.0}};
}

/// SDFormat's cone stands centred on its height, the tip up.
Solid cone(double r, double l) {
    const double v = kPi * r * r * l / 3.0;
    const double across = v * (3.0 * r * r / 20.0 + 3.0 * l * l / 80.0);
    return {v, {0, 0, -l / 4.0}, {across, across, 0.3 * v * r * r}};
}

Solid capsule(double r, double l) {
    const Solid straight = cylinder(r, l), ball = ellipsoid({r, r, r});
    // Each half ball's centre is 3/8 r beyond the cylinder's end.
    const double off = l / 2.0 + 3.0 / 8.0 * r;
    const double half_ball_across = ball.moments.x - ball.volume * (9.0 / 64.0) * r * r;
    const double across = straight.moments.x + half_ball_across + ball.volume * off * off;
    return {straight.volume + ball.volume, {}, {across, across, straight.moments.z + ball.moments.z}};
}

std::optional<Solid> solid_of(const Element& geometry, const Import& import) {
    if (const Element shape = geometry.child("cone")) {
        return cone(import.reader.number(shape, "radius", 0.5), import.reader.number(shape, "length", 1.0));
    }
    Pose unused;
    const auto spec = convert_geometry(geometry, import, unused);
    if (!spec) return std::nullopt;
    switch (spec->kind) {
        case GeometryKind::kBox:
            return box(spec->size);
        case GeometryKind::kSphere:
            return ellipsoid({spec->radius, spec->radius, spec->radius});
        case GeometryKind::kCylinder:
            return cylinder(spec->radius, spec->length);
        case GeometryKind::kCapsule:
            return capsule(spec->radius, spec->length);
        case GeometryKind::kEllipsoid:
            return ellipsoid(spec->size);
        default:
            return std::nullopt;
    }
}

struct Placed {
    Solid solid;
    Pose X_LS;
    double density = kWater;
};

std::vector<Placed> solids_of(const Element& link, const Import& import) {
    const double link_density = import.reader.number(link.child("inertial"), "density", kWater);
    std::vector<Placed> solids;
    for (const auto node : link.node.children("collision")) {
        const Element collision{link.source, node};
        const auto solid = solid_of(collision.child("geometry"), import);
        if (solid) {
            solids.push_back({*solid, import.reader.pose(collision.child("pose")),
                              import.reader.number(collision, "density", link_density)});
        } else {
            import.diagnostics().warning(
                collision.where(), "automatic-inertia",
                "collision '" + collision.name() + "' adds nothing to the automatic inertia of its link",
                "Write the link's <mass> and <inertia>, or use primitive shapes.");
        }
    }
    return solids;
}

}  // namespace

std::optional<MassProperties> automatic_inertia(const Element& link, const Import& import) {
    const auto solids = solids_of(link, import);
    MassProperties all;
    for (const Placed& p : solids) {
        const double mass = p.solid.volume * p.density;
        all.mass += mass;
        all.centre += (p.X_LS * p.solid.centre) * mass;
    }
    if (!(all.mass > 0)) return std::nullopt;
    all.centre = all.centre / all.mass;
    for (const Placed& p : solids) {
        const Mat3 R = to_matrix(p.X_LS.q);
        const Vec3 m = p.solid.moments * p.density;
        const Vec3 d = p.X_LS * p.solid.centre - all.centre;
        const double mass = p.solid.volume * p.density, dd = dot(d, d);
        const Mat3 outer{d * d.x, d * d.y, d * d.z};
        all.inertia = all.inertia + R * Mat3::diagonal(m.x, m.y, m.z) * transpose(R) +
                      (Mat3::diagonal(dd, dd, dd) - outer) * mass;
    }
    return all;
}

}  // namespace roboss::sdf_import
