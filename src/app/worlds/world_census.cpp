// Each prototype is counted once and multiplied by its instances.
#include "app/worlds/world_census.h"

#include <algorithm>

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
    }
    return "?";
}

namespace {

bool is_message_board(const ModelSpec& model) {
    return std::ranges::any_of(model.onboard, [](const OnboardSpec& onboard) {
        return std::holds_alternative<MessageBoardSpec>(onboard.parameters);
    });
}

}  // namespace

WorldCensus take_census(const World& world) {
    std::vector<std::size_t> times(world.prototypes.size(), 0);
    for (const ModelInstance& instance : world.instances) ++times[instance.prototype];
    WorldCensus census;
    for (std::size_t i = 0; i < times.size(); ++i) {
        const ModelSpec& model = world.prototypes[i];
        if (is_message_board(model)) continue;  // the importer's, not the file's
        for (const LinkSpec& link : model.links) {
            for (const CollisionSpec& collision : link.collisions)
                census.shapes[to_text(collision.geometry.kind)] += times[i];
            for (const SensorSpec& sensor : link.sensors)
                if (!sensor.measures() && times[i] > 0) census.silent[sensor.sdf_type] += times[i];
        }
        if (model.is_static) {
            census.static_models += times[i];
            continue;
        }
        census.robots += times[i];
        census.robot_types += times[i] > 0 ? 1 : 0;
        census.links += model.links.size() * times[i];
        for (const JointSpec& joint : model.joints)
            census.joints[std::string(joint_type(joint.kind).name)] += times[i];
        for (const LinkSpec& link : model.links) {
            for (const SensorSpec& sensor : link.sensors) census.sensors[sensor.kind().name] += times[i];
        }
    }
    return census;
}

}  // namespace roboss
