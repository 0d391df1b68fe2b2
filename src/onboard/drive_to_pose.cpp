// See onboard_kinds/drive_to_pose.h.
#include <cmath>

#include "core/fixed_math.h"
#include "onboard/controllers.h"
#include "onboard/wheel_odometry.h"

namespace roboss {

void run(const DriveToPoseSpec& spec, OnboardContext& c) {
    using Spec = DriveToPoseSpec;
    const std::span<double> memory = c.memory();
    const auto commanded = static_cast<double>(c.commanded_at(0));
    memory[Spec::kActive] = commanded > memory[Spec::kDone] ? 1 : 0;
    if (memory[Spec::kActive] == 0) return;
    const std::span<const double> target = c.command(0);
    const PlanarPose pose = planar_pose(c.type(), c.state());
    const double dx = target[0] - pose.x, dy = target[1] - pose.y, distance = std::sqrt(dx * dx + dy * dy);
    double speed = 0, angle = 0;
    if (distance > spec.linear_deviation) {
        angle = wrap_angle(fixed_atan2(dy, dx) - pose.yaw);
        if (std::fabs(angle) <= spec.angular_deviation) angle = 0, speed = spec.linear_gain * distance;
    } else {
        angle = wrap_angle(target[2] - pose.yaw);
        if (std::fabs(angle) <= spec.angular_deviation) {
            angle = 0;
            memory[Spec::kDone] = commanded, memory[Spec::kActive] = 0;
        }
    }
    const double twist[6] = {speed, 0, 0, 0, 0, spec.angular_gain * angle};
    c.give_command(0, twist);
}

}  // namespace roboss
