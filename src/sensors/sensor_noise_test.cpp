// The bias that wanders against the closed forms of its process, and the Allan variances of noise.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sensors/sensor_noise.h"
#include "sensors/test_model.h"

namespace roboss {
namespace {

using namespace sensors_test;

constexpr double kDt = 1e-2;

/// Asks for the noise of robot 0 at any tick.
class Noise {
  public:
    explicit Noise(const NoiseSpec& spec) : spec_(spec), model_(model_of(cart_type(), 1)) {
        model_->dt_s = kDt;
        add_sensor(model_->types[0], 0, sensor("s", LaserSpec{}));
    }
    double bias(Tick tick, std::uint64_t seed, std::uint64_t channel = 0) {
        return wandering_bias(spec_, query(tick, seed), channel);
    }
    double value(Tick tick, std::uint64_t seed) { return noisy_value(0, spec_, query(tick, seed), 0, 0); }

  private:
    SensorQuery query(Tick tick, std::uint64_t seed) {
        return {*model_, RobotId(std::size_t{0}), 0, state_, tick, seed, sources_};
    }
    NoiseSpec spec_;
    std::shared_ptr<Model> model_;
    RobotState state_ = cart_at({});
    KnownStates sources_{model_, {&state_}};
};

NoiseSpec wandering(double sigma, double correlation_s) {
    NoiseSpec spec;
    spec.dynamic_bias_stddev = sigma, spec.dynamic_bias_correlation_time = correlation_s;
    return spec;
}

TEST(WanderingBias, BeginsAtZeroAndIsTheSamePathForEveryQuestion) {
    Noise noise(wandering(0.3, 2));
    EXPECT_EQ(noise.bias(0, 1), 0);
    std::vector<double> path;
    for (Tick t = 1; t <= 500; ++t) path.push_back(noise.bias(t, 1));
    for (Tick t = 500; t >= 1; t -= 7) EXPECT_EQ(noise.bias(t, 1), path[static_cast<std::size_t>(t - 1)]);
    EXPECT_NE(noise.bias(40, 1), noise.bias(40, 2)) << "another seed, another path";
    EXPECT_NE(noise.bias(40, 1), noise.bias(40, 1, 1)) << "each channel has its own";
}

/// From b(0) = 0: var b(t) = s^2 (1 - exp(-2 t / T)), cov(b(t), b(u)) = var b(t) exp(-(u - t) / T) for u > t.
TEST(WanderingBias, HasTheVarianceAndTheCorrelationOfItsProcess) {
    constexpr double kSigma = 0.3, kT = 2;
    const double s2 = 0.5 * kSigma * kSigma * kT;
    Noise noise(wandering(kSigma, kT));
    struct Pair {
        Tick t, u;
    };
    for (const Pair pair :
         {Pair{1, 2}, {10, 11}, {37, 164}, {255, 256}, {400, 700}, {8191, 8193}, {20000, 20100}}) {
        constexpr int kRuns = 20000;
        double tt = 0, tu = 0, mean = 0;
        for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
            const double bt = noise.bias(pair.t, seed), bu = noise.bias(pair.u, seed);
            mean += bt / kRuns, tt += bt * bt / kRuns, tu += bt * bu / kRuns;
        }
        const double t = static_cast<double>(pair.t) * kDt,
                     apart = static_cast<double>(pair.u - pair.t) * kDt;
        const double variance = s2 * (1 - std::exp(-2 * t / kT));
        // four standard errors: of the mean s / sqrt(n), of a product of two Gaussians at most sqrt(2 / n)
        EXPECT_NEAR(mean, 0, 4 * std::sqrt(variance / kRuns)) << pair.t;
        EXPECT_NEAR(tt, variance, 4 * variance * std::sqrt(2.0 / kRuns)) << pair.t;
        EXPECT_NEAR(tu, variance * std::exp(-apart / kT), 4 * variance * std::sqrt(2.0 / kRuns)) << pair.t;
    }
}

TEST(WanderingBias, WithALongCorrelationTimeItIsARandomWalk) {
    Noise noise(wandering(0.5, 1e9));
    for (const Tick t : {Tick{100}, Tick{5000}}) {
        constexpr int kRuns = 8000;
        double sum = 0;
        for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
            const double b = noise.bias(t, seed);
            sum += b * b / kRuns;
        }
        const double expected = 0.25 * static_cast<double>(t) * kDt;
        EXPECT_NEAR(sum, expected, 4 * expected * std::sqrt(2.0 / kRuns)) << t;
    }
}

/// sigma^2(tau) = mean of (mean over the second tau - mean over the first)^2 / 2.
double allan_variance(const std::vector<double>& samples, std::size_t length) {
    double sum = 0;
    std::size_t pairs = 0;
    const auto mean = [&](std::size_t first) {
        double total = 0;
        for (std::size_t i = first; i < first + length; ++i) total += samples[i];
        return total / static_cast<double>(length);
    };
    for (std::size_t first = 0; first + 2 * length <= samples.size(); first += length, ++pairs) {
        const double change = mean(first + length) - mean(first);
        sum += 0.5 * change * change;
    }
    return sum / static_cast<double>(pairs);
}

std::vector<double> samples_of(const NoiseSpec& spec, Tick count) {
    Noise noise(spec);
    std::vector<double> samples;
    for (Tick t = 1; t <= count; ++t) samples.push_back(noise.value(t, 5));
    return samples;
}

/// IEEE Std 952: white noise of density N has the Allan variance N^2 / tau, a rate random walk K^2 tau / 3.
TEST(Noise, TheAllanVarianceOfWhiteNoiseFallsWithTheTime) {
    NoiseSpec white;
    white.stddev = 0.2;
    const std::vector<double> samples = samples_of(white, 200000);
    const double N2 = 0.04 * kDt;
    for (const std::size_t length : {1u, 10u, 100u}) {
        const double tau = static_cast<double>(length) * kDt,
                     pairs = static_cast<double>(samples.size() / length);
        EXPECT_NEAR(allan_variance(samples, length) / (N2 / tau), 1, 4 * std::sqrt(3 / pairs)) << length;
    }
}

TEST(Noise, TheAllanVarianceOfAWanderingBiasGrowsWithTheTime) {
    constexpr double kSigma = 0.5;  // rate random walk K
    const std::vector<double> samples = samples_of(wandering(kSigma, 1e7), 200000);
    for (const std::size_t length : {20u, 100u, 400u}) {
        const double tau = static_cast<double>(length) * kDt,
                     pairs = static_cast<double>(samples.size() / length);
        EXPECT_NEAR(allan_variance(samples, length) / (kSigma * kSigma * tau / 3), 1,
                    4 * std::sqrt(4 / pairs))
            << length;
    }
}

}  // namespace
}  // namespace roboss
