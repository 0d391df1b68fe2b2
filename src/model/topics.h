// Topics of Gazebo, and the commands of robots that listen to them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/model.h"

namespace roboss {

/// A command of a robot.
struct TopicPlace {
    RobotId robot;              ///< that takes it
    std::uint32_t channel = 0;  ///< in its RobotType::channels
    /// Compares all members.
    friend auto operator<=>(const TopicPlace&, const TopicPlace&) = default;
};

/// The topic of a robot's command: "/model/car/cmd_vel".
std::string topic_of(const Model& model, const TopicPlace& place);

/// All commands that listen to a topic, by robot.
std::vector<TopicPlace> find_topic(const Model& model, const std::string& topic);

/// The message board that the robot is; nullptr: it is none.
const MessageBoardSpec* board_of(const RobotType& type);

/// Pose of the robot (SDF model) frame in the world.
Transform robot_pose(const RobotType& type, const Pose& X_WB);

}  // namespace roboss
