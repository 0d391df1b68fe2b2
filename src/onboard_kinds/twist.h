// The command of a velocity (Gazebo's Twist): the same six values for every kind that takes one, so that one
// program drives all of them.
#pragma once

#include <string_view>

#include "onboard_kinds/kind.h"

namespace roboss {

/// Places of the values in a velocity command.
struct Twist6 {
    static constexpr std::size_t kLinearX = 0,  ///< m/s
        kLinearY = 1,                           ///< m/s
        kLinearZ = 2,                           ///< m/s
        kAngularX = 3,                          ///< rad/s
        kAngularY = 4,                          ///< rad/s
        kAngularZ = 5;                          ///< rad/s
};

/// The channel that listens to `topic` (channel_of), with linear and angular velocity as values.
inline Channel twist_channel(std::string_view topic, std::string_view usual) {
    return channel_of(topic, usual,
                      {{"linear_x", "m/s"},
                       {"linear_y", "m/s"},
                       {"linear_z", "m/s"},
                       {"angular_x", "rad/s"},
                       {"angular_y", "rad/s"},
                       {"angular_z", "rad/s"}});
}

}  // namespace roboss
