// Requests to a run as people type them and web pages send them: the arguments of `roboss control`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "wire/control.h"

namespace roboss {

/// A request from its words, e.g. {"step", "10"}, {"speed", "max"}, {"rewind", "#2@12.5"} or {"add", FILE,
/// CONTENT, "x y z roll pitch yaw", NAME} (m, rad). A further word behind NAME puts a copy at each of its
/// lines "NAME x y z roll pitch yaw". {"copy", ROBOT, NAME, POSE} makes one copy of a robot; further words
/// ROBOT, NAME, POSE make more. Errors: unknown-request, bad-value, bad-pose.
Result<ControlAction> parse_control(const std::vector<std::string>& words);

}  // namespace roboss
