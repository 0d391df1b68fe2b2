// The action FollowJointTrajectory of a robot, as ros2_control's joint trajectory controller has it, and its
// topic. A robot with such a controller on board gets the trajectory as its list of points, in small steps;
// others get positions of their joints, one order for each in each period.
#pragma once

#include <memory>
#include <string>

#include "ros2/robot_action.h"
#include "ros2/trajectory_goal.h"

namespace roboss::ros2 {

/// Serves CONTROLLER/follow_joint_trajectory of a robot, and takes the trajectories of the topic
/// CONTROLLER/joint_trajectory, unless a controller on board has a topic for them. `controller`:
/// "/arm/joint_trajectory_controller". `joints`: by which trajectories are followed. `older`: feedback as of
/// control_msgs before 6.3 (Humble, Jazzy, Kilted). `transport` and `run` outlive it.
std::unique_ptr<RobotAction> trajectory_action(Transport& transport, EntityId node,
                                               const std::string& controller, RunControl& run, RobotId robot,
                                               TrajectoryJoints joints, bool older);

}  // namespace roboss::ros2
