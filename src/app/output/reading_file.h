// One reading of a sensor as a file: PNG and NumPy arrays of images, point clouds (PCD) of depth images, CSV
// of everything else.
#pragma once

#include <string>

#include "core/result.h"
#include "sensor_kinds/sensor_spec.h"

namespace roboss {

/// By the ending of the file's name. PNG: colours, red first; depth in mm, 16 bits, 0 where there is none;
/// labels, 8 bits; temperatures in 0.01 K, 16 bits. NPY: the main value, with its shape; depth in m,
/// temperatures in K. PCD: points in the frame of the camera or laser (x ahead, y left, z up), m, with
/// colours of an RGB-D camera and intensities of a laser. CSV: a line for each number. Errors: another
/// ending, a reading that does not fit the format, a file that cannot be written.
Result<> write_reading(const std::string& file, Sample sample, const SensorSpec& sensor);

}  // namespace roboss
