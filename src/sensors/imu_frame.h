// The reference frame of an IMU's orientation (ImuSpec::localization).
#pragma once

#include "core/result.h"
#include "math/quat.h"
#include "sensors/sensor_query.h"

namespace roboss {

/// Its orientation in the world. An Error where the file's numbers give none: grav_dir_x along gravity, no
/// gravity, a link that is not there.
Result<Mat3> reference_frame_of(const ImuSpec& imu, const SensorQuery& query);

}  // namespace roboss
