// Meshes of hulls, surfaces, height grids and outlines.
#include "scene/shape_table.h"

#include <algorithm>

#include "core/hash.h"
#include "geometry/polygon_pieces.h"

namespace roboss {
namespace {

SceneMesh mesh_of_hull(const ConvexHull& hull) {
    SceneMesh mesh;
    mesh.vertices = hull.vertices;
    for (const ConvexHull::Face& face : hull.faces) {
        const std::uint32_t* loop = hull.face_vertices.data() + face.first;
        for (std::uint32_t k = 2; k < face.count; ++k)
            mesh.triangles.push_back({loop[0], loop[k - 1], loop[k]});
    }
    return mesh;
}

/// Heights row by row; x grows within a row, y from row to row.
SceneMesh mesh_of_heights(std::size_t columns, std::size_t rows, const std::vector<double>& heights,
                          const Vec3& size, const Vec3& centre) {
    SceneMesh mesh;
    if (columns < 2 || rows < 2 || heights.size() < columns * rows) return mesh;
    const auto share = [](std::size_t i, std::size_t count) {
        return static_cast<double>(i) / static_cast<double>(count - 1) - 0.5;
    };
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < columns; ++c)
            mesh.vertices.push_back(
                centre + Vec3{share(c, columns) * size.x, share(r, rows) * size.y, heights[r * columns + c]});
    for (std::size_t r = 0; r + 1 < rows; ++r)
        for (std::size_t c = 0; c + 1 < columns; ++c) {
            const auto corner = static_cast<std::uint32_t>(r * columns + c);
            const auto above = corner + static_cast<std::uint32_t>(columns);
            mesh.triangles.push_back({corner, corner + 1, above + 1});
            mesh.triangles.push_back({corner, above + 1, above});
        }
    return mesh;
}

SceneMesh mesh_of_surface(const TriangleSurface& surface) {
    const SurfaceSource source = surface.source();
    if (const auto* mesh = std::get_if<MeshSource>(&source)) return {mesh->vertices, mesh->triangles, {}};
    const auto& grid = std::get<HeightSource>(source);
    return mesh_of_heights(grid.columns, grid.rows, grid.heights, {grid.size_x, grid.size_y, 0}, {});
}

/// Convex pieces of an outline between z = 0 and `height`.
SceneMesh mesh_of_prisms(const std::vector<std::vector<Vec3>>& pieces, double height) {
    SceneMesh mesh;
    for (const std::vector<Vec3>& piece : pieces) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        const auto n = static_cast<std::uint32_t>(piece.size());
        for (const Vec3& p : piece) mesh.vertices.push_back({p.x, p.y, 0});
        for (const Vec3& p : piece) mesh.vertices.push_back({p.x, p.y, height});
        for (std::uint32_t k = 2; k < n; ++k) {
            mesh.triangles.push_back({first, first + k, first + k - 1});
            mesh.triangles.push_back({first + n, first + n + k - 1, first + n + k});
        }
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t a = first + k, b = first + (k + 1) % n;
            mesh.triangles.push_back({a, b, b + n});
            mesh.triangles.push_back({a, b + n, a + n});
        }
    }
    return mesh;
}

SceneShapeKind kind_of(GeometryKind kind) {
    switch (kind) {
        case GeometryKind::kPlane:
            return SceneShapeKind::kPlane;
        case GeometryKind::kBox:
            return SceneShapeKind::kBox;
        case GeometryKind::kSphere:
            return SceneShapeKind::kSphere;
        case GeometryKind::kCylinder:
            return SceneShapeKind::kCylinder;
        case GeometryKind::kCapsule:
            return SceneShapeKind::kCapsule;
        case GeometryKind::kEllipsoid:
            return SceneShapeKind::kEllipsoid;
        case GeometryKind::kCone:
            return SceneShapeKind::kCone;
        case GeometryKind::kMesh:
        case GeometryKind::kHeightmap:
        case GeometryKind::kPolyline:
            break;
    }
    return SceneShapeKind::kMesh;
}

SceneShapeKind kind_of(ShapeKind kind) {
    switch (kind) {
        case ShapeKind::kPlane:
            return SceneShapeKind::kPlane;
        case ShapeKind::kSphere:
            return SceneShapeKind::kSphere;
        case ShapeKind::kBox:
            return SceneShapeKind::kBox;
        case ShapeKind::kCylinder:
            return SceneShapeKind::kCylinder;
        case ShapeKind::kCapsule:
            return SceneShapeKind::kCapsule;
        case ShapeKind::kEllipsoid:
            return SceneShapeKind::kEllipsoid;
        case ShapeKind::kHull:
        case ShapeKind::kSurface:
            break;
    }
    return SceneShapeKind::kMesh;
}

}  // namespace

