// The parts that the robots of a set share by name: the columns of their arrays, whatever types they are of.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/joint_axis.h"

namespace roboss {

/// A joint axis, link, sensor or command that all robots of a set have.
struct SharedPart {
    std::string name;             ///< all have it under this name, or at the same place of one type
    std::vector<std::size_t> of;  ///< its number there, by SharedParts::types
};

/// See the top of the file. Of robots of one type all parts are shared: their names may differ, then those of
/// the first robot count. Where a robot has one of these names for another part, and of different types those
/// are shared whose names are equal, and which are of one kind: joints whose positions have one unit, sensors
/// of one kind, commands with the same values.
struct SharedParts {
    std::vector<const RobotType*> types;     ///< all that robots of the set have, the first robot's first
    std::vector<std::uint32_t> type_of_row;  ///< of each robot: in `types`
    std::vector<SharedPart> axes,            ///< `of`: in axes_of_joints()
        links,                               ///< `of`: in RobotType::links
        sensors,                             ///< `of`: in RobotType::sensors
        commands;                            ///< `of`: in RobotType::channels
    std::vector<std::vector<JointAxis>> axes_of_types;  ///< by type, then by `axes`
    /// True if all are of one type (RobotType::like).
    bool one_type = true;

    /// The parts of robots that exist in the model.
    SharedParts(const Model& model, std::span<const RobotId> robots);
};

}  // namespace roboss
