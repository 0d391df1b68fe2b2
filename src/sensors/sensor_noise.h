// Noise as in SDF: a bias drawn once for each sensor of a run, a bias that wanders, and a new draw for each
// reading, all pure functions of (seed, robot, sensor, tick).
#pragma once

#include <cstdint>

#include "core/noise.h"
#include "sensors/sensor_query.h"

namespace roboss {

/// mean + bias: what all readings of this sensor share. `channel` distinguishes a sensor's quantities (0 for
/// a laser's range).
double sensor_bias(const NoiseSpec& noise, const SensorQuery& query, std::uint64_t channel);

/// The bias that wanders (NoiseSpec::dynamic_bias_stddev) at the tick of the query: 0 at tick 0. The same
/// path in every run of this seed, whatever ticks are asked.
double wandering_bias(const NoiseSpec& noise, const SensorQuery& query, std::uint64_t channel);

/// The noise of one quantity in one reading; biases are found once.
class SensorNoise {
  public:
    /// `channel`: see sensor_bias().
    SensorNoise(const NoiseSpec& noise, const SensorQuery& query, std::uint64_t channel);
    /// value + mean + biases + a draw of this tick, rounded to a multiple of `precision` where that is given
    /// (SDF's gaussian_quantized). `index` distinguishes the draws of one reading.
    double operator()(double value, std::uint64_t index) const;

  private:
    double bias_ = 0, stddev_ = 0, precision_ = 0;
    NoiseStream draws_;
};

/// SensorNoise for a single value.
double noisy_value(double value, const NoiseSpec& noise, const SensorQuery& query, std::uint64_t channel,
                   std::uint64_t index);

/// value rounded to a multiple of `step`; the value itself if step is 0.
double rounded_to(double value, double step);

}  // namespace roboss
