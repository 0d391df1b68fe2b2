#include "sensors/sensor_noise.h"

#include <cmath>

namespace roboss {
namespace {

NoiseStream stream_of(const SensorQuery& query, Tick tick) {
    return {query.seed, query.robot.value, static_cast<std::uint32_t>(query.sensor), tick};
}

}  // namespace

double sensor_bias(const NoiseSpec& noise, const SensorQuery& query, std::uint64_t channel) {
    double bias = noise.mean + noise.bias_mean;
    if (noise.bias_stddev != 0.0)
        bias += noise.bias_stddev * random_gaussian(stream_of(query, kOncePerRun), 2 * channel);
    return bias;
}

double noisy_value(double value, const NoiseSpec& noise, const SensorQuery& query, std::uint64_t channel,
                   std::uint64_t index) {
    double noisy = value + sensor_bias(noise, query, channel);
    if (noise.stddev != 0.0) noisy += noise.stddev * random_gaussian(stream_of(query, query.tick), index);
    return rounded_to(noisy, noise.precision);
}

double rounded_to(double value, double step) {
    return step > 0.0 ? std::floor(value / step + 0.5) * step : value;
}

}  // namespace roboss
