// See sensor_noise.h. The wandering bias is an Ornstein-Uhlenbeck process: db = -b / T dt + sigma dW, b(0) =
// 0, with the stationary variance s^2 = sigma^2 T / 2. Its value at any tick is found without the ticks
// before, by bisection (P. Levy's construction of Brownian motion, for this process): it is drawn at the ends
// of long spans, which are independent of each other to double precision, and then at the middle of spans
// that get shorter, given their ends. Each draw belongs to its tick, so every question sees the same path.
#include "sensors/sensor_noise.h"

#include <cmath>

#include "core/fixed_math.h"

namespace roboss {
namespace {

NoiseStream stream_of(const SensorQuery& query, Tick tick) {
    return {query.seed, query.robot.value, static_cast<std::uint32_t>(query.sensor), tick};
}

/// Draws of the wandering bias are beyond those of all readings.
constexpr std::uint64_t kWandering = std::uint64_t{1} << 48;

/// The draw that belongs to a tick.
double draw_at(Tick tick, const SensorQuery& query, std::uint64_t channel) {
    return random_gaussian(stream_of(query, tick), kWandering + 2 * channel);
}

}  // namespace

double sensor_bias(const NoiseSpec& noise, const SensorQuery& query, std::uint64_t channel) {
    double bias = noise.mean + noise.bias_mean;
    if (noise.bias_stddev != 0.0)
        bias += noise.bias_stddev * random_gaussian(stream_of(query, kOncePerRun), 2 * channel);
    return bias;
}

double wandering_bias(const NoiseSpec& noise, const SensorQuery& query, std::uint64_t channel) {
    constexpr double kIndependent = 40;  // correlation times: exp(-40) is below half a unit of 1.0
    constexpr int kLevelsMost = 61;
    const double T = noise.dynamic_bias_correlation_time, dt = query.model.dt_s;
    if (!noise.drifts() || query.tick <= 0) return 0;
    const double s = noise.dynamic_bias_stddev * std::sqrt(0.5 * T);
    int level = 0;
    while (level < kLevelsMost && static_cast<double>(Tick{1} << level) * dt < kIndependent * T) ++level;
    Tick low = query.tick >> level << level, high = low + (Tick{1} << level);
    const auto end_of_span = [&](Tick tick) {
        if (tick == 0) return 0.0;
        const double r = fixed_exp(-static_cast<double>(Tick{1} << level) * dt / T);
        return s * std::sqrt(1.0 - r * r) * draw_at(tick, query, channel);
    };
    double at_low = end_of_span(low), at_high = low == query.tick ? 0.0 : end_of_span(high);
    while (low != query.tick) {
        // Given b at both ends of a span, the middle has the mean (low + high) r / (1 + r^2) and the variance
        // s^2 (1 - r^2) / (1 + r^2), where r is the correlation over half of the span. With x = half / T
        // small, 1 - r^2 loses digits, and the variance is s^2 tanh(x) = sigma^2 half / 2 to first order.
        const Tick middle = low + (high - low) / 2;
        const double x = static_cast<double>(middle - low) * dt / T, r = fixed_exp(-x), share = 1.0 + r * r;
        constexpr double kSmall = 1e-5;
        const double spread = x < kSmall ? x : (1.0 - r * r) / share;
        const double value =
            (at_low + at_high) * r / share + s * std::sqrt(spread) * draw_at(middle, query, channel);
        if (query.tick < middle)
            high = middle, at_high = value;
        else
            low = middle, at_low = value;
    }
    return at_low;
}

SensorNoise::SensorNoise(const NoiseSpec& noise, const SensorQuery& query, std::uint64_t channel)
    : bias_(sensor_bias(noise, query, channel)),
      stddev_(noise.stddev),
      precision_(noise.precision),
      draws_(stream_of(query, query.tick)) {
    if (noise.drifts()) bias_ += wandering_bias(noise, query, channel);
}

double SensorNoise::operator()(double value, std::uint64_t index) const {
    double noisy = value + bias_;
    if (stddev_ != 0.0) noisy += stddev_ * random_gaussian(draws_, index);
    return rounded_to(noisy, precision_);
}

double noisy_value(double value, const NoiseSpec& noise, const SensorQuery& query, std::uint64_t channel,
                   std::uint64_t index) {
    return SensorNoise(noise, query, channel)(value, index);
}

double rounded_to(double value, double step) {
    return step > 0.0 ? std::floor(value / step + 0.5) * step : value;
}

}  // namespace roboss
