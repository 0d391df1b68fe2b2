// See onboard_kinds/ros_diff_drive.h.
#include <cmath>

#include "core/fixed_math.h"
#include "onboard/controllers.h"
#include "onboard/wheel_odometry.h"

namespace roboss {
namespace {

using Memory = RosDiffDriveMemory;

/// Size of the pair of wheels that counts for the odometry, and the joint of its right wheel.
struct FirstPair {
    double separation = 1, radius = 1;
    std::size_t right = 0;
};

void keep_odometry(const RosDrive& ros, const FirstPair& pair, OnboardContext& c) {
    const std::span<double> memory = c.memory();
    if (!ros.counts_wheels()) {
        set_true_odometry(memory.first<5>(), c.type(), c.state());
        return;
    }
    const double left = c.position(0), right = c.position(pair.right);
    if (memory[Memory::kStarted] != 0) {
        const double moved_left = pair.radius * (left - memory[Memory::kLeftAngle]);
        const double moved_right = pair.radius * (right - memory[Memory::kRightAngle]);
        move_odometry(memory.first<5>(),
                      {0.5 * (moved_left + moved_right), 0, (moved_right - moved_left) / pair.separation},
                      c.dt());
    }
    memory[Memory::kStarted] = 1, memory[Memory::kLeftAngle] = left, memory[Memory::kRightAngle] = right;
}

}  // namespace

void run(const RosDiffDriveSpec& spec, OnboardContext& c) {
    const std::size_t pairs = spec.left.size();
    keep_odometry(spec.ros, {spec.separation(0), 0.5 * spec.diameter(0), pairs}, c);
    const std::span<const double> twist = c.command(0);
    const std::span<double> rims = c.memory().subspan(Memory::kRims);
    const double step = spec.acceleration > 0 ? spec.acceleration * c.dt() : INFINITY;
    for (std::size_t pair = 0; pair < pairs; ++pair) {
        const double across = 0.5 * twist[Twist6::kAngularZ] * spec.separation(pair);
        for (const std::size_t side : {0u, 1u}) {
            double& rim = rims[2 * pair + side];
            const double wanted = twist[Twist6::kLinearX] + (side == 0 ? -across : across);
            rim = fixed_max(fixed_min(wanted, rim + step), rim - step);
            c.drive(pair + side * pairs, MotorMode::kVelocity, rim / (0.5 * spec.diameter(pair)),
                    spec.torque);
        }
    }
}

void run(const RosSkidSteerSpec& spec, OnboardContext& c) {
    const double radius = 0.5 * spec.diameter;
    keep_odometry(spec.ros, {spec.separation, radius, spec.left_front.size()}, c);
    const std::span<const double> twist = c.command(0);
    const double across = 0.5 * twist[Twist6::kAngularZ] * spec.separation;
    const double left = (twist[Twist6::kLinearX] - across) / radius,
                 right = (twist[Twist6::kLinearX] + across) / radius;
    std::size_t joint = 0;
    const auto drive = [&](std::size_t count, double speed) {
        for (std::size_t k = 0; k < count; ++k) c.drive(joint++, MotorMode::kVelocity, speed, spec.torque);
    };
    drive(spec.left_front.size(), left), drive(spec.right_front.size(), right);
    drive(spec.left_rear.size(), left), drive(spec.right_rear.size(), right);
}

}  // namespace roboss
