// Limits of 0, because of which no motor can move a joint.
#pragma once

#include <string_view>

namespace roboss {

/// A limit of 0 of a degree of freedom, for messages.
struct ZeroLimit {
    std::string_view code;    ///< of what is reported: "no-effort" or "no-velocity"
    std::string_view name;    ///< "effort limit" or "velocity limit"
    std::string_view remedy;  ///< without capital and full stop
};

/// The limit that keeps any motor from moving the degree of freedom; nullptr: none does. Bounds are in N m
/// and rad/s, or N and m/s; negative or infinite: unlimited.
const ZeroLimit* zero_limit(double max_effort, double max_velocity);

/// True for the code of an order that is refused because of such a limit: the fault of the robot's file, not
/// of the order.
bool is_of_zero_limit(std::string_view code);

}  // namespace roboss
