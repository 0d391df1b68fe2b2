// The topics that a world has in Gazebo, and what they are here: "/model/car/odometry" is a reading of the
// robot "car". Files of ros_gz_bridge name them.
//
// A sensor's topic is its <topic>, or "/world/WORLD/model/MODEL/link/LINK/sensor/SENSOR/scan", as gz-sim
// makes it; what plugins send and take is theirs. Joint states and frames are there for each robot, since no
// plugin is needed for them here.
#pragma once

#include <string>
#include <vector>

#include "model/model.h"
#include "ros2_types/message_type.h"

namespace roboss::ros2 {

/// A topic of Gazebo.
struct GazeboTopic {
    /// The thing here that it is.
    enum class Kind {
        kClock,        ///< the time
        kFrames,       ///< frames that move: those of its robot, or of all
        kFixedFrames,  ///< the same of frames that are fixed to others
        kJointStates,  ///< of its robot
        kReading,      ///< a message of a sensor
        kCommand       ///< drives its robot
    };
    std::string name;         ///< "/model/car/odometry"
    Kind kind{};              ///< of the thing
    RobotId robot{};          ///< that has it; not valid: the world
    std::size_t number = 0;   ///< of a sensor or channel, in its RobotType
    std::size_t message = 0;  ///< of a sensor that has several messages (publish() in sensor_messages.h)
    std::vector<const MessageType*> types{};  ///< that it can have in ROS 2; the usual one first
};

/// All of them, by robot.
std::vector<GazeboTopic> gazebo_topics(const Model& model);

}  // namespace roboss::ros2
