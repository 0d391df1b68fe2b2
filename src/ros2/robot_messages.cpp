// See robot_messages.h.
#include "ros2/robot_messages.h"

#include <utility>

#include "client/held_samples.h"
#include "physics/dynamics/kinematics.h"
#include "physics/dynamics/motor_effort.h"
#include "ros2/sensor_messages.h"

namespace roboss::ros2 {

TransformStamped transform(const Time& stamp, std::string parent, std::string child, const Transform& X) {
    const Pose pose = to_pose(X);
    return {{stamp, std::move(parent)},
            std::move(child),
            {{pose.p.x, pose.p.y, pose.p.z}, sensor_messages::quaternion(pose.q)}};
}

void add_fixed_links(const RobotType& type, const std::vector<std::string>& names, const Time& stamp,
                     TFMessage& frames) {
    for (std::size_t l = 0; l < type.links.size(); ++l) {
        const Link& link = type.links[l];
        if (link.parent < 0) continue;
        const auto p = static_cast<std::size_t>(link.parent);
        const Link& parent = type.links[p];
        if (link.body == parent.body)
            frames.transforms.push_back(
                transform(stamp, names[p], names[l], inverse(parent.X_BL) * link.X_BL));
    }
}

void add_moving_links(const RobotType& type, const RobotState& state, const std::vector<std::string>& names,
                      const std::optional<SeenBase>& seen, const Time& stamp, TFMessage& frames) {
    std::vector<Transform> bodies(type.bodies.size());
    body_poses(type, state, bodies);
    const auto pose_of = [&](const Link& link) {
        return (link.body < 0 ? to_transform(base_pose(state))
                              : bodies[static_cast<std::size_t>(link.body)]) *
               link.X_BL;
    };
    const auto add = [&](const std::string& parent, std::size_t link, const Transform& X) {
        frames.transforms.push_back(transform(stamp, parent, names[link], X));
    };
    for (std::size_t l = 0; l < type.links.size(); ++l) {
        const Link& link = type.links[l];
        const auto on = [&](std::size_t parent) {
            add(names[parent], l, inverse(pose_of(type.links[parent])) * pose_of(link));
        };
        if (link.parent >= 0) {
            const auto parent = static_cast<std::size_t>(link.parent);
            if (link.body != type.links[parent].body) on(parent);  // else add_fixed_links() has it
        } else if (!seen) {
            add("world", l, pose_of(link));
        } else if (l == 0) {
            if (!seen->frame.empty()) add(seen->frame, l, seen->X_FB);
        } else {
            on(0);
        }
    }
}

Odometry true_odometry(const RobotType& type, const RobotState& state, const std::string& name,
                       const Time& stamp) {
    const LinkId base(std::size_t{0});
    const Pose X_WL = to_pose(link_pose(type, state, base));
    const Twist twist = link_twist(type, state, base);
    const Mat3 R_LW = transpose(to_matrix(X_WL.q));
    Odometry odometry;
    odometry.header = {stamp, "world"}, odometry.child_frame_id = name;
    odometry.pose.pose = sensor_messages::pose(X_WL.p, X_WL.q);
    odometry.twist.twist = {sensor_messages::vector(R_LW * twist.linear),
                            sensor_messages::vector(R_LW * twist.angular)};
    return odometry;
}

bool has_new_sample(const SensorSpec& sensor, const Model& model, Tick last, Tick tick) {
    const double rate = sensor.update_rate_hz;
    return rate <= 0 || last < 0 || sample_is_due(rate, model.dt_s, last, tick);
}

std::vector<JointId> single_axis_joints(const RobotType& type) {
    std::vector<JointId> joints;
    for (std::size_t j = 0; j < type.joints.size(); ++j)
        if (type.joints[j].nv == 1) joints.push_back(JointId(j));
    return joints;
}

void add_joint_states(const Model& model, RobotId robot, const RobotState& state,
                      const std::vector<JointId>& joints, const std::string& prefix, JointStateMessage& to) {
    const RobotType& type = model.type_of(robot);
    for (const JointId joint : joints) {
        const JointState at = joint_state(type, state, joint);
        to.name.push_back(prefix + type.joints[joint.index()].name);
        to.position.push_back(at.position), to.velocity.push_back(at.velocity);
        to.effort.push_back(motor_effort(model, type, state, joint));
    }
}

}  // namespace roboss::ros2
