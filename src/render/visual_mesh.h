// VisualMesh: triangles to be seen, with a tree for rays and normals that are smooth where the mesh is.
#pragma once

#include <array>
#include <vector>

#include "render/trace.h"
#include "scene/scene.h"

namespace roboss::render {

class VisualMesh {
  public:
    explicit VisualMesh(const SceneMesh& mesh);

    TraceMesh trace() const {
        return {tree_.nodes.empty() ? nullptr : tree_.nodes.data(), triangles_.data()};
    }
    const Aabb& box() const { return box_; }  // in the frame of the mesh; empty: no triangles

    /// A place on a triangle, by the shares of its second and third corner.
    struct Place {
        std::uint32_t triangle = 0;
        double u = 0, v = 0;
    };
    /// Distance along o + t d to the plane of the triangle, and the place there.
    double cross(const Vec3& o, const Vec3& d, Place& place) const;
    Vec3 flat_normal(std::uint32_t triangle) const;  // unit, by the order of its corners
    Vec3 smooth_normal(const Place& place) const;    // unit
    bool has_uv() const { return !uv_.empty(); }
    std::array<double, 2> uv(const Place& place) const;
    /// Pictures by metre on this triangle.
    double uv_density(std::uint32_t triangle) const;

  private:
    void smooth(const SceneMesh& mesh);
    const std::array<std::uint32_t, 3>& corners(std::uint32_t triangle) const { return corners_[triangle]; }

    std::vector<Vec3> vertices_;
    std::vector<std::array<std::uint32_t, 3>> corners_;
    std::vector<std::array<float, 2>> uv_;                      // by vertex, or none
    std::vector<std::array<std::array<float, 3>, 3>> normals_;  // by triangle and corner
    std::vector<TraceTriangle> triangles_;                      // by leaf of the tree
    BoxTree tree_;
    Aabb box_;
};

}  // namespace roboss::render
