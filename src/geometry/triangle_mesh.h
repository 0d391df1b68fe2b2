// TriangleMesh: the triangles of a mesh file with their BVH and neighbours.
#pragma once

#include <span>

#include "geometry/bvh.h"
#include "geometry/triangle_surface.h"

namespace roboss {

class TriangleMesh final : public TriangleSurface {
  public:
    using Corners = std::array<std::uint32_t, 3>;

    /// Triangles without area are left out. A mesh in which every edge has exactly two triangles, wound the
    /// same way and round a positive volume, is solid; any other is a sheet.
    TriangleMesh(std::span<const Vec3> vertices, std::span<const Corners> triangles);

    std::size_t triangle_count() const override { return triangles_.size(); }
    void query(const Aabb& box, std::vector<std::uint32_t>& out) const override { bvh_.query(box, out); }
    bool may_overlap(const Aabb& box) const override { return bvh_.overlaps_any(box); }
    SurfaceTriangle triangle(std::uint32_t number) const override;
    SurfaceFace face(std::uint32_t number) const override {
        const Entry& t = triangles_[number];
        return {{vertices_[t.v[0]], vertices_[t.v[1]], vertices_[t.v[2]]}, t.n};
    }
    bool tops(std::uint32_t number, std::size_t corner, const Vec3& d, double tolerance) const override;
    double ray(const Vec3& origin, const Vec3& direction, double limit) const override;
    SurfaceSource source() const override;

  private:
    struct Entry {
        Corners v{};
        Corners beyond{};  // vertices; kNone: border
        std::array<double, 3> fold{};
        Vec3 n;
    };
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

    bool connect();  // true: every edge has two triangles of one sense
    void find_rings();
    double volume() const;

    std::vector<Vec3> vertices_;
    std::vector<Entry> triangles_;
    std::vector<std::uint32_t> ring_first_, ring_;  // neighbours of each vertex
    Bvh bvh_;
};

}  // namespace roboss
