// Labelled things as a camera sees them: which pixels show which one, and the box around each in space.
#pragma once

#include <cstdint>
#include <vector>

#include "math/pose.h"
#include "sensors/placed_camera.h"

namespace roboss {

/// By pixel the number of the thing (CameraScene::things()) that it shows, or CameraScene::kNoThing.
std::vector<std::uint32_t> things_seen(const PlacedCamera& camera);

/// Corners of the boxes of a thing's visuals, in the world; eight of each visual.
std::vector<Vec3> corners_of(const CameraScene& scene, const CameraScene::Thing& thing);

/// A box around all visuals of a thing, along the axes of its model.
struct ThingBox {
    Pose X_CB;  // its middle in the camera's frame
    Vec3 size;  // m, its edges
};
ThingBox box_of(const PlacedCamera& camera, const CameraScene::Thing& thing, const SensorQuery& query);

}  // namespace roboss
