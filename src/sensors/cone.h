// Rays that fill a cone: what sonars and infrared sensors hear or see.
#pragma once

#include <vector>

#include "math/vec3.h"
#include "sensors/sensor_query.h"

namespace roboss {

/// Unit vectors about -z up to `opening` rad off it, ring by ring, at most two degrees apart; the last ring
/// lies on the cone. An opening of 0: -z alone.
std::vector<Vec3> cone_about_minus_z(double opening);

/// Distance in m of the nearest surface that rays from the sensor's origin along these directions (unit
/// vectors in the sensor frame) meet within `range_max`, or +infinity. The link that carries the sensor is
/// not seen.
double nearest_in(const std::vector<Vec3>& directions_S, double range_max, const SensorQuery& query);

}  // namespace roboss
