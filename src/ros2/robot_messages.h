// Messages of ROS 2 that say what the state of a robot says: its frames, its joints, where it is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/model.h"
#include "model/robot_state.h"
#include "ros2_types/messages/sensor_messages.h"

namespace roboss::ros2 {

/// A frame on another, m.
TransformStamped transform(const Time& stamp, std::string parent, std::string child, const Transform& X);

/// Adds the links that are fixed to others. `names`: of their frames, by LinkId.
void add_fixed_links(const RobotType& type, const std::vector<std::string>& names, const Time& stamp,
                     TFMessage& frames);

/// Where an odometry sees the first base of a robot.
struct SeenBase {
    std::string frame;  ///< of the odometry; empty: others say where the base is
    Transform X_FB;     ///< the base in it, m
};
/// Adds the links that move: bases in "world", others on their parents. With `seen` the first base stands in
/// the frame of the odometry, and other bases of the robot on the first.
void add_moving_links(const RobotType& type, const RobotState& state, const std::vector<std::string>& names,
                      const std::optional<SeenBase>& seen, const Time& stamp, TFMessage& frames);

/// The pose of the first link in the world, m, and its velocity in its own axes.
Odometry true_odometry(const RobotType& type, const RobotState& state, const std::string& name,
                       const Time& stamp);

/// True if a sensor has a new sample at `tick`, since the look at `last` (-1: there was none).
bool has_new_sample(const SensorSpec& sensor, const Model& model, Tick last, Tick tick);

/// Joints of one axis, as JointState has them.
std::vector<JointId> single_axis_joints(const RobotType& type);
/// Adds these joints of a robot, their names with `prefix` in front.
void add_joint_states(const Model& model, RobotId robot, const RobotState& state,
                      const std::vector<JointId>& joints, const std::string& prefix, JointStateMessage& to);

}  // namespace roboss::ros2
