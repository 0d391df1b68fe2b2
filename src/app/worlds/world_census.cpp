// Each prototype is counted once and multiplied by its instances.
#include "app/worlds/world_census.h"

namespace roboss {

const char* to_text(JointSpecKind kind) {
    switch (kind) {
        case JointSpecKind::kFixed:
            return "fixed";
        case JointSpecKind::kRevolute:
            return "revolute";
        case JointSpecKind::kContinuous:
            return "continuous";
        case JointSpecKind::kPrismatic:
            return "prismatic";
        case JointSpecKind::kBall:
            return "ball";
        case JointSpecKind::kScrew:
            return "screw";
        case JointSpecKind::kUniversal:
            return "universal";
        case JointSpecKind::kRevolute2:
            return "revolute2";
        case JointSpecKind::kGearbox:
            return "gearbox";
    }
    return "?";
}

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

WorldCensus take_census(const World& world) {
    std::vector<std::size_t> times(world.prototypes.size(), 0);
    for (const ModelInstance& instance : world.instances) ++times[instance.prototype];
    WorldCensus census;
    for (std::size_t i = 0; i < times.size(); ++i) {
        const ModelSpec& model = world.prototypes[i];
        for (const LinkSpec& link : model.links) {
            for (const CollisionSpec& collision : link.collisions)
                census.shapes[to_text(collision.geometry.kind)] += times[i];
        }
        if (model.is_static) {
            census.static_models += times[i];
            continue;
        }
        census.robots += times[i];
        census.robot_types += times[i] > 0 ? 1 : 0;
        census.links += model.links.size() * times[i];
        for (const JointSpec& joint : model.joints) census.joints[to_text(joint.kind)] += times[i];
        for (const LinkSpec& link : model.links) {
            for (const SensorSpec& sensor : link.sensors) census.sensors[sensor.kind().name] += times[i];
        }
    }
    return census;
}

}  // namespace roboss
