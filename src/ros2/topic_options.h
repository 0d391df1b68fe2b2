// TopicOptions: what the user says about the topics of a world.
#pragma once

#include <memory>

#include "ros2/bridge_file.h"

namespace roboss::ros2 {

/// See the top of the file.
struct TopicOptions {
    bool stamped = false;                  ///< velocities are TwistStamped
    std::shared_ptr<const Bridge> bridge;  ///< gives topics other names and types; null: none does
};

}  // namespace roboss::ros2
