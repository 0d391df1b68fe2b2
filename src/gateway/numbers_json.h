// Pages read own numbers of a robot in this form: those that differ from its type's in the JSON of
// "robot", and of all numbers of a joint axis or link in that of "numbers" (docs/viewer-protocol.md).
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "gateway/page_request.h"
#include "model/robot_state.h"

namespace roboss {

/// Adds "own" to `out` where the robot has own numbers.
void add_own(const OwnNumbers& own, nlohmann::ordered_json& out);

/// True if robots of the type have this axis or link.
bool has_numbers(const RobotType& type, const NumbersWish& wish);

/// All numbers of an axis or link that a robot has_numbers() of, each with that of its type where it differs.
void add_numbers(const RobotType& type, const RobotState& state, const NumbersWish& wish,
                 nlohmann::ordered_json& out);

}  // namespace roboss
