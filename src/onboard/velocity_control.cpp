// See onboard_kinds/velocity_control.h.
#include "onboard/controllers.h"

namespace roboss {

void run(const VelocityControlSpec& spec, OnboardContext& c) {
    if (!c.type().free_base && !c.type().kinematic) return;
    Vec3 linear = spec.initial_linear, angular = spec.initial_angular;
    if (c.is_commanded(0)) {
        const std::span<const double> v = c.command(0);
        linear = {v[0], v[1], v[2]}, angular = {v[3], v[4], v[5]};
    } else if (linear == Vec3{} && angular == Vec3{}) {
        return;
    }
    // The base's frame B is that of the canonical link, the robot's frame R stands at X_RB^-1 in it.
    RobotState& state = c.state();
    const Transform X_WB = to_transform(base_pose(state));
    const Mat3 R_WR = X_WB.R * transpose(c.type().X_RB.R);
    const Vec3 w = R_WR * angular;
    const Vec3 v = R_WR * linear + cross(w, R_WR * c.type().X_RB.p);
    if (c.type().kinematic && w == Vec3{} && v == Vec3{}) return state.surfaces.clear();
    if (c.type().kinematic) return c.move_base(w, v);
    for (std::size_t i = 0; i < 3; ++i) state.v[i] = w[i], state.v[i + 3] = v[i];
}

}  // namespace roboss
