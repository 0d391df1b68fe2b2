// Poses and velocities of bodies and links for tools, sensors and traces, through the same code as the step.
#include "physics/dynamics/kinematics.h"

#include "model/loop_closure.h"
#include "physics/dynamics/robot_work.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

JointState loop_joint_state(const RobotType& type, const RobotState& state, const LoopJoint& loop,
                            std::size_t axis) {
    RobotWork work;
    forward_kinematics<double>(type, state.q, work);
    forward_velocities<double>(type, state.v, work);
    const auto placed = [&](int b) {
        const Transform X_WB =
            b < 0 ? to_transform(base_pose(state)) : work.bodies[static_cast<std::size_t>(b)].X_WB;
        return Transform{X_WB.R, X_WB.p - work.origin};
    };
    const auto velocity = [&](int b) {
        return b < 0 ? Spatial{} : work.bodies[static_cast<std::size_t>(b)].velocity;
    };
    const FreeDirections free = free_directions(loop, placed(loop.body_a), placed(loop.body_b));
    const FreeDirection& direction = free.directions[axis];
    return {direction.position, dot(direction.wrench, velocity(loop.body_b) - velocity(loop.body_a))};
}

}  // namespace

void body_poses(const RobotType& type, const RobotState& state, std::span<Transform> X_WB) {
    RobotWork work;
    forward_kinematics<double>(type, state.q, work);
    for (std::size_t b = 0; b < X_WB.size(); ++b) X_WB[b] = work.bodies[b].X_WB;
}

Transform link_pose(const RobotType& type, const RobotState& state, LinkId link) {
    const Link& info = type.links[link.index()];
    if (info.body < 0) return to_transform(base_pose(state)) * info.X_BL;
    RobotWork work;
    forward_kinematics<double>(type, state.q, work);
    return work.bodies[static_cast<std::size_t>(info.body)].X_WB * info.X_BL;
}

Twist link_twist(const RobotType& type, const RobotState& state, LinkId link) {
    const Link& info = type.links[link.index()];
    if (info.body < 0) return {};
    RobotWork work;
    forward_kinematics<double>(type, state.q, work);
    forward_velocities<double>(type, state.v, work);
    const BodyWork& body = work.bodies[static_cast<std::size_t>(info.body)];
    const Vec3 p = body.X_WB * info.X_BL.p - work.origin;
    return {body.velocity.angular, body.velocity.linear + cross(body.velocity.angular, p)};
}

JointState joint_state(const RobotType& type, const RobotState& state, JointId id, int axis) {
    const Joint& joint = type.joints[id.index()];
    if (axis < 0 || axis >= joint.nv) return {};
    if (joint.loop >= 0)
        return loop_joint_state(type, state, type.loops[static_cast<std::size_t>(joint.loop)],
                                static_cast<std::size_t>(axis));
    const auto offset = static_cast<std::size_t>(joint.axis_offset(axis));
    const auto q = static_cast<std::size_t>(joint.q_index),
               v = static_cast<std::size_t>(joint.v_index) + offset;
    if (!joint_type(joint.kind).is_isotropic()) return {state.q[q + offset], state.v[v]};
    const Vec3 turned = logarithm(Quat{state.q[q], state.q[q + 1], state.q[q + 2], state.q[q + 3]});
    return {turned[offset], state.v[v]};
}

}  // namespace roboss
