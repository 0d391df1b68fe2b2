// See onboard_kinds/diff_drive.h.
#include "onboard/controllers.h"
#include "onboard/speed_limiter.h"
#include "onboard/wheel_odometry.h"

namespace roboss {
namespace {

/// Odometry up to now, from the first wheel of each side.
void count_wheels(const DiffDriveSpec& spec, OnboardContext& c, std::span<double> memory) {
    const double left = c.position(0), right = c.position(spec.left.size());
    if (memory[DiffDriveSpec::kStarted] != 0) {
        const double moved_left = spec.wheel_radius * (left - memory[DiffDriveSpec::kLeftAngle]);
        const double moved_right = spec.wheel_radius * (right - memory[DiffDriveSpec::kRightAngle]);
        move_odometry(
            memory.first<5>(),
            {0.5 * (moved_left + moved_right), 0, (moved_right - moved_left) / spec.wheel_separation},
            c.dt());
    }
    memory[DiffDriveSpec::kStarted] = 1, memory[DiffDriveSpec::kLeftAngle] = left,
    memory[DiffDriveSpec::kRightAngle] = right;
}

}  // namespace

void run(const DiffDriveSpec& spec, OnboardContext& c) {
    const std::span<double> memory = c.memory();
    count_wheels(spec, c, memory);
    const bool is_enabled = !c.is_commanded(1) || c.command(1)[0] != 0;
    const auto commanded = static_cast<double>(c.commanded_at(0));
    if (!is_enabled) memory[DiffDriveSpec::kIgnoredUntil] = commanded;
    double speed = 0, turn = 0;
    if (commanded > memory[DiffDriveSpec::kIgnoredUntil]) {
        const std::span<const double> twist = c.command(0);
        speed = twist[Twist6::kLinearX], turn = twist[Twist6::kAngularZ];
    }
    speed = limit_speed(spec.linear, speed, c.dt(), memory[DiffDriveSpec::kSpeed],
                        memory[DiffDriveSpec::kSpeed + 1]);
    turn = limit_speed(spec.angular, turn, c.dt(), memory[DiffDriveSpec::kTurnRate],
                       memory[DiffDriveSpec::kTurnRate + 1]);
    const double across = 0.5 * turn * spec.wheel_separation;
    const double left = (speed - across) / spec.wheel_radius, right = (speed + across) / spec.wheel_radius;
    const std::size_t lefts = spec.left.size(), count = c.joint_count();
    for (std::size_t joint = 0; joint < count; ++joint)
        c.drive(joint, MotorMode::kVelocity, joint < lefts ? left : right);
}

}  // namespace roboss
