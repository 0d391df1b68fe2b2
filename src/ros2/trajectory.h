// Trajectory: where joints are to be at a time, between the points of a JointTrajectory, as ros2_control's
// joint trajectory controller has it: straight lines between positions, cubic splines where both ends have
// velocities, quintic ones where they have accelerations, too.
#pragma once

#include <string>
#include <vector>

#include "core/result.h"
#include "ros2_types/messages/command_messages.h"

namespace roboss::ros2 {

/// Where one joint is, or is to be.
struct JointPoint {
    double position = 0,   ///< rad or m
        velocity = 0,      ///< rad/s or m/s
        acceleration = 0;  ///< rad/s^2 or m/s^2
};

/// See the top of the file.
class Trajectory {
  public:
    /// From `start`, one for each joint of the message, at time 0. An Error says what is wrong with the
    /// message; codes: "bad-joints", "bad-points".
    static Result<Trajectory> of(const JointTrajectory& message, const std::vector<JointPoint>& start);

    /// Where the joints are to be at a time since the beginning, s; one for each joint.
    std::vector<JointPoint> at(double time_s) const;
    /// The number of the point that the joints move to then; at the end, the last one.
    std::size_t next(double time_s) const;
    /// The time of the last point, s.
    double duration_s() const { return points_.back().time_s; }

  private:
    struct Point {
        double time_s = 0;
        std::vector<JointPoint> joints;
        int order = 0;  // 0: positions; 1: and velocities; 2: and accelerations
    };
    std::vector<Point> points_;  // the first is the start
};

/// Seconds of a duration.
double seconds_of(const Duration& duration);
/// The duration of so many seconds.
Duration duration_of(double seconds);

}  // namespace roboss::ros2
