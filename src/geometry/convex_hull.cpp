// Support of a hull: all vertices of a small one are looked at, on a large one a climb from vertex to vertex
// (no local maxima: it is convex).
#include "geometry/convex_hull.h"

namespace roboss {
namespace {

constexpr std::size_t kScanned = 48;

}  // namespace

std::uint32_t ConvexHull::furthest(const Vec3& d, std::uint32_t start) const {
    if (vertices.size() <= kScanned) {
        std::uint32_t best = 0;
        double most = dot(d, vertices[0]);
        for (std::uint32_t i = 1; i < vertices.size(); ++i) {
            const double x = dot(d, vertices[i]);
            const bool is_further = x > most;  // no branch: it would be guessed wrong
            most = is_further ? x : most;
            best = is_further ? i : best;
        }
        return best;
    }
    std::uint32_t at = start;
    double most = dot(d, vertices[at]);
    for (bool moved = true; moved;) {
        moved = false;
        const std::uint32_t from = at;
        for (std::uint32_t k = vertex_first[from]; k < vertex_first[from + 1]; ++k) {
            const Edge& edge = edges[vertex_edges[k]];
            const std::uint32_t other = edge.a == from ? edge.b : edge.a;
            const double x = dot(d, vertices[other]);
            if (x > most) most = x, at = other, moved = true;
        }
    }
    return at;
}

std::uint32_t ConvexHull::face_along(const Vec3& d, std::uint32_t vertex) const {
    std::uint32_t best = vertex_faces[vertex_first[vertex]];
    for (std::uint32_t k = vertex_first[vertex]; k < vertex_first[vertex + 1]; ++k) {
        const std::uint32_t face = vertex_faces[k];
        const double gain = dot(d, faces[face].n) - dot(d, faces[best].n);
        if (gain > 1e-9 || (gain > -1e-9 && face < best)) best = face;
    }
    return best;
}

Shape hull_shape(const ConvexHull& hull) {
    Shape shape;
    shape.kind = ShapeKind::kHull;
    shape.radius = hull.radius;
    shape.hull = &hull;
    return shape;
}

}  // namespace roboss
