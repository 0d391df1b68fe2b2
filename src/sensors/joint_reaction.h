// What a joint passes on, for sensors that measure it.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "model/model.h"
#include "physics/probe.h"

namespace roboss {

/// That of the joint with this name; nullptr: the robot has none, or it bears nothing.
inline const JointReaction* find_reaction(const std::vector<JointReaction>& all, const RobotType& type,
                                          const std::string& joint) {
    const auto id = type.find_joint(joint);
    const auto found =
        std::ranges::find_if(all, [&](const JointReaction& r) { return id && r.joint == *id; });
    return found != all.end() ? &*found : nullptr;
}

}  // namespace roboss
