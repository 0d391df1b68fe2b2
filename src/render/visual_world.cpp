// See visual_world.h.
#include "render/visual_world.h"

#include <algorithm>

namespace roboss::render {
namespace {

Vec3 squared(const Vec3& c) {
    const auto clamp = [](double x) { return std::clamp(x, 0.0, 1.0); };
    return {clamp(c.x) * clamp(c.x), clamp(c.y) * clamp(c.y), clamp(c.z) * clamp(c.z)};
}

void set_size(TraceItem& item, const SceneShape& from) {
    const auto set = [&](double a, double b, double c) {
        item.size[0] = a, item.size[1] = b, item.size[2] = c;
    };
    switch (from.kind) {
        case SceneShapeKind::kPlane:
            return set(0.5 * from.size.x, 0.5 * from.size.y, 0);
        case SceneShapeKind::kBox:
            return set(0.5 * from.size.x, 0.5 * from.size.y, 0.5 * from.size.z);
        case SceneShapeKind::kSphere:
            return set(from.radius, from.radius, from.radius);
        case SceneShapeKind::kEllipsoid:
            return set(from.size.x, from.size.y, from.size.z);
        case SceneShapeKind::kCylinder:
        case SceneShapeKind::kCapsule:
        case SceneShapeKind::kCone:
            return set(from.radius, 0.5 * from.length, 0);
        case SceneShapeKind::kMesh:
            return;
    }
}

}  // namespace

Aabb box_of(const TraceItem& item, const std::vector<std::unique_ptr<const VisualMesh>>& meshes) {
    Vec3 half{item.size[0], item.size[1], item.size[2]};
    switch (item.kind) {
        case TraceKind::kCylinder:
        case TraceKind::kCone:
            half = {item.size[0], item.size[0], item.size[1]};
            break;
        case TraceKind::kCapsule:
            half = {item.size[0], item.size[0], item.size[0] + item.size[1]};
            break;
        case TraceKind::kMesh:
            return meshes[item.mesh]->box();
        case TraceKind::kPlane:
        case TraceKind::kBox:
        case TraceKind::kSphere:
        case TraceKind::kEllipsoid:
            break;
    }
    return {-half, half};
}

VisualShape VisualWorld::shape_of(const SceneShape& from) const {
    constexpr double kCastsFrom = 0.5;  // opacity
    VisualShape shape;
    shape.item.kind = static_cast<TraceKind>(from.kind);
    set_size(shape.item, from);
    shape.item.mesh = static_cast<std::uint32_t>(from.mesh);
    shape.item.flags = from.visibility_flags;
    shape.item.casts = from.casts && from.alpha >= kCastsFrom;
    shape.X_FS = to_transform(from.frame);
    Material& to = shape.material;
    to.rgb = squared(from.rgb);
    if (from.finish.emissive) to.emissive = squared(*from.finish.emissive);
    to.alpha = std::clamp(from.alpha, 0.0, 1.0);
    to.roughness = std::clamp(from.finish.roughness.value_or(to.roughness), 0.05, 1.0);
    to.metalness = std::clamp(from.finish.metalness.value_or(0), 0.0, 1.0);
    if (from.finish.colour) to.picture = pictures[*from.finish.colour].get();
    shape.label = from.label, shape.labels_model = from.labels_model;
    shape.model = from.name.substr(0, from.name.find("::"));
    shape.temperature = from.temperature.value_or(-1);
    return shape;
}

VisualWorld::VisualWorld(const Scene& from, const Model& model, const DecodePicture& decode)
    : model_hash(model.hash),
      look_of(from.robots),
      scene(from.look.scene.value_or(SceneSpec{})),
      has_scene(from.look.scene.has_value()) {
    for (const SceneMesh& mesh : from.meshes) meshes.push_back(std::make_unique<const VisualMesh>(mesh));
    for (const auto& mesh : meshes) trace_meshes.push_back(mesh->trace());
    for (const SceneTexture& texture : from.textures) {
        Result<Picture> picture = decode(*texture.picture);
        if (!picture) problems.push_back(texture.picture->source + ": " + picture.error().message);
        pictures.push_back(picture ? std::make_unique<const Picture>(std::move(picture).value()) : nullptr);
    }
    const auto add_shapes = [&](const std::vector<SceneShape>& shapes, VisualLink& link) {
        for (const SceneShape& shape : shapes) {
            const bool empty = shape.kind == SceneShapeKind::kMesh && meshes[shape.mesh]->box().empty();
            if (shape.alpha > 0 && !empty) link.shapes.push_back(shape_of(shape));
        }
    };
    for (const SceneType& type : from.types) {
        std::vector<VisualLink>& links = looks.emplace_back(type.links.size());
        for (std::size_t l = 0; l < links.size(); ++l) {
            add_shapes(type.links[l].visuals, links[l]);
            for (const LightSpec& light : type.links[l].lights)
                links[l].lights.push_back({light, light.X_FL});
        }
    }
    add_shapes(from.statics, scenery);
    for (const LightSpec& light : from.look.lights) scenery.lights.push_back({light, light.X_FL});
}

}  // namespace roboss::render
