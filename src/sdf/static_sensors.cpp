// Welds every link of a static model with sensors to the world.
#include "sdf/static_sensors.h"

#include <algorithm>

namespace roboss::sdf_import {
namespace {

bool measures(const SensorSpec& sensor) {
    return sensor.kind != SensorKind::kUnsupported;
}

/// A plane reaches everywhere; a robot that does would interact with all others.
bool is_bounded(const CollisionSpec& collision) {
    return collision.geometry.kind != GeometryKind::kPlane &&
           collision.geometry.kind != GeometryKind::kHeightmap;
}

}  // namespace

void keep_sensors_of_static(ModelSpec& model, Diagnostics& diagnostics) {
    const auto has_sensor = [](const LinkSpec& link) {
        return std::any_of(link.sensors.begin(), link.sensors.end(), measures);
    };
    if (!model.is_static || std::none_of(model.links.begin(), model.links.end(), has_sensor)) return;
    const bool bounded = std::all_of(model.links.begin(), model.links.end(), [](const LinkSpec& link) {
        return std::all_of(link.collisions.begin(), link.collisions.end(), is_bounded);
    });
    if (!bounded) {
        diagnostics.warning(
            model.where, "static-sensor",
            "the static model '" + model.name + "' has a plane and sensors; its sensors cannot be read",
            "Put the sensors into a model of their own.");
        return;
    }
    diagnostics.note(
        model.where, "static-sensor",
        "the static model '" + model.name + "' has sensors; it becomes a robot that is welded to the world");
    model.is_static = false;
    model.joints.clear();
    for (const LinkSpec& link : model.links) {
        JointSpec weld;
        weld.name = link.name + "::weld_to_world";
        weld.parent = "world";
        weld.child = link.name;
        weld.X_MJ = link.X_ML;
        weld.where = link.where;
        model.joints.push_back(std::move(weld));
    }
}

}  // namespace roboss::sdf_import
