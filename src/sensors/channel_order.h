// Image formats of cameras that put blue first (B8G8R8), for files and screens that want red first.
#pragma once

#include "sensor_kinds/sensor_spec.h"

namespace roboss {

/// Reorders the channels of an image of `sensor` to red, green, blue.
void put_red_first(const SensorSpec& sensor, Image<std::uint8_t>& image);
/// Likewise the colours of a reading; other readings stay as they are.
void put_red_first(const SensorSpec& sensor, Sample& reading);

}  // namespace roboss
