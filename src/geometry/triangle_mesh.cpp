// Edges are matched by sorting, so the result does not depend on any table's order.
#include "geometry/triangle_mesh.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "core/hash.h"

namespace roboss {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct HalfEdge {
    std::uint32_t low = 0, high = 0, triangle = 0, side = 0;
    bool upward = false;  // runs from low to high
};

}  // namespace

Shape surface_shape(const TriangleSurface& surface) {
    Shape shape;
    shape.kind = ShapeKind::kSurface;
    shape.surface = &surface;
    return shape;
}

double ray_triangle(const Vec3& origin, const Vec3& direction, const std::array<Vec3, 3>& v) {
    // Moeller and Trumbore, "Fast, Minimum Storage Ray-Triangle Intersection", 1997.
    constexpr double kSeam = 1e-9;
    const Vec3 e1 = v[1] - v[0], e2 = v[2] - v[0];
    const Vec3 p = cross(direction, e2);
    const double determinant = dot(e1, p);
    if (determinant == 0.0) return kInfinity;
    const Vec3 t = origin - v[0];
    const double a = dot(t, p) / determinant;
    if (!(a >= -kSeam && a <= 1.0 + kSeam)) return kInfinity;
    const Vec3 q = cross(t, e1);
    const double b = dot(direction, q) / determinant;
    if (!(b >= -kSeam && a + b <= 1.0 + kSeam)) return kInfinity;
    const double distance = dot(e2, q) / determinant;
    return distance >= 0.0 ? distance : kInfinity;
}

double fold_at(const Vec3& n, const Vec3& a, const Vec3& b, const Vec3& beyond) {
    const Vec3 along = b - a, out = beyond - a;
    const Vec3 across = out - along * (dot(out, along) / norm_squared(along));
    const double length = norm(across);
    const double sine = length > 0.0 ? dot(n, out) / length : 0.0;
    // A neighbour folded back over the triangle is as sharp as can be.
    return dot(across, cross(n, along)) > 0.0 ? (sine < 0.0 ? -1.0 : 1.0) : sine;
}

TriangleMesh::TriangleMesh(std::span<const Vec3> vertices, std::span<const Corners> triangles)
    : vertices_(vertices.begin(), vertices.end()) {
    Hash hash;
    for (const Vec3& v : vertices_) {
        box_.include(v);
        hash.add(v.x), hash.add(v.y), hash.add(v.z);
    }
    const double smallest = 1e-14 * (box_.empty() ? 0.0 : norm_squared(box_.max - box_.min));
    std::vector<Aabb> boxes;
    for (const Corners& t : triangles) {
        const Vec3 &a = vertices_[t[0]], &b = vertices_[t[1]], &c = vertices_[t[2]];
        const Vec3 area = cross(b - a, c - a);
        const double size = norm(area);
        if (!(size > smallest)) continue;
        triangles_.push_back({t, {kNone, kNone, kNone}, {}, area / size});
        Aabb box;
        box.include(a), box.include(b), box.include(c);
        boxes.push_back(box);
        for (const std::uint32_t v : t) hash.add(static_cast<std::uint64_t>(v));
    }
    hash_ = hash.value();
    bvh_ = Bvh(boxes);
    sides_ = connect() && volume() > 0.0 ? SurfaceSides::kSolid : SurfaceSides::kBoth;
    find_rings();
}

SurfaceSource TriangleMesh::source() const {
    MeshSource source{vertices_, {}};
    for (const Entry& entry : triangles_) source.triangles.push_back(entry.v);
    return source;
}

bool TriangleMesh::connect() {
    std::vector<HalfEdge> edges;
    edges.reserve(3 * triangles_.size());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t a = triangles_[t].v[k], b = triangles_[t].v[(k + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), t, k, a < b});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
        return std::tuple(a.low, a.high, a.triangle) < std::tuple(b.low, b.high, b.triangle);
    });
    bool closed = !edges.empty();
    for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
        while (last < edges.size() && edges[last].low == edges[first].low &&
               edges[last].high == edges[first].high)
            ++last;
        const bool pair = last - first == 2;
        closed &= pair && edges[first].upward != edges[first + 1].upward;
        for (std::size_t i = first; i < last; ++i) {
            Entry& entry = triangles_[edges[i].triangle];
            const std::size_t k = edges[i].side;
            if (!pair) {  // a border, or where more than two meet: all of it is edge
                entry.fold[k] = SurfaceTriangle::kBorder;
                continue;
            }
            const HalfEdge& other = edges[i == first ? first + 1 : first];
            entry.beyond[k] = triangles_[other.triangle].v[(other.side + 2) % 3];
            entry.fold[k] = fold_at(entry.n, vertices_[entry.v[k]], vertices_[entry.v[(k + 1) % 3]],
                                    vertices_[entry.beyond[k]]);
        }
    }
    return closed;
}

void TriangleMesh::find_rings() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    pairs.reserve(6 * triangles_.size());
    for (const Entry& t : triangles_)
        for (std::size_t k = 0; k < 3; ++k) {
            pairs.emplace_back(t.v[k], t.v[(k + 1) % 3]);
            pairs.emplace_back(t.v[(k + 1) % 3], t.v[k]);
        }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    ring_first_.assign(vertices_.size() + 1, 0);
    for (const auto& [from, to] : pairs) ++ring_first_[from + 1], ring_.push_back(to);
    for (std::size_t v = 0; v < vertices_.size(); ++v) ring_first_[v + 1] += ring_first_[v];
}

double TriangleMesh::volume() const {
    double six = 0;
    for (const Entry& t : triangles_) {
        const Vec3 origin = box_.min;
        six += dot(vertices_[t.v[0]] - origin, cross(vertices_[t.v[1]] - origin, vertices_[t.v[2]] - origin));
    }
    return six / 6.0;
}

SurfaceTriangle TriangleMesh::triangle(std::uint32_t number) const {
    const Entry& t = triangles_[number];
    SurfaceTriangle out;
    out.n = t.n;
    out.fold = t.fold;
    for (std::size_t k = 0; k < 3; ++k) {
        out.v[k] = vertices_[t.v[k]];
        out.beyond[k] = t.beyond[k] == kNone ? out.v[k] : vertices_[t.beyond[k]];
    }
    return out;
}

bool TriangleMesh::tops(std::uint32_t number, std::size_t corner, const Vec3& d, double tolerance) const {
    const std::uint32_t v = triangles_[number].v[corner];
    for (std::uint32_t k = ring_first_[v]; k < ring_first_[v + 1]; ++k) {
        const Vec3 edge = vertices_[ring_[k]] - vertices_[v];
        if (dot(d, edge) > tolerance * norm(edge)) return false;
    }
    return true;
}

double TriangleMesh::ray(const Vec3& origin, const Vec3& direction, double limit) const {
    return bvh_.nearest(origin, direction, limit, [&](std::uint32_t i) {
        const Corners& v = triangles_[i].v;
        return ray_triangle(origin, direction, {vertices_[v[0]], vertices_[v[1]], vertices_[v[2]]});
    });
}

}  // namespace roboss
