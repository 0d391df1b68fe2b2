// The effort sensor of joints: the part of the joint's reaction along its axis, in the tick that begins at
// the observed states, which the probe steps.
#include "physics/dynamics/kinematics.h"
#include "sensors/joint_reaction.h"
#include "sensors/readings.h"
#include "sensors/sensor_noise.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

/// Unit, in the world: that the file's child moves along or about, for a positive velocity.
Vec3 axis_in_world(const RobotType& type, const Joint& joint, std::span<const Transform> X_WB,
                   const Transform& X_WBase) {
    if (joint.loop >= 0) {
        const LoopJoint& loop = type.loops[static_cast<std::size_t>(joint.loop)];
        const Mat3& R = loop.body_b < 0 ? X_WBase.R : X_WB[static_cast<std::size_t>(loop.body_b)].R;
        return R * (loop.X_BJ.R * loop.axis_J);
    }
    // The axis has the same numbers in the joint frame and in the frame of the body that it moves. Where the
    // tree walks the joint from child to parent, that body is the file's parent, and turns the other way.
    const auto moved = static_cast<std::size_t>(joint.body);
    const Vec3 axis = X_WB[moved].R * type.bodies[moved].axis_J;
    return joint.reversed ? -axis : axis;
}

}  // namespace

Result<JointEffortReading> read(const JointEffortSpec& sensor, const SensorQuery& query) {
    const RobotType& type = query.type();
    JointEffortReading reading;
    reading.efforts.resize(sensor.joints.size());
    if (type.is_static) return reading;  // nothing of a static model moves
    std::vector<Transform> X_WB(type.bodies.size());
    body_poses(type, query.state, X_WB);
    const Transform X_WBase = to_transform(base_pose(query.state));
    const std::vector<JointReaction> all = query.sources.step_probe().joint_reactions(query.robot);
    for (std::size_t i = 0; i < sensor.joints.size(); ++i) {
        const JointReaction* const reaction = find_reaction(all, type, sensor.joints[i]);
        if (reaction == nullptr)
            return Error{"sensor '" + query.info().spec.name + "' measures the joint '" + sensor.joints[i] +
                             "', which this robot does not have",
                         "put it on a link that the joint moves or carries"};
        const Joint& joint = type.joints[reaction->joint.index()];
        if (joint.nv != 1)
            return Error{"sensor '" + query.info().spec.name + "' measures the joint '" + sensor.joints[i] +
                             "', which does not have one axis",
                         "let it measure revolute, continuous, prismatic or screw joints"};
        const Vec3 axis = axis_in_world(type, joint, X_WB, X_WBase);
        const bool slides = joint.kind == JointSpecKind::kPrismatic;
        const double effort = dot(slides ? reaction->force : reaction->torque, axis);
        reading.efforts[i] = noisy_value(effort, sensor.noise, query, i, i);
    }
    return reading;
}

}  // namespace roboss
