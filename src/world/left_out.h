// Models that are left out of their world because they have errors: the rest of it runs.
#pragma once

#include <string>

#include "core/diagnostics.h"

namespace roboss {

/// An error that names such a model, and how many more are like it.
void report_left_out(const std::string& name, std::size_t count, const SourceLocation& where,
                     Diagnostics& diagnostics);

}  // namespace roboss
