// Where the beams of a laser point.
#pragma once

#include <vector>

#include "math/vec3.h"
#include "sensor_kinds/laser.h"

namespace roboss {

/// Unit vectors in the sensor frame, in the order of LaserReading::ranges.
std::vector<Vec3> laser_beams(const LaserSpec& laser);

}  // namespace roboss
