// TrajectoryGoal: a goal of FollowJointTrajectory as one robot executes it: which of its joints, where to,
// within which tolerances.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "model/order.h"
#include "ros2/run_control.h"
#include "ros2/trajectory.h"
#include "ros2_types/messages/control_messages.h"

namespace roboss::ros2 {

/// By which joints of a robot trajectories are followed.
struct TrajectoryJoints {
    std::vector<JointId> joints;           ///< that may be named
    std::optional<std::uint32_t> channel;  ///< of the on-board controller that takes points; none: by orders

    /// Those of a robot; none: it cannot follow trajectories.
    static TrajectoryJoints of(const RobotType& type);
    /// These of a robot, by its controller on board if it has one. Those that follow other joints may be
    /// named, and get no orders.
    static TrajectoryJoints of(const RobotType& type, std::vector<JointId> joints);
};

/// See the top of the file.
class TrajectoryGoal {
  public:
    using Goal = FollowJointTrajectory::Goal;
    using Result = FollowJointTrajectory::Result;
    /// The most that joints may be away from where they are to be; infinite: it does not matter.
    struct Tolerance {
        double position = std::numeric_limits<double>::infinity(),  ///< rad or m
            velocity = std::numeric_limits<double>::infinity();     ///< rad/s or m/s
    };
    /// The joints at a tick.
    struct Sample {
        std::vector<JointPoint> desired, actual;  ///< by joint of the goal
        std::size_t point = 0;                    ///< that they move to
    };

    /// From where the robot is now. An Error says what is wrong with the goal.
    static roboss::Result<TrajectoryGoal> of(const Goal& goal, const RunControl& run, RobotId robot,
                                             const TrajectoryJoints& able);

    /// Names of its joints, in the order of samples.
    const std::vector<std::string>& names() const { return names_; }
    /// Gives the orders by which the robot begins.
    roboss::Result<> begin(RunControl& run) const;
    /// Where the joints are to be and are, at the tick that is observed.
    Sample sample(const RunControl& run) const;
    /// Its end, if it has ended: in success, or because a tolerance is violated.
    std::optional<Result> outcome(const RunControl& run, const Sample& sample) const;
    /// Gives the orders of a period that begins now, `period` ticks long.
    void follow(RunControl& run, Tick period) const;
    /// Lets the robot hold the position that it has.
    void hold(RunControl& run) const;

  private:
    roboss::Result<> choose_joints(const Goal& goal, const RobotType& type, const TrajectoryJoints& able);
    roboss::Result<> set_tolerances(const std::vector<JointTolerance>& from,
                                    std::vector<Tolerance>& to) const;
    std::vector<JointPoint> actual(const RunControl& run) const;
    std::vector<double> row(double time_s, const std::vector<JointPoint>& joints) const;
    double time_s(const RunControl& run) const;
    bool hold_positions(RunControl& run, const std::vector<JointPoint>& at) const;

    RobotId robot_;
    std::optional<std::uint32_t> channel_;
    std::vector<JointId> joints_;
    std::vector<std::string> names_;
    std::vector<std::size_t> places_;  // of the controller's joints in the goal's; only with channel_
    std::vector<Tolerance> on_the_way_, at_the_end_;
    double goal_time_s_ = 0;  // 0: no limit
    Tick begin_ = 0;
    Trajectory trajectory_;
};

}  // namespace roboss::ros2
