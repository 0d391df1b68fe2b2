// Robots by name or pattern, wherever people name robots: orders, edits.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "model/model.h"

namespace roboss {

/// True if the text fits the pattern: `*` stands for any characters, `?` for one, `[abx-z]` for one of these,
/// `[!ab]` for one that is none of these. The rules are those of Python's fnmatchcase(); case counts.
bool fits_pattern(std::string_view text, std::string_view pattern);

/// The robot with this name; else those whose names fit it as a pattern, by RobotId, without message boards.
/// Empty: there are none.
std::vector<RobotId> find_robots(const Model& model, const std::string& wanted);

/// There is no such robot; names one whose name is much like it. Code: no-robot.
Error no_such_robot(const Model& model, const std::string& wanted);

}  // namespace roboss
