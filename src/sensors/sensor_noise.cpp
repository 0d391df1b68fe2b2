#include "sensors/sensor_noise.h"

#include <cmath>

namespace roboss {
namespace {

NoiseStream stream_of(const SensorMoment& moment, Tick tick) {
    return {moment.seed, moment.robot.value, static_cast<std::uint32_t>(moment.sensor), tick};
}

}  // namespace

double sensor_bias(const NoiseSpec& noise, const SensorMoment& moment, std::uint64_t channel) {
    double bias = noise.mean + noise.bias_mean;
    if (noise.bias_stddev != 0.0)
        bias += noise.bias_stddev * random_gaussian(stream_of(moment, kOncePerRun), 2 * channel);
    return bias;
}

double noisy_value(double value, const NoiseSpec& noise, const SensorMoment& moment, std::uint64_t channel,
                   std::uint64_t index) {
    double noisy = value + sensor_bias(noise, moment, channel);
    if (noise.stddev != 0.0) noisy += noise.stddev * random_gaussian(stream_of(moment, moment.tick), index);
    return rounded_to(noisy, noise.precision);
}

double rounded_to(double value, double step) {
    return step > 0.0 ? std::floor(value / step + 0.5) * step : value;
}

}  // namespace roboss
