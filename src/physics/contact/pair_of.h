// Which robots and shapes a contact is of.
#pragma once

#include "physics/contact/contact.h"

namespace roboss {

inline ShapePair pair_of(const Contact& c) {
    return {c.robot_a, c.robot_b, c.shape_a, c.shape_b};
}

/// Number of the robot at side B, as ContactMemory has it: kNone for scenery.
inline std::uint32_t other_id(std::span<const RobotWork> robots, const Contact& c) {
    return c.robot_b < 0 ? RobotId::kNone : robots[static_cast<std::size_t>(c.robot_b)].id.value;
}

}  // namespace roboss
