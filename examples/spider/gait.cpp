#include "gait.h"

#include <algorithm>
#include <cmath>

#include <roboss/core/fixed_math.h>

namespace spider {
namespace {

using roboss::fixed_acos;
using roboss::fixed_atan2;
using roboss::fixed_cos;
using roboss::fixed_sin;

constexpr double kStartCycles = 2;
constexpr double kSpare = 1e-3;  // m, short of a stretched leg

/// How far along its stride the foot is, from 0.5 (ahead) to -0.5, and how high, 0 to 1.
struct Step {
    double ahead = 0, up = 0;
};

/// On the ground the foot moves evenly backwards. In the air it follows a cubic whose slopes at both ends are
/// `slope`: 1 makes a straight line, -(1 - duty) / duty the speed of the ground. Its height is a quartic that
/// begins and ends with slope 0.
Step step_at(const Gait& gait, double phase) {
    if (phase < gait.duty) return {0.5 - phase / gait.duty, 0};
    const double u = (phase - gait.duty) / (1 - gait.duty);
    const double slope = 1 - gait.ease / gait.duty;
    const double hump = u * (1 - u);
    return {-0.5 + u * u * (3 - 2 * u) + slope * u * (1 - u) * (1 - 2 * u), 16 * hump * hump};
}

}  // namespace

Point foot(const Gait& gait, std::size_t leg, double phase, double amount, double turn) {
    const Hip& hip = kHips[leg];
    const double splay = gait.splay - kSplay, side = hip.y > 0 ? 1 : -1;
    // Splayed front legs point further ahead, rear legs further back.
    const double azimuth = hip.azimuth + (hip.x > 0 ? -side * splay : hip.x < 0 ? side * splay : 0.0);
    const double x = hip.x + gait.reach * fixed_cos(azimuth) + gait.shift;
    const double y = hip.y + gait.reach * fixed_sin(azimuth);
    const Step step = step_at(gait, phase);
    // While the trunk turns to the left, a standing foot turns to the right about the trunk's middle.
    const double angle = amount * turn * step.ahead, c = fixed_cos(angle), s = fixed_sin(angle);
    return {c * x - s * y + amount * gait.stride * step.ahead, s * x + c * y,
            kFootRadius - gait.height + amount * gait.lift * step.up};
}

// The leg lies in a vertical plane through the axis of the coxa. In it the femur and the tibia (lengths a, b)
// are two sides of a triangle whose third side d goes from the femur's joint to the foot; its angles follow
// from the law of cosines. The knee is above.
std::array<double, kLegJoints> leg_angles(std::size_t leg, const Point& foot) {
    const Hip& hip = kHips[leg];
    const auto& [coxa, a, b] = kPartLengths;
    const double dx = foot.x - hip.x, dy = foot.y - hip.y;
    const double turn = roboss::wrap_angle(fixed_atan2(dy, dx) - hip.azimuth);
    const double out = std::sqrt(dx * dx + dy * dy) - coxa;
    const double d = std::clamp(std::sqrt(out * out + foot.z * foot.z), b - a + kSpare, a + b - kSpare);
    const double knee = fixed_acos((d * d - a * a - b * b) / (2 * a * b));
    const double up = fixed_atan2(foot.z, out) + fixed_acos((a * a + d * d - b * b) / (2 * a * d));
    std::array<double, kLegJoints> angles{turn, up - kFemurUp, kFemurUp - kTibiaUp - knee};
    for (std::size_t i = 0; i < kLegJoints; ++i)
        angles[i] = std::clamp(angles[i], kJointLimits[i][0], kJointLimits[i][1]);
    return angles;
}

Point foot_of_angles(std::size_t leg, const std::array<double, kLegJoints>& angles) {
    const Hip& hip = kHips[leg];
    const double azimuth = hip.azimuth + angles[0], femur = kFemurUp + angles[1];
    const double tibia = kTibiaUp + angles[1] + angles[2];
    const double out =
        kPartLengths[0] + kPartLengths[1] * fixed_cos(femur) + kPartLengths[2] * fixed_cos(tibia);
    return {hip.x + out * fixed_cos(azimuth), hip.y + out * fixed_sin(azimuth),
            kPartLengths[1] * fixed_sin(femur) + kPartLengths[2] * fixed_sin(tibia)};
}

std::array<double, kJoints> targets(const Gait& gait, double time_s, double turn) {
    const double cycles = std::max(0.0, (time_s + gait.lead_s) / gait.period_s);
    const double amount = std::min(1.0, cycles / kStartCycles);
    std::array<double, kJoints> all{};
    for (std::size_t leg = 0; leg < kLegs; ++leg) {
        const double turns = cycles + gait.phases[leg];
        const auto angles = leg_angles(leg, foot(gait, leg, turns - std::floor(turns), amount, turn));
        std::copy(angles.begin(), angles.end(), all.begin() + static_cast<std::ptrdiff_t>(kLegJoints * leg));
    }
    return all;
}

}  // namespace spider
