// Finds the controllers of a file of ros2_control in a world. A controller belongs to each robot that has all
// of its joints; such a robot has the controllers of the file instead of its usual ones.
#pragma once

#include <string>
#include <vector>

#include "model/model.h"
#include "ros2/controllers_file.h"

namespace roboss::ros2 {

/// A controller of a robot.
struct RobotController {
    const ControllerEntry* entry = nullptr;  ///< in the file
    std::vector<JointId> joints;             ///< of the robot's type, in the order of the file
};

/// Those of a robot of this type with this name (robot_names.h), in the order of the file. None of those
/// whose joints on-board controllers move, but for drives that the Model has (world_drives.h), and for
/// trajectories of an on-board controller of all these joints.
std::vector<RobotController> controllers_of(const Controllers& controllers, const RobotType& type,
                                            const std::string& robot);

/// The drive whose odometry this sensor of a robot is; null: it is that of no drive of the file.
const DriveController* drive_of(const Controllers& controllers, const RobotType& type,
                                const std::string& robot, const SensorSpec& sensor);

/// Controllers and parameters that have no effect, one line each: file, line and why. `robots`: names by
/// RobotId.
std::vector<std::string> controller_notices(const Controllers& controllers, const Model& model,
                                            const std::vector<std::string>& robots);

/// True of joints with one axis that a motor moves and no other joint drives.
bool is_driven(const RobotType& type, JointId joint);
/// True of joints with one axis that follow another joint.
bool follows(const RobotType& type, JointId joint);

}  // namespace roboss::ros2
