// ConvexHull: a convex polytope with everything the narrow phase asks for: planar faces (coplanar triangles
// merged, so that a cube has six), edges, and what meets at each vertex. Built once, by compile.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/result.h"
#include "geometry/direction_cells.h"
#include "geometry/shape.h"
#include "math/vec3.h"

namespace roboss {

struct ConvexHull {
    struct Face {
        Vec3 n;             // unit, outward
        double offset = 0;  // n.x = offset on the face
        std::uint32_t first = 0, count = 0;
    };
    struct Edge {
        std::uint32_t a = 0, b = 0;         // vertices, a < b
        std::uint32_t left = 0, right = 0;  // faces
        Vec3 direction;                     // unit, a to b
    };

    std::vector<Vec3> vertices;  // m, about the hull's centroid
    std::vector<Face> faces;
    std::vector<std::uint32_t> face_vertices;  // loops, counter-clockwise seen from outside
    std::vector<std::uint32_t> face_edges;     // edge i of a loop runs from its vertex i to the next
    std::vector<Edge> edges;
    std::vector<std::uint32_t> vertex_first;                // vertex v: entries vertex_first[v] .. [v + 1]
    std::vector<std::uint32_t> vertex_edges, vertex_faces;  // of these two
    Vec3 centroid;                                          // in the frame of the points it was built from
    double volume = 0;                                      // m^3
    double radius = 0, inradius = 0;                        // about the centroid
    std::uint64_t hash = 0;                                 // of the vertices

    DirectionCells cells;  // of the vertices, unless they are few

    /// Number of the vertex furthest along d (any length), the lowest of equals.
    std::uint32_t furthest(const Vec3& d) const;
    /// d.v of that vertex.
    double reach(const Vec3& d) const;
    /// Of the faces at a vertex, the one that looks most along d.
    std::uint32_t face_along(const Vec3& d, std::uint32_t vertex) const;
};

/// The hull of points, at most 4096 of them on it; points within 2e-7 of the size of its surface may be left
/// out. The result depends on the points as a sequence only. An error when they are fewer than four, not
/// finite or flat.
Result<ConvexHull> build_hull(std::span<const Vec3> points);

/// A hull again from what it was built to, bit for bit: its vertices about its centroid and its faces' loops.
/// Everything else is computed from these; an Error when they do not close to a convex body.
struct HullParts {
    std::vector<Vec3> vertices;
    std::vector<std::uint32_t> loop_sizes, face_vertices;
    Vec3 centroid;
    double volume = 0;
};
HullParts parts_of(const ConvexHull& hull);
Result<ConvexHull> join_hull(HullParts parts);

Shape hull_shape(const ConvexHull& hull);

}  // namespace roboss
