// See onboard_kinds/mecanum_drive.h.
#include <array>

#include "onboard/controllers.h"
#include "onboard/speed_limiter.h"
#include "onboard/wheel_odometry.h"

namespace roboss {
namespace {

/// Of each corner: front left, front right, back left, back right.
using Corners = std::array<double, 4>;

std::array<std::size_t, 4> wheels_at(const MecanumDriveSpec& spec) {
    return {spec.front_left.size(), spec.front_right.size(), spec.back_left.size(), spec.back_right.size()};
}

/// Half the sum of wheel base and separation, m: a corner's share in the turn.
double lever(const MecanumDriveSpec& spec) {
    return 0.5 * (spec.wheel_separation + spec.wheelbase);
}

/// With rollers at 45 degrees, rim speeds (or ways) u give forward (a + b + c + d) / 4, left (-a + b + c - d)
/// / 4 and turn (-a + b - c + d) / (4 lever).
void count_wheels(const MecanumDriveSpec& spec, OnboardContext& c, std::span<double> memory) {
    Corners moved{};
    std::size_t joint = 0;
    const auto counts = wheels_at(spec);
    for (std::size_t corner = 0; corner < 4; ++corner) {
        const double angle = c.position(joint);
        moved[corner] = spec.wheel_radius * (angle - memory[MecanumDriveSpec::kAngles + corner]);
        memory[MecanumDriveSpec::kAngles + corner] = angle;
        joint += counts[corner];
    }
    const auto& [a, b, back_left, d] = moved;
    if (memory[MecanumDriveSpec::kStarted] != 0) {
        const double left = 0.25 * (-a + b + back_left - d);
        move_odometry(memory.first<5>(),
                      {0.25 * (a + b + back_left + d), left, 0.25 * (-a + b - back_left + d) / lever(spec)},
                      c.dt());
        memory[MecanumDriveSpec::kSideways] = left / c.dt();
    }
    memory[MecanumDriveSpec::kStarted] = 1;
}

}  // namespace

void run(const MecanumDriveSpec& spec, OnboardContext& c) {
    const std::span<double> memory = c.memory();
    count_wheels(spec, c, memory);
    const std::span<const double> twist = c.command(0);
    const auto limited = [&](const SpeedLimits& limits, double wanted, std::size_t at) {
        return limit_speed(limits, wanted, c.dt(), memory[at], memory[at + 1]);
    };
    const double x = limited(spec.linear, twist[Twist6::kLinearX], MecanumDriveSpec::kSpeed);
    const double y = limited(spec.linear, twist[Twist6::kLinearY], MecanumDriveSpec::kSideSpeed);
    const double turn =
        limited(spec.angular, twist[Twist6::kAngularZ], MecanumDriveSpec::kTurnRate) * lever(spec);
    const Corners rims{x - y - turn, x + y + turn, x + y - turn, x - y + turn};
    const auto counts = wheels_at(spec);
    std::size_t joint = 0;
    for (std::size_t corner = 0; corner < 4; ++corner)
        for (std::size_t k = 0; k < counts[corner]; ++k)
            c.drive(joint++, MotorMode::kVelocity, rims[corner] / spec.wheel_radius);
}

}  // namespace roboss
