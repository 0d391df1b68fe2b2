// A mesh is cut into pyramids from a point to its triangles. MuJoCo takes the centroid of the surface for
// that point to find the centre of mass, and then the centre of mass for the moments; with signed volumes the
// point does not matter, with `legacy` it does.
#include "mjcf/mesh_solid.h"

#include <cmath>

#include "core/fixed_math.h"
#include "geometry/convex_hull.h"
#include "mjcf/principal.h"

namespace roboss::mjcf {
namespace {

constexpr double kLeastExtent = 1e-15;  // m^2 or m^3; of MuJoCo (mjMINVAL)

struct Triangle {
    Vec3 a, b, c;

    Vec3 centre() const { return (a + b + c) / 3.0; }
    /// Along the normal, as long as the area.
    Vec3 area() const { return cross(b - a, c - a) * 0.5; }
};

template <class Visit>
void for_each_triangle(const MeshSpec& mesh, Visit&& visit) {
    for (const auto& t : mesh.triangles)
        visit(Triangle{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
}

/// Volume of the pyramid from `apex`, or the area of a shell.
double weight(const Triangle& triangle, const Vec3& apex, MeshInertia kind) {
    const Vec3 area = triangle.area();
    if (kind == MeshInertia::kShell) return norm(area);
    const double volume = dot(triangle.centre() - apex, area) / 3.0;
    return kind == MeshInertia::kLegacy ? std::fabs(volume) : volume;
}

std::optional<Vec3> surface_centroid(const MeshSpec& mesh) {
    double total = 0;
    Vec3 sum;
    for_each_triangle(mesh, [&](const Triangle& triangle) {
        const double area = norm(triangle.area());
        total += area;
        sum += triangle.centre() * area;
    });
    return total >= kLeastExtent ? std::optional(sum / total) : std::nullopt;
}

/// Second moments of mass about `centre`, of a density of 1; and the volume about it.
double second_moments(const MeshSpec& mesh, MeshInertia kind, const Vec3& centre, Mat3& second) {
    double total = 0;
    const double divisor = kind == MeshInertia::kShell ? 12.0 : 20.0;
    for_each_triangle(mesh, [&](const Triangle& given) {
        const Vec3 a = given.a - centre, b = given.b - centre, c = given.c - centre, sum = a + b + c;
        const double w = weight({a, b, c}, {}, kind);
        total += w;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                second(i, j) += w / divisor * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + sum[i] * sum[j]);
    });
    return total;
}

}  // namespace

std::optional<MeshSpec> hull_of(const MeshSpec& mesh) {
    const Result<ConvexHull> hull = build_hull(mesh.vertices);
    if (!hull) return std::nullopt;
    MeshSpec result;
    for (const Vec3& vertex : hull.value().vertices)
        result.vertices.push_back(vertex + hull.value().centroid);
    for (const ConvexHull::Face& face : hull.value().faces) {
        const auto* loop = hull.value().face_vertices.data() + face.first;
        for (std::uint32_t k = 2; k < face.count; ++k)
            result.triangles.push_back({loop[0], loop[k - 1], loop[k]});
    }
    return result;
}

std::optional<Solid> mesh_solid(const MeshSpec& mesh, MeshInertia kind) {
    if (kind == MeshInertia::kConvex) {
        const auto hull = hull_of(mesh);
        return hull ? mesh_solid(*hull, MeshInertia::kExact) : std::nullopt;
    }
    const auto apex = surface_centroid(mesh);
    if (!apex) return std::nullopt;
    double total = 0;
    Vec3 sum;
    for_each_triangle(mesh, [&](const Triangle& triangle) {
        const double w = weight(triangle, *apex, kind);
        total += w;
        sum += (triangle.centre() * 0.75 + *apex * 0.25) * w;
    });
    if (!(total >= kLeastExtent)) return std::nullopt;
    Solid solid;
    solid.centre = sum / total;
    Mat3 second;
    solid.volume = second_moments(mesh, kind, solid.centre, second);
    const double trace = second(0, 0) + second(1, 1) + second(2, 2);
    solid.inertia = Mat3::diagonal(trace, trace, trace) - second;
    return solid.volume >= kLeastExtent ? std::optional(solid) : std::nullopt;
}

InertiaBox inertia_box(const Solid& solid) {
    const PrincipalAxes axes = principal_axes(solid.inertia);
    const auto& m = axes.moments;
    const auto half = [&](double wide, double deep, double across) {
        return 0.5 * std::sqrt(fixed_max(0.0, 6 * (wide + deep - across) / solid.volume));
    };
    return {{half(m[1], m[2], m[0]), half(m[0], m[2], m[1]), half(m[0], m[1], m[2])}, axes.q};
}

}  // namespace roboss::mjcf
