// Gaits as files: `name = number` lines (TOML), a name for each parameter. What is left out keeps its
// default.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "gait.h"

namespace spider {

struct GaitField {
    const char* name;
    double Gait::*member;
    double low, high;  // a file with other values is refused
};

/// All parameters but `phases`, in the order of the C interface.
std::span<const GaitField> gait_fields();

/// Reads `phases = [..]` and `name = number` lines of TOML.
/// @throws std::runtime_error with file, line and remedy; also for a text without any parameter.
Gait gait_of_text(const std::string& text, const std::string& file);
Gait load_gait(const std::string& file);

}  // namespace spider
