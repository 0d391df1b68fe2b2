// Gaussian noise as in SDF: a bias drawn once for each sensor of a run, and a new draw for each reading, both
// pure functions of (seed, robot, sensor, tick).
#pragma once

#include <cstdint>

#include "core/noise.h"
#include "sensors/sensor_query.h"

namespace roboss {

/// mean + bias: what all readings of this sensor share. `channel` distinguishes a sensor's quantities (0 for
/// a laser's range).
double sensor_bias(const NoiseSpec& noise, const SensorQuery& query, std::uint64_t channel);

/// value + mean + bias + a draw of this tick, rounded to a multiple of `precision` where that is given (SDF's
/// gaussian_quantized). `index` distinguishes the draws of one reading.
double noisy_value(double value, const NoiseSpec& noise, const SensorQuery& query, std::uint64_t channel,
                   std::uint64_t index);

/// value rounded to a multiple of `step`; the value itself if step is 0.
double rounded_to(double value, double step);

}  // namespace roboss
