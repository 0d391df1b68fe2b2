// See convex_hull.h.
#include "geometry/convex_hull.h"

namespace roboss {

std::uint32_t ConvexHull::furthest(const Vec3& d) const {
    return cells.furthest(d, vertices);
}

double ConvexHull::reach(const Vec3& d) const {
    return dot(d, vertices[furthest(d)]);
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
