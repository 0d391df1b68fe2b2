// What stands in a file and has no effect, by its name. Blocks that are read by the names of their children:
// whatever else stands in them is told, so that a slip of the pen does not pass for a setting.
#pragma once

#include <span>

#include "core/diagnostics.h"
#include "sdf/source_file.h"

namespace roboss::sdf_import {

/// Whether the name has a namespace, and not ours: meant for another program.
bool is_foreign(const std::string& name);

void report_foreign(const Element& element, Diagnostics& diagnostics);

/// A finding for every child of `block` that is none of `known`: a note where its namespace is not ours, else
/// a warning.
void report_unknown_children(const Element& block, std::span<const char* const> known,
                             Diagnostics& diagnostics);

}  // namespace roboss::sdf_import
