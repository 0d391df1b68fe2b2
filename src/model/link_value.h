// The numbers of links that robots have, as programs and pages read them.
#pragma once

#include <optional>

#include "model/link_parameters.h"

namespace roboss {

/// True of the six numbers of an inertia.
constexpr bool is_inertia(LinkParameter parameter) {
    return parameter >= LinkParameter::kInertiaXx && parameter <= LinkParameter::kInertiaYz;
}

/// The number that a robot has; nullopt: the link has none. What an order gave is read to the last digit; an
/// inertia that was not given grows with the robot's own mass; all else is as in `type`, that of the Model.
std::optional<double> link_value(const RobotType& type, const RobotState& state, LinkId link,
                                 LinkParameter parameter);

}  // namespace roboss
