// Stamps of ROS 2: simulated time from the start of the world.
#pragma once

#include <cstdint>

#include "model/model.h"
#include "ros2_types/messages/standard_messages.h"

namespace roboss::ros2 {

/// The stamp of messages about a tick.
Time stamp_of(const Model& model, Tick tick);

/// The same in ns.
inline std::int64_t nanoseconds(const Time& stamp) {
    return std::int64_t{stamp.sec} * 1'000'000'000 + stamp.nanosec;
}

}  // namespace roboss::ros2
