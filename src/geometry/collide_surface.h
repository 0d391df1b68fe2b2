// Contacts of a bounded convex shape with triangles. Each point has a normal of its own, for a body may touch
// a floor and a wall of one mesh at once.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/triangle_surface.h"

namespace roboss {

struct SurfaceContact {
    Vec3 p_W, n_W;  // n: from the surface towards the shape
    double gap = 0;
    std::uint32_t feature = 0;  // unique among the contacts of one call
};

/// Buffers of a call and its result; nothing is allocated once they have grown.
struct SurfaceContacts {
    std::vector<SurfaceContact> points;
    std::vector<SurfaceContact> candidates, deep, cluster;
    std::vector<Vec3> pierced;  // normals of faces that the body overlaps
    std::vector<std::uint32_t> triangles;
    std::vector<Vec3> positions;
    std::vector<double> gaps;
};

/// Fills out.points: for each direction of contact at most 8 points with gap <= margin. A contact's normal is
/// one that the surface itself has there (of a face, or between the faces of a ridge), so seams inside a
/// smooth surface are not felt. `shape`: any but a plane or surface.
void collide_surface(const Shape& shape, const Transform& X_WA, const TriangleSurface& surface,
                     const Transform& X_WS, double margin, SurfaceContacts& out);

}  // namespace roboss
