// See ray_shape.h.
#include "sensors/ray_shape.h"

#include "geometry/triangle_surface.h"
#include "sensors/ray_intervals.h"

namespace roboss {

double ray_distance(const Shape& shape, const Transform& X_WS, const Vec3& origin_W,
                    const Vec3& direction_W) {
    const Vec3 o = transpose_times(X_WS.R, origin_W - X_WS.p);
    const Vec3 d = transpose_times(X_WS.R, direction_W);
    if (shape.kind == ShapeKind::kSurface) return shape.surface->ray(o, d, kInfinity);
    const ConvexHull::Face* faces = shape.hull != nullptr ? shape.hull->faces.data() : nullptr;
    const std::size_t count = shape.hull != nullptr ? shape.hull->faces.size() : 0;
    return ray_shapes::first_crossing(ray_shapes::cross_shape(shape, faces, count, o, d));
}

}  // namespace roboss
