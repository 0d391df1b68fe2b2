// See onboard_kinds/velocity_control.h.
#include "onboard/controllers.h"

namespace roboss {
namespace {

Vec3 linear_of(std::span<const double> twist) {
    return {twist[Twist6::kLinearX], twist[Twist6::kLinearY], twist[Twist6::kLinearZ]};
}
Vec3 angular_of(std::span<const double> twist) {
    return {twist[Twist6::kAngularX], twist[Twist6::kAngularY], twist[Twist6::kAngularZ]};
}

void set_base_velocity(RobotState& state, const Vec3& angular, const Vec3& linear) {
    for (std::size_t i = 0; i < 3; ++i) state.v[i] = angular[i], state.v[i + 3] = linear[i];
}

/// The whole robot gets the motion that the link lacks, as a rigid body; its joints go on as they do.
void move_link(OnboardContext& c) {
    if (!c.is_commanded(0)) return;
    RobotState& state = c.state();
    const Transform X_WL = c.pose(c.link(0));
    const LinkTwist now = c.twist(c.link(0));
    const Vec3 turn = X_WL.R * angular_of(c.command(0)) - now.angular;
    const Vec3 arm = X_WL.p - Vec3{state.q[0], state.q[1], state.q[2]};
    const Vec3 push = X_WL.R * linear_of(c.command(0)) - now.linear - cross(turn, arm);
    set_base_velocity(state, Vec3{state.v[0], state.v[1], state.v[2]} + turn,
                      Vec3{state.v[3], state.v[4], state.v[5]} + push);
}

}  // namespace

void run(const VelocityControlSpec& spec, OnboardContext& c) {
    const bool kinematic = c.type().kinematic;
    if (!c.type().free_base && !kinematic) return;
    if (!spec.links.empty() && !kinematic) {
        move_link(c);
        return;
    }
    Vec3 linear = spec.initial_linear, angular = spec.initial_angular;
    if (c.is_commanded(0)) linear = linear_of(c.command(0)), angular = angular_of(c.command(0));
    const Mat3 R_WR = to_transform(base_pose(c.state())).R * transpose(c.type().X_RB.R);
    const Vec3 w = R_WR * angular, v = R_WR * linear;
    if (!kinematic)
        set_base_velocity(c.state(), w, v);
    else if (w == Vec3{} && v == Vec3{})
        c.state().surfaces.clear();
    else
        c.move_base(w, v);
}

}  // namespace roboss
