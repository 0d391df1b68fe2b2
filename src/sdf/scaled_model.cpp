// See scaled_model.h.
#include "sdf/scaled_model.h"

#include <algorithm>
#include <memory>

namespace roboss::sdf_import {
namespace {

Vec3 times(const Vec3& a, const Vec3& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

void scale_geometry(const Vec3& scale, GeometrySpec& geometry) {
    const double across = std::max(scale.x, scale.y);
    geometry.size = times(geometry.size, scale);
    geometry.radius *= geometry.kind == GeometryKind::kSphere ? std::max(across, scale.z) : across;
    geometry.length *= scale.z;
    for (Vec3& corner : geometry.outline) corner = times(corner, scale);
    geometry.scale = times(geometry.scale, scale);
    if (geometry.kind != GeometryKind::kMesh || geometry.mesh == nullptr) return;
    auto mesh = std::make_shared<MeshSpec>(*geometry.mesh);
    for (Vec3& vertex : mesh->vertices) vertex = times(vertex, scale);
    geometry.mesh = std::move(mesh);
}

/// The factors of a link; nullptr: it has none.
const Vec3* scale_of(const ModelScale& scale, const std::string& link) {
    const std::pair<std::string, Vec3>* best = nullptr;
    for (const auto& entry : scale)
        if (link.starts_with(entry.first) && (best == nullptr || entry.first.size() >= best->first.size()))
            best = &entry;
    return best == nullptr ? nullptr : &best->second;
}

}  // namespace

void scale_shapes(const ModelScale& scale, ModelSpec& model) {
    for (LinkSpec& link : model.links) {
        const Vec3* const factors = scale_of(scale, link.name);
        if (factors == nullptr) continue;
        for (CollisionSpec& collision : link.collisions) scale_geometry(*factors, collision.geometry);
        for (VisualSpec& visual : link.visuals) scale_geometry(*factors, visual.geometry);
    }
}

}  // namespace roboss::sdf_import
