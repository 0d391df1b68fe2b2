// Readings of sensors as JSON, with the names that Python's read_all() gives them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/result.h"
#include "sensor_kinds/sensor_spec.h"

namespace roboss {

/// Fills the values of a reading of this sensor's kind: {"value": 512}. Vectors are [x, y, z], quaternions
/// "NAME_quat_xyzw": [x, y, z, w]; what is missing stays 0. Errors: a value of another type; an image.
Result<Sample> sample_of(const SensorSpec& spec, const nlohmann::json& values);

}  // namespace roboss
