// Poses and velocities of bodies and links for tools, sensors and traces, through the same code as the step.
#include "physics/kinematics.h"

#include "physics/robot_work.h"

namespace roboss {

void body_poses(const RobotType& type, const RobotState& state, std::span<Transform> X_WB) {
    RobotWork work;
    place_bodies(type, state.q, work);
    for (std::size_t b = 0; b < X_WB.size(); ++b) X_WB[b] = work.bodies[b].X_WB;
}

Transform link_pose(const RobotType& type, const RobotState& state, LinkId link) {
    const Link& info = type.links[link.index()];
    if (info.body < 0) return to_transform(base_pose(state)) * info.X_BL;
    RobotWork work;
    place_bodies(type, state.q, work);
    return work.bodies[static_cast<std::size_t>(info.body)].X_WB * info.X_BL;
}

Twist link_twist(const RobotType& type, const RobotState& state, LinkId link) {
    const Link& info = type.links[link.index()];
    if (info.body < 0) return {};
    RobotWork work;
    place_bodies(type, state.q, work);
    move_bodies(type, state.v, work);
    const BodyWork& body = work.bodies[static_cast<std::size_t>(info.body)];
    const Vec3 p = body.X_WB * info.X_BL.p - work.origin;
    return {body.velocity.angular, body.velocity.linear + cross(body.velocity.angular, p)};
}

}  // namespace roboss
