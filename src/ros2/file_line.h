// Where something is in a file, for messages about it.
#pragma once

#include <string>

namespace roboss::ros2 {

/// "bridge.yaml:12: ": in front of messages about a line.
inline std::string at_line(const std::string& file, int line) {
    return file + ":" + std::to_string(line) + ": ";
}

}  // namespace roboss::ros2
