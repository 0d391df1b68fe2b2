// What a camera sees, as a picture for pages: colours as JPEG; depths, temperatures and labels as numbers in
// a PNG, so that a page chooses their colours and can say the value under the pointer
// (docs/viewer-protocol.md).
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "core/result.h"
#include "sensors/sensor_query.h"

namespace roboss {

/// Which picture a page wants.
struct PictureWish {
    RobotId robot;
    std::uint32_t sensor = 0;
    bool depth = false;         // of an RGB-D camera its depths, else its colours
    std::uint32_t columns = 0;  // at most; 0: those of the camera
    auto key() const { return std::tuple(robot, sensor, depth); }
    friend bool operator==(const PictureWish&, const PictureWish&) = default;
};

struct CameraPicture {
    std::string about;                // JSON
    std::vector<std::uint8_t> bytes;  // JPEG or PNG
};

/// Whether the Model has this camera.
bool has_camera(const Model& model, const PictureWish& wish);

/// The query names the robot and the sensor of the wish. A picture with fewer columns than the camera has is
/// rendered at that size. Errors: those of measure(); "no-camera"; "not-packed".
Result<CameraPicture> take_picture(const PictureWish& wish, const SensorQuery& query);

}  // namespace roboss
