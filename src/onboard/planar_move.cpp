// See onboard_kinds/planar_move.h.
#include <algorithm>

#include "core/fixed_math.h"
#include "onboard/controllers.h"
#include "onboard/wheel_odometry.h"

namespace roboss {

void run(const PlanarMoveSpec& spec, OnboardContext& c) {
    RobotState& state = c.state();
    set_true_odometry(c.memory().first<5>(), c.type(), state);
    if (!c.type().free_base) return;
    const double age = static_cast<double>(c.tick() - c.commanded_at(0)) * c.dt();
    double x = 0, y = 0, turn = 0;
    if (c.is_commanded(0) && (spec.timeout < 0 || age <= spec.timeout)) {
        const std::span<const double> twist = c.command(0);
        x = twist[Twist6::kLinearX], y = twist[Twist6::kLinearY], turn = twist[Twist6::kAngularZ];
    }
    // All links move as one: the robot's frame with the velocity wanted, joints stand still.
    const PlanarPose pose = planar_pose(c.type(), state);
    const SinCos heading = fixed_sincos(pose.yaw);
    const double arm_x = state.q[0] - pose.x, arm_y = state.q[1] - pose.y;
    const double v[] = {0,
                        0,
                        turn,
                        x * heading.cos - y * heading.sin - turn * arm_y,
                        x * heading.sin + y * heading.cos + turn * arm_x,
                        0};
    std::copy(std::begin(v), std::end(v), state.v.begin());
    std::fill(state.v.begin() + 6, state.v.end(), 0.0);
}

}  // namespace roboss
