// See onboard_kinds/wind_effects.h.
#include <algorithm>
#include <cmath>

#include "core/fixed_math.h"
#include "core/noise.h"
#include "onboard/controllers.h"

namespace roboss {
namespace {

constexpr double kDegree = kPi / 180;

double sine(double time, double period) {
    return fixed_sin(2 * kPi * (time / period - std::floor(time / period)));
}

}  // namespace

void run(const WindEffectsSpec& spec, OnboardContext& c) {
    constexpr std::uint64_t kSeed = 0x77696e64;  // one wind for all robots of all runs
    const NoiseStream stream{kSeed, 0, 0, c.tick()};
    const auto noise = [&](double mean, double deviation, std::uint64_t k) {
        return deviation > 0 ? mean + deviation * random_gaussian(stream, k) : mean;
    };
    Vec3 aim = wind_of(c.model(), c.type());
    if (c.is_commanded(0)) {
        const std::span<const double> given = c.command(0);
        aim = given[3] != 0 ? Vec3{given[0], given[1], given[2]} : Vec3{};
    }
    const double strength = std::sqrt(aim.x * aim.x + aim.y * aim.y);
    const double direction = fixed_atan2(aim.y, aim.x);
    const std::span<double> m = c.memory();
    if (m[WindEffectsSpec::kStarted] == 0)
        m[WindEffectsSpec::kStarted] = 1, m[WindEffectsSpec::kDirection] = direction;
    const auto approach = [&](int at, double goal, double rise) {
        double& x = m[static_cast<std::size_t>(at)];
        x += std::min(c.dt() / rise, 1.0) * (goal - x);
        return x;
    };
    const double t = c.time();
    const double magnitude = approach(WindEffectsSpec::kMagnitude, strength, spec.magnitude_rise) *
                                 (1 + spec.magnitude_amplitude * sine(t, spec.magnitude_period)) +
                             noise(spec.magnitude_noise_mean, spec.magnitude_noise_deviation, 0);
    const double turned = approach(WindEffectsSpec::kDirection, direction, spec.direction_rise) +
                          kDegree * (spec.direction_amplitude * sine(t, spec.direction_period) +
                                     noise(spec.direction_noise_mean, spec.direction_noise_deviation, 2));
    const SinCos to = fixed_sincos(turned);
    m[WindEffectsSpec::kWindX] = magnitude * to.cos;
    m[WindEffectsSpec::kWindY] = magnitude * to.sin;
    m[WindEffectsSpec::kWindZ] = approach(WindEffectsSpec::kVertical, aim.z, spec.vertical_rise) +
                                 noise(spec.vertical_noise_mean, spec.vertical_noise_deviation, 4);
}

}  // namespace roboss
