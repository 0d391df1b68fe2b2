// Names in ROS 2 that a file gives to a sensor.
#pragma once

#include "sdf/conversion.h"

namespace roboss::sdf_import {

/// Reads SensorSpec::ros_topic and ros_frame; `spec.topic` is read already.
void read_ros_names(const Element& sensor, SensorSpec& spec);

}  // namespace roboss::sdf_import
