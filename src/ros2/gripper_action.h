// The actions by which a gripper of one joint is sent to a position, as ros2_control's gripper controllers
// have them. It has reached its goal when it is there, or, where that is allowed, when something stops it.
#pragma once

#include <memory>
#include <string>

#include "ros2/robot_action.h"
#include "ros2/robot_controllers.h"

namespace roboss::ros2 {

/// Serves CONTROLLER/gripper_cmd of a robot: GripperCommand or ParallelGripperCommand, as the controller's
/// entry says. `name`: of the controller, "/arm/hand_controller". `transport` and `run` outlive it.
std::unique_ptr<RobotAction> gripper_action(Transport& transport, EntityId node, const std::string& name,
                                            RunControl& run, RobotId robot,
                                            const RobotController& controller);

}  // namespace roboss::ros2
