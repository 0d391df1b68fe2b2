// RobotCommands: the topics by which ROS 2 nodes drive robots, and the orders that their messages stand for.
//
// A robot takes each command of its on-board controllers (RobotType::channels) in its namespace:
// "/car_3/cmd_vel". The message follows from the values of the command: Twist (or TwistStamped) for a
// velocity, Float64, Bool, String, Float64MultiArray, PoseStamped, JointTrajectory, Empty. Joints that no
// on-board controller moves take setpoints as those of ros2_control do, by the controllers of a file, or, of
// a robot without commands, all joints by "/arm/position_controller/commands". "/fleet/cmd_vel" drives all
// robots that take a velocity.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/result.h"
#include "model/order.h"
#include "ros2/robot_controllers.h"
#include "ros2/topic_options.h"
#include "ros2_types/message_type.h"

namespace roboss::ros2 {

/// A topic by which a robot is driven.
struct CommandTopic {
    /// The type of its messages and their meaning.
    enum class Kind {
        kTwist,         ///< a velocity
        kTwistStamped,  ///< a velocity and the time of what it answers to
        kNumber,        ///< the only value of a command
        kSwitch,        ///< the same, true or false
        kText,          ///< the same, one of its words
        kNumbers,       ///< all values of a command, or a list
        kPose,          ///< a place on the ground
        kTrajectory,    ///< points of joints
        kSignal,        ///< a command without values
        kSetpoints,     ///< one for each joint
        kFleet          ///< velocities, a row for each robot of the fleet
    };
    std::string name;                       ///< "/car_3/cmd_vel"
    const MessageType* type = nullptr;      ///< of its messages
    Kind kind = Kind::kNumbers;             ///< of the messages
    RobotId robot{};                        ///< that it drives; not valid: a fleet
    std::uint32_t channel = 0;              ///< the command, in RobotType::channels; not of setpoints
    MotorMode mode = MotorMode::kVelocity;  ///< of setpoints
    std::vector<JointId> joints{};          ///< in the order of setpoints
};

/// An order to a robot.
struct RobotOrder {
    RobotId robot;  ///< that shall do it
    Action action;  ///< what it shall do
};

/// See the top of the file.
class RobotCommands {
  public:
    /// Collects the topics of all robots.
    RobotCommands(std::shared_ptr<const Model> model, const TopicOptions& options);

    /// All topics, by robot; that of the fleet is the last.
    const std::vector<CommandTopic>& topics() const { return topics_; }
    /// True if a topic takes messages of this type as well as of its own: Twist and TwistStamped.
    bool takes(std::size_t topic, const std::string& type) const;
    /// From now on the topic, which takes() the other one of the two types, has that.
    void change_type(std::size_t topic);
    /// The orders that a message of topics()[topic] asks for. An Error names the topic and what is wrong with
    /// the message.
    Result<std::vector<RobotOrder>> orders(std::size_t topic, std::string_view cdr) const;

  private:
    void add_robot(RobotId robot, const std::string& name, bool stamped, std::set<std::string>& taken);
    void add_setpoints(RobotId robot, const std::string& name, const std::vector<RobotController>& own);
    Result<std::vector<double>> values(const CommandTopic& topic, std::string_view cdr) const;
    Result<std::vector<RobotOrder>> setpoints(const CommandTopic& topic, std::string_view cdr) const;
    void add_fleet();
    Result<std::vector<RobotOrder>> fleet_orders(std::string_view cdr) const;

    std::shared_ptr<const Model> model_;
    std::vector<CommandTopic> topics_;
    std::shared_ptr<const Controllers> controllers_;  // of a file; null: the usual ones
    std::vector<RobotId> fleet_;                      // rows of /fleet/cmd_vel
};

/// The messages of a command. `stamped`: velocities are TwistStamped.
std::pair<CommandTopic::Kind, const MessageType*> message_of(const Channel& channel, bool stamped);

}  // namespace roboss::ros2
