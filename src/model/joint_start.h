// Where the joints of a robot start: within their limits, leaders where the file puts them, followers
// (gearboxes and mimic joints) where their leaders put them. One rule for all formats. Internal to the model
// layer.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/model.h"

namespace roboss {

/// A coordinate that starts elsewhere than the file says; rad or m.
struct JointMove {
    std::size_t dof = 0;  ///< in RobotType::dofs
    double from = 0, to = 0;
};

/// The result of settle_joints().
struct JointStart {
    std::vector<JointMove> moved;     ///< by more than 1e-3 rad or m
    std::vector<std::size_t> beyond;  ///< in RobotType::dofs: no leader's position keeps them within limits
};

/// Sets joint coordinates (behind the 7 base ones) to a start that the joints can have. A joint that leads,
/// or is alone, keeps its position, clamped to its limits; a follower goes where its leader puts it, along
/// chains too. If that is beyond the follower's limits, the leader moves by the least that keeps all of them
/// within theirs; if there is no such place, it keeps its own. Followers of two leaders, or of each other,
/// stay.
JointStart settle_joints(const RobotType& type, std::vector<double>& joints);

/// A note that says what moved: of which joint, from where to where, and why.
void report(std::span<const JointMove> moved, const RobotType& type, const std::string& robot,
            const SourceLocation& where, Diagnostics& diagnostics);
/// A warning for each joint that starts beyond its limits, at `joints`.
void report_beyond(std::span<const std::size_t> beyond, const RobotType& type,
                   const std::vector<double>& joints, const std::string& robot, const SourceLocation& where,
                   Diagnostics& diagnostics);

/// True if the limits of the degree of freedom allow the position, but for rounding.
bool starts_within(const Dof& dof, double position);

}  // namespace roboss
