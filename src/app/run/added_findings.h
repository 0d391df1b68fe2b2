// Findings about models that are added to a run, as the one who asked for them and the run's terminal read
// them.
#pragma once

#include <string>
#include <vector>

#include "core/diagnostics.h"

namespace roboss {

/// Findings about a file of the run, under the name that its sender gave it.
Diagnostics under_name(const Diagnostics& found, const std::string& file, const std::string& name);

/// Those that a run tells of, errors first, in groups; of many groups the first ones and how many more there
/// are.
std::vector<std::string> told_findings(const Diagnostics& found);

}  // namespace roboss
