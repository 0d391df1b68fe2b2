// The YAML file of ros2_control, as plain data: which controllers a robot has, their names and joints.
// robot_controllers.h finds them in a world.
//
// It is the file of parameters that a controller manager is started with (control.ros.org): the parameters of
// "controller_manager" name controllers and their types, those of a node of each name its joints.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"
#include "model/robot_state.h"

namespace roboss::ros2 {

struct DriveController;

/// A controller.
struct ControllerEntry {
    /// What it takes.
    enum class Kind {
        kTrajectory,       ///< FollowJointTrajectory, and JointTrajectory as a topic
        kSetpoints,        ///< Float64MultiArray: a number for each joint
        kGripper,          ///< GripperCommand, of one joint
        kParallelGripper,  ///< ParallelGripperCommand, of one joint
        kDrive             ///< a velocity of the robot: it becomes an on-board controller (world_drives.h)
    };
    std::string name,                       ///< "panda_arm_controller"
        space;                              ///< of the node, without "/" in front; empty: that of any robot
    Kind kind = Kind::kTrajectory;          ///< what it takes
    MotorMode mode = MotorMode::kPosition;  ///< of setpoints
    std::vector<std::string> joints;        ///< in the order of setpoints
    double goal_tolerance = 0.01,           ///< of a gripper, m or rad
        stall_velocity = 0.001,             ///< below which a gripper stands, m/s or rad/s
        stall_timeout_s = 1;                ///< for so long it has to stand until it is stalled
    bool allow_stalling = false;            ///< a stalled gripper has reached its goal
    std::shared_ptr<const DriveController> drive{};  ///< of a drive; null: it is none
    int line = 0;                                    ///< in the file, from 1
};

/// A file.
struct Controllers {
    std::string file;                      ///< its path, for messages
    std::vector<ControllerEntry> entries;  ///< in the order of the file
    std::vector<std::string> notices;      ///< controllers and parameters that have no effect, one line each
};

/// Reads the text of a file. An Error names file and line.
Result<Controllers> parse_controllers(const std::string& file, const std::string& text);

/// Reads a file of at most 1 MB.
Result<Controllers> read_controllers(const std::filesystem::path& file);

}  // namespace roboss::ros2
