// What a world looks like, as plain data for a viewer: shapes with colours on the links of robots and in the
// world. The Model knows how bodies move but nothing of visuals; the World has the visuals, by the names of
// models and links. Where there is no World (a journal that is replayed), or a robot has no visuals in it,
// collision shapes stand in.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/model.h"
#include "world/world.h"

namespace roboss {

enum class SceneShapeKind { kPlane, kBox, kSphere, kCylinder, kCapsule, kEllipsoid, kMesh, kCone };

/// What lies over a colour: places in Scene::textures, and numbers from 0 to 1; none: the viewer's own.
struct SceneFinish {
    std::optional<std::size_t> colour, normal, roughness_map, metalness_map;
    std::optional<double> roughness, metalness;
    std::optional<Vec3> emissive;
};

struct SceneShape {
    std::string name;
    SceneShapeKind kind = SceneShapeKind::kBox;
    Vec3 size{1, 1, 1};  // box: edges; ellipsoid: radii; plane: extent in x and y, to be drawn
    double radius = 0, length = 0;
    std::size_t mesh = 0;  // in Scene::meshes
    Pose frame;            // in the link, or in the world
    Vec3 rgb{0.7, 0.7, 0.7};
    double alpha = 1;
    bool casts = true;   // shadows
    bool still = false;  // of a collision shape: it takes no part in the surface motion of its link
    SceneFinish finish;
    int label = 0;                                // VisualSpec::label
    bool labels_model = false;                    // VisualSpec::labels_model
    std::optional<double> temperature;            // K
    std::uint32_t visibility_flags = 0xFFFFFFFF;  // VisualSpec::visibility_flags
};

struct SceneMesh {
    std::vector<Vec3> vertices;  // m
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::array<float, 2>> uv{};  // by vertex, or none
};

/// A picture, once for all files with the same content.
struct SceneTexture {
    std::uint64_t hash = 0;  // of its bytes
    std::shared_ptr<const PictureSpec> picture;
};

struct SceneLink {
    std::vector<SceneShape> visuals, collisions;
    std::vector<LightSpec> lights;
};

/// Robots that move alike and look alike.
struct SceneType {
    TypeId type;
    std::vector<SceneLink> links;  // by LinkId of the RobotType
};

/// A shape of the scenery whose surface moves, or may: drawn over the scenery, as what moves.
struct SceneFlow {
    SceneShape shape;
    SurfaceFlow motion;  // always, if `robot` is not valid
    RobotId robot;       // else it moves as the state of this robot says of `link`
    LinkId link;
};

struct Scene {
    std::vector<SceneType> types;
    std::vector<std::size_t> robots;  // by RobotId: place in `types`
    std::vector<SceneShape> statics;
    std::vector<SceneFlow> flows;
    WorldLook look;  // lights: those of scenery, too
    std::vector<SceneMesh> meshes;
    std::vector<SceneTexture> textures;
};

/// The worlds need not be the very ones that the Model was compiled from: robots are found in them by name,
/// in the last first. None: only collision shapes are drawn.
Scene make_scene(const Model& model, std::span<const World* const> worlds);
/// nullptr: none.
Scene make_scene(const Model& model, const World* world);

}  // namespace roboss
