// What labelled things a camera sees at a tick: masks, boxes in the image and boxes in space.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "app/run/sensed_states.h"
#include "math/pose.h"
#include "sensor_kinds/camera_optics.h"

namespace roboss {

struct SeenThing {
    int label = 0;
    int of_label = 0;                   // which one of its label, from 1
    std::string name;                   // of the robot or static model
    std::array<int, 4> box{};           // pixels: left, top, width, height of the pixels that show it
    std::int64_t area = 0;              // pixels that show it
    std::vector<std::uint32_t> counts;  // run lengths down the columns, beginning with pixels outside of it
    double visible = 1;                 // share of the pixels within the image that would show it alone
    Pose X_CB;                          // its box in space; the camera looks along x, z is up
    Vec3 size;                          // m, edges of that box
};

/// All things with a pixel in the image of this camera, whatever its kind. Errors: as of cameras.
Result<std::vector<SeenThing>> seen_things(SensedStates& states, const CameraOptics& optics, RobotId robot,
                                           std::size_t sensor);

/// Share of a thing's image that is outside of the camera's image, 0 to 1.
double truncation(const SeenThing& thing, const CameraOptics& optics);

/// The optics of a camera of any kind; nullptr: it is none.
const CameraOptics* optics_of(const SensorSpec& sensor);

}  // namespace roboss