std::size_t ShapeTable::keep(const void* source, SceneMesh mesh) {
    const std::size_t number = meshes_.size();
    if (source != nullptr) known_[source] = number;
    meshes_.push_back(std::move(mesh));
    return number;
}

std::optional<std::size_t> ShapeTable::texture_of(const std::shared_ptr<const PictureSpec>& picture) {
    if (!picture) return std::nullopt;
    const auto [entry, is_new] = known_textures_.try_emplace(picture.get(), textures_.size());
    if (!is_new) return entry->second;
    Hash hash;
    hash.add(std::string_view(reinterpret_cast<const char*>(picture->bytes.data()), picture->bytes.size()));
    const auto same = std::find_if(textures_.begin(), textures_.end(),
                                   [&](const SceneTexture& t) { return t.hash == hash.value(); });
    if (same != textures_.end()) return entry->second = static_cast<std::size_t>(same - textures_.begin());
    textures_.push_back({hash.value(), picture});
    return entry->second;
}

SceneFinish ShapeTable::finish_of(const FinishSpec& finish) {
    return {texture_of(finish.colour),
            texture_of(finish.normal),
            texture_of(finish.roughness_map),
            texture_of(finish.metalness_map),
            finish.roughness,
            finish.metalness,
            {}};
}

std::optional<SceneMesh> ShapeTable::mesh_of(const GeometrySpec& geometry) const {
    if (geometry.kind == GeometryKind::kMesh) {
        if (!geometry.mesh) return std::nullopt;
        return SceneMesh{geometry.mesh->vertices, geometry.mesh->triangles, geometry.mesh->uv};
    }
    if (geometry.kind == GeometryKind::kHeightmap) {
        if (!geometry.heights) return std::nullopt;
        const HeightGridSpec& grid = *geometry.heights;
        SceneMesh mesh = mesh_of_heights(grid.columns, grid.rows, grid.heights, {grid.size_x, grid.size_y, 0},
                                         grid.centre);
        const double size = geometry.texture_size;
        for (const Vec3& p : mesh.vertices) {
            const double x = p.x - grid.centre.x + 0.5 * grid.size_x;
            const double y = p.y - grid.centre.y + 0.5 * grid.size_y;
            mesh.uv.push_back({static_cast<float>(x / (size > 0 ? size : grid.size_x)),
                               static_cast<float>(y / (size > 0 ? size : grid.size_y))});
        }
        return mesh;
    }
    const auto pieces = convex_pieces(geometry.outline);
    if (!pieces) return std::nullopt;
    return mesh_of_prisms(pieces.value(), geometry.length);
}

std::optional<SceneShape> ShapeTable::shape_of(const GeometrySpec& geometry) {
    SceneShape shape;
    shape.kind = kind_of(geometry.kind);
    shape.size = geometry.size;
    shape.radius = geometry.radius;
    shape.length = geometry.length;
    if (shape.kind != SceneShapeKind::kMesh) return shape;
    const void* source = geometry.kind == GeometryKind::kMesh
                             ? static_cast<const void*>(geometry.mesh.get())
                             : static_cast<const void*>(geometry.heights.get());
    if (geometry.texture_size > 0) source = nullptr;  // its uv are its own
    if (const auto known = known_.find(source); source != nullptr && known != known_.end()) {
        shape.mesh = known->second;
        return shape;
    }
    std::optional<SceneMesh> mesh = mesh_of(geometry);
    if (!mesh) return std::nullopt;
    shape.mesh = keep(source, std::move(*mesh));
    return shape;
}

SceneShape ShapeTable::shape_of(const Shape& from) {
    constexpr double kPlaneExtent = 100;
    SceneShape shape;
    shape.kind = kind_of(from.kind);
    shape.size = from.kind == ShapeKind::kEllipsoid ? from.half : from.half * 2.0;
    if (from.kind == ShapeKind::kPlane) shape.size = {kPlaneExtent, kPlaneExtent, 0};
    shape.radius = from.radius;
    shape.length = 2.0 * from.half_length;
    if (shape.kind != SceneShapeKind::kMesh) return shape;
    const void* source = from.kind == ShapeKind::kHull ? static_cast<const void*>(from.hull)
                                                       : static_cast<const void*>(from.surface);
    const auto known = known_.find(source);
    shape.mesh = known != known_.end()           ? known->second
                 : from.kind == ShapeKind::kHull ? keep(source, mesh_of_hull(*from.hull))
                                                 : keep(source, mesh_of_surface(*from.surface));
    return shape;
}

}  // namespace roboss
