// What ties joints together beyond the tree: joints that close loops, gearboxes, mimic joints; and the start
// configuration in which all of them hold. Internal to the model layer.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "model/model.h"

namespace roboss {

/// Numbers of an axis as a degree of freedom; `continuous`: without limits.
Dof to_dof(const AxisSpec& axis, bool continuous);

/// The loop joint between bodies whose frames stand at X_MA and X_MB in the model frame at the zero
/// configuration, with one Dof a free direction.
LoopJoint to_loop_joint(const JointSpec& spec, const Transform& X_MA, const Transform& X_MB);

/// Tells that the joint closes a loop, and what of it that leaves out.
void report_loop(const JointSpec& joint, const ModelSpec& model, Diagnostics& diagnostics);
/// Tells that the joint cannot move because its links are welded together.
void report_immobile(const JointSpec& joint, const std::string& model, Diagnostics& diagnostics);

/// A gearbox or mimic as the file says it, by names of joints.
struct CouplingSpec {
    std::string follower, leader;
    int follower_axis = 0, leader_axis = 0;
    double multiplier = 1, offset = 0;
    double reference = 0;
    std::array<double, 3> higher{};
    SourceLocation where;
};

/// All gearboxes and mimic joints of a model; what cannot be resolved is reported.
std::vector<CouplingSpec> find_couplings(const ModelSpec& spec, Diagnostics& diagnostics);

/// Adds those whose follower this robot has.
void add_couplings(const std::vector<CouplingSpec>& couplings, RobotType& type, Diagnostics& diagnostics);

/// Settles the start coordinates (RobotType::initial_q): within limits, followers where their leaders put
/// them (joint_start.h), then loops closed: first by joints that the file leaves at zero, if that is not
/// enough by all of them. An error tells the gap that is left.
void close_start(const ModelSpec& spec, RobotType& type, Diagnostics& diagnostics);

/// The same for a robot that starts elsewhere than its type does (Robot::start_q).
void settle_robot(const RobotType& type, Robot& robot, const SourceLocation& where, Diagnostics& diagnostics);

}  // namespace roboss
