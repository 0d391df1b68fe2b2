// Solids of uniform density: volumes and second moments from any table (box, ellipsoid, cylinder, cone,
// capsule); of meshes and polylines summed over tetrahedra (Eberly, "Polyhedral Mass Properties", 2002).
#include "sdf/automatic_inertia.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <vector>

#include "math/solid.h"
#include "mjcf/mesh_solid.h"

namespace roboss::sdf_import {
namespace {

constexpr double kWater = 1000.0;  // kg/m^3, SDFormat's default density

/// The sum over the tetrahedra between the origin and the triangles, which must be closed and wound outward.
class SolidSum {
  public:
    void add(const Vec3& a, const Vec3& b, const Vec3& c) {
        const double v = dot(a, cross(b, c)) / 6.0;
        volume_ += v;
        const Vec3 sum = a + b + c;
        first_ += sum * (v / 4.0);
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                const double corners = a[i] * a[j] + b[i] * b[j] + c[i] * c[j];
                second_(i, j) += v / 20.0 * (corners + sum[i] * sum[j]);
            }
        }
    }
    /// nullopt: no volume, or inside out.
    std::optional<Solid> solid() const {
        if (!(volume_ > 0)) return std::nullopt;
        const Vec3 c = first_ / volume_;
        Mat3 about_centre;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) about_centre(i, j) = second_(i, j) - volume_ * c[i] * c[j];
        const double trace = about_centre(0, 0) + about_centre(1, 1) + about_centre(2, 2);
        return Solid{volume_, c, Mat3::diagonal(trace, trace, trace) - about_centre};
    }

  private:
    double volume_ = 0;
    Vec3 first_;
    Mat3 second_;
};

/// Whether every edge is walked once each way.
bool is_closed(const MeshSpec& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            edges[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    }
    return std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 0; });
}

std::optional<Solid> closed_solid(const MeshSpec& mesh) {
    if (!is_closed(mesh)) return std::nullopt;
    SolidSum sum;
    for (const auto& t : mesh.triangles)
        sum.add(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
    return sum.solid();
}

/// A mesh with holes, or inside out, has the volume of its convex hull, as which it collides.
std::optional<Solid> mesh_solid(const MeshSpec& mesh, const Element& geometry, const Import& import) {
    if (const auto solid = closed_solid(mesh)) return solid;
    import.diagnostics().note(
        geometry.where(), "automatic-inertia",
        "the mesh '" + mesh.source +
            "' has holes, or is inside out; the automatic inertia is that of its convex hull");
    const auto hull = mjcf::hull_of(mesh);
    return hull ? closed_solid(*hull) : std::nullopt;
}

/// Triangles of a fan need not lie inside a polygon: their signed sum is right all the same.
std::optional<Solid> prism(const std::vector<Vec3>& outline, double height) {
    for (const bool reversed : {false, true}) {
        SolidSum sum;
        const Vec3 up{0, 0, height};
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const Vec3& p = outline[i];
            const Vec3& q = outline[(i + 1) % outline.size()];
            const Vec3 a = reversed ? q : p, b = reversed ? p : q;
            sum.add(a, b, b + up), sum.add(a, b + up, a + up);  // a side
            sum.add(up, a + up, b + up), sum.add({}, b, a);     // its shares of top and bottom
        }
        if (const auto solid = sum.solid()) return solid;
    }
    return std::nullopt;
}

std::optional<Solid> solid_of(const Element& geometry, const Import& import) {
    Pose unused;
    const auto spec = convert_geometry(geometry, GeometryUse::kCollide, import, unused);
    if (!spec) return std::nullopt;
    switch (spec->kind) {
        case GeometryKind::kBox:
            return solid_box(spec->size);
        case GeometryKind::kSphere:
            return solid_ellipsoid({spec->radius, spec->radius, spec->radius});
        case GeometryKind::kCylinder:
            return solid_cylinder(spec->radius, spec->length);
        case GeometryKind::kCapsule:
            return solid_capsule(spec->radius, spec->length);
        case GeometryKind::kEllipsoid:
            return solid_ellipsoid(spec->size);
        case GeometryKind::kCone:
            return solid_cone(spec->radius, spec->length);
        case GeometryKind::kMesh:
            return spec->mesh ? mesh_solid(*spec->mesh, geometry, import) : std::nullopt;
        case GeometryKind::kPolyline:
            return prism(spec->outline, spec->length);
        default:
            return std::nullopt;
    }
}

struct Placed {
    Solid solid;
    Pose X_LS;
    double density = kWater;
};

std::vector<Placed> solids_of(const Element& link, const PoseInLink& pose_of, const Import& import) {
    const double link_density = import.reader.number(link.child("inertial"), "density", kWater);
    std::vector<Placed> solids;
    for (const auto node : link.node.children("collision")) {
        const Element collision{link.source, node};
        const auto solid = solid_of(collision.child("geometry"), import);
        if (solid) {
            solids.push_back(
                {*solid, pose_of(collision), import.reader.number(collision, "density", link_density)});
        } else {
            import.diagnostics().warning(
                collision.where(), "automatic-inertia",
                "collision '" + collision.name() + "' adds nothing to the automatic inertia of its link",
                "Write the link's <mass> and <inertia>, or use a shape with a volume.");
        }
    }
    return solids;
}

}  // namespace

std::optional<MassProperties> automatic_inertia(const Element& link, const PoseInLink& pose_of,
                                                const Import& import) {
    const auto solids = solids_of(link, pose_of, import);
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
        const Vec3 d = p.X_LS * p.solid.centre - all.centre;
        const double mass = p.solid.volume * p.density, dd = dot(d, d);
        const Mat3 outer{d * d.x, d * d.y, d * d.z};
        all.inertia = all.inertia + R * p.solid.inertia * transpose(R) * p.density +
                      (Mat3::diagonal(dd, dd, dd) - outer) * mass;
    }
    return all;
}

}  // namespace roboss::sdf_import
