// Meshes made in code: boxes, balls, floors, and the collisions that carry them.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include <support/bodies.h>

namespace roboss::test {

inline MeshSpec box_mesh(const Vec3& size) {
    MeshSpec mesh;
    mesh.source = "box";
    for (int k = 0; k < 8; ++k)
        mesh.vertices.push_back(
            {(k & 1 ? 0.5 : -0.5) * size.x, (k & 2 ? 0.5 : -0.5) * size.y, (k & 4 ? 0.5 : -0.5) * size.z});
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

/// An icosahedron, each face cut into four `levels` times, all corners at the radius.
inline MeshSpec ball_mesh(double radius, int levels) {
    MeshSpec mesh;
    mesh.source = "ball";
    const double t = 0.5 * (1.0 + std::sqrt(5.0));
    for (const Vec3& p :
         {Vec3{-1, t, 0}, Vec3{1, t, 0}, Vec3{-1, -t, 0}, Vec3{1, -t, 0}, Vec3{0, -1, t}, Vec3{0, 1, t},
          Vec3{0, -1, -t}, Vec3{0, 1, -t}, Vec3{t, 0, -1}, Vec3{t, 0, 1}, Vec3{-t, 0, -1}, Vec3{-t, 0, 1}})
        mesh.vertices.push_back(normalized(p) * radius);
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [entry, is_new] =
                middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices.size()));
            if (is_new) mesh.vertices.push_back(normalized(mesh.vertices[a] + mesh.vertices[b]) * radius);
            return entry->second;
        };
        std::vector<std::array<std::uint32_t, 3>> finer;
        for (const auto& [a, b, c] : mesh.triangles) {
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        mesh.triangles = std::move(finer);
    }
    return mesh;
}

/// A sheet of 2 * cells_x * cells_y triangles, heights by a function of (x, y).
template <class Height>
MeshSpec sheet_mesh(double size_x, double size_y, std::uint32_t cells_x, std::uint32_t cells_y,
                    Height height) {
    MeshSpec mesh;
    mesh.source = "sheet";
    for (std::uint32_t j = 0; j <= cells_y; ++j)
        for (std::uint32_t i = 0; i <= cells_x; ++i) {
            const double x = size_x * (i / static_cast<double>(cells_x) - 0.5);
            const double y = size_y * (j / static_cast<double>(cells_y) - 0.5);
            mesh.vertices.push_back({x, y, height(x, y)});
        }
    for (std::uint32_t j = 0; j < cells_y; ++j)
        for (std::uint32_t i = 0; i < cells_x; ++i) {
            const std::uint32_t a = j * (cells_x + 1) + i, b = a + 1, c = b + cells_x + 1, d = c - 1;
            if ((i + j) % 2 == 0)
                mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
            else
                mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {b, c, d}});
        }
    return mesh;
}

inline CollisionSpec mesh_shape(MeshSpec mesh, const SurfaceSpec& s, const Pose& X_LS = {}) {
    CollisionSpec c = collision(GeometryKind::kMesh, s, X_LS);
    c.geometry.mesh = std::make_shared<const MeshSpec>(std::move(mesh));
    return c;
}

inline CollisionSpec ellipsoid_shape(const Vec3& radii, const SurfaceSpec& s, const Pose& X_LS = {}) {
    CollisionSpec c = collision(GeometryKind::kEllipsoid, s, X_LS);
    c.geometry.size = radii;
    return c;
}

inline CollisionSpec heightmap_shape(std::size_t columns, std::size_t rows, std::vector<double> heights,
                                     double size_x, double size_y, const SurfaceSpec& s) {
    CollisionSpec c = collision(GeometryKind::kHeightmap, s);
    HeightGridSpec grid;
    grid.columns = columns, grid.rows = rows, grid.heights = std::move(heights);
    grid.size_x = size_x, grid.size_y = size_y;
    c.geometry.heights = std::make_shared<const HeightGridSpec>(std::move(grid));
    return c;
}

inline CollisionSpec polyline_shape(std::vector<Vec3> outline, double height, const SurfaceSpec& s,
                                    const Pose& X_LS = {}) {
    CollisionSpec c = collision(GeometryKind::kPolyline, s, X_LS);
    c.geometry.outline = std::move(outline);
    c.geometry.length = height;
    return c;
}

/// A box's mass properties with any collision.
inline ModelSpec box_like(double mass, const Vec3& size, CollisionSpec c) {
    LinkSpec l = link("body", mass, box_inertia(mass, size));
    l.collisions.push_back(std::move(c));
    return one_link(l);
}

inline ModelSpec ball_like(double mass, double radius, CollisionSpec c) {
    LinkSpec l = link("body", mass, sphere_inertia(mass, radius));
    l.collisions.push_back(std::move(c));
    return one_link(l);
}

}  // namespace roboss::test
