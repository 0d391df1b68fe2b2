// FleetTopics: all robots of a world in one message, for programs with hundreds of them.
//
//   /fleet/names         one name a line: the order of the rows below; static models are not in it
//   /fleet/states        13 numbers a robot: x y z, qx qy qz qw of its first link, its velocity vx vy vz,
//                        wx wy wz; m, m/s, rad/s, axes of the world
//   /fleet/poses         the same poses, for RViz
//   /fleet/joint_states  all joints, each as "ROBOT/JOINT"
//   /fleet/scans         the ranges of each robot's first level laser, m; NaN: it has none, or no new one
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ros2/robot_topics.h"

namespace roboss::ros2 {

/// Robots that are rows of a fleet's messages.
std::vector<RobotId> fleet_of(const Model& model);

/// See the top of the file.
class FleetTopics {
  public:
    /// Adds its topics. `names`: of all robots, by RobotId, with prefixes of their joints.
    FleetTopics(std::shared_ptr<const Model> model, const std::vector<std::string>& names,
                std::vector<Topic>& topics);

    /// Adds the message with the names.
    void add_latched(const std::vector<bool>& wanted, std::vector<RobotTopics::Message>& out) const;
    /// Adds the others that are wanted. `last`: the tick of the call before, -1: there was none.
    Result<> add_messages(Tick tick, Tick last, std::span<const RobotState> states,
                          const std::vector<bool>& wanted, const RobotTopics::Measure& measure,
                          std::vector<RobotTopics::Message>& out) const;

  private:
    struct Row {
        RobotId robot;
        std::string name;
        std::size_t laser = kNone;    // among its sensors
        std::vector<JointId> joints;  // of one axis
    };
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

    std::string states_message(std::span<const RobotState> states) const;
    std::string poses_message(Tick tick, std::span<const RobotState> states) const;
    std::string joints_message(Tick tick, std::span<const RobotState> states) const;
    /// Empty: no laser has a new scan.
    Result<std::string> scans_message(Tick tick, Tick last, const RobotTopics::Measure& measure) const;

    std::shared_ptr<const Model> model_;
    std::size_t first_ = 0;  // its topics, in the order of the top of the file
    std::vector<Row> rows_;
    std::size_t beams_ = 0;  // of the widest laser
};

}  // namespace roboss::ros2
