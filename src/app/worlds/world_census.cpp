// Each prototype is counted once and multiplied by its instances.
#include "app/worlds/world_census.h"

#include <algorithm>
#include <vector>

#include "model/topics.h"
#include "world/joint_type.h"

namespace roboss {

const char* to_text(GeometryKind kind) {
    switch (kind) {
        case GeometryKind::kPlane:
            return "plane";
        case GeometryKind::kBox:
            return "box";
        case GeometryKind::kSphere:
            return "sphere";
        case GeometryKind::kCylinder:
            return "cylinder";
        case GeometryKind::kCapsule:
            return "capsule";
        case GeometryKind::kEllipsoid:
            return "ellipsoid";
        case GeometryKind::kMesh:
            return "mesh";
        case GeometryKind::kHeightmap:
            return "heightmap";
        case GeometryKind::kPolyline:
            return "polyline";
        case GeometryKind::kCone:
            return "cone";
    }
    return "?";
}

namespace {

bool is_message_board(const ModelSpec& model) {
    return std::ranges::any_of(model.onboard, [](const OnboardSpec& onboard) {
        return std::holds_alternative<MessageBoardSpec>(onboard.parameters);
    });
}

/// Of the file; `times`: by prototype.
void count_models(const World& world, const std::vector<std::size_t>& times, WorldCensus& census) {
    for (std::size_t i = 0; i < times.size(); ++i) {
        const ModelSpec& model = world.prototypes[i];
        if (model.is_static || is_message_board(model)) continue;
        census.robots += times[i];
        census.robot_types += times[i] > 0 ? 1 : 0;
        census.links += model.links.size() * times[i];
        for (const JointSpec& joint : model.joints)
            census.joints[std::string(joint_type(joint.kind).name)] += times[i];
    }
}

void count_robots_of(const Model& model, WorldCensus& census) {
    std::vector<std::size_t> times(model.types.size(), 0);
    for (std::size_t r = 0; r < model.robots.size(); ++r) ++times[model.like(RobotId(r)).index()];
    for (std::size_t t = 0; t < times.size(); ++t) {
        const RobotType& type = model.types[t];
        if (times[t] == 0 || board_of(type) != nullptr) continue;
        census.robots += times[t];
        ++census.robot_types;
        census.links += type.links.size() * times[t];
        for (const Joint& joint : type.joints)
            census.joints[std::string(joint_type(joint.kind).name)] += times[t];
    }
}

}  // namespace

std::size_t count_robots(const Model& model) {
    return static_cast<std::size_t>(std::ranges::count_if(
        model.robots, [&](const Robot& r) { return board_of(model.types[r.type.index()]) == nullptr; }));
}

WorldCensus take_census(const World& world, const Model* model) {
    std::vector<std::size_t> times(world.prototypes.size(), 0);
    for (const ModelInstance& instance : world.instances) ++times[instance.prototype];
    WorldCensus census;
    for (std::size_t i = 0; i < times.size(); ++i) {
        const ModelSpec& spec = world.prototypes[i];
        if (is_message_board(spec) || times[i] == 0) continue;  // a board is the importer's, not the file's
        if (spec.is_static) census.static_models += times[i];
        for (const LinkSpec& link : spec.links) {
            for (const CollisionSpec& collision : link.collisions)
                census.shapes[to_text(collision.geometry.kind)] += times[i];
            for (const SensorSpec& sensor : link.sensors) {
                auto& counted = sensor.measures() ? census.sensors : census.silent;
                counted[sensor.measures() ? sensor.kind().name : sensor.sdf_type] += times[i];
            }
        }
    }
    if (model != nullptr)
        count_robots_of(*model, census);
    else
        count_models(world, times, census);
    return census;
}

}  // namespace roboss
