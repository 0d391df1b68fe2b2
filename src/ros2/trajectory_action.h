// TrajectoryAction: the action FollowJointTrajectory of a robot, as ros2_control's joint trajectory
// controller has it. A robot with such a controller on board gets the trajectory as its list of points, in
// small steps; others get positions of their joints, one order for each in each period.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ros2/run_control.h"
#include "ros2_types/transport.h"

namespace roboss::ros2 {

/// See the top of the file.
class TrajectoryAction {
  public:
    /// Serves a robot. `action`: "/arm/joint_trajectory_controller/follow_joint_trajectory". `older`:
    /// feedback as of control_msgs before 6.3 (Humble, Jazzy, Kilted). `transport` and `run` outlive it. A
    /// change of the world ends it: make another one.
    TrajectoryAction(Transport& transport, EntityId node, const std::string& action, RunControl& run,
                     RobotId robot, bool older);
    ~TrajectoryAction();
    TrajectoryAction(const TrajectoryAction&) = delete;
    TrajectoryAction& operator=(const TrajectoryAction&) = delete;

    /// True if the robot has joints that can follow: one axis, with a motor or an on-board controller of
    /// trajectories.
    static bool fits(const RobotType& type);

    /// Serves a call. False: it is not for this action.
    bool take(const Incoming& call);
    /// Goes on with the goal. Called after each observation; orders are given here.
    void advance(std::int64_t now_ms);
    /// Goals that were refused and why, since the last call.
    std::vector<std::string> take_notices();

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace roboss::ros2
