// The elements and attributes that SDFormat has in a model, up to 1.12. Whatever else stands there is
// reported, so that a slip of the pen does not pass for a setting.
#pragma once

#include "core/diagnostics.h"
#include "sdf/source_file.h"

namespace roboss::sdf_import {

/// A warning for every element and attribute of a <model> or <include> that SDFormat does not know, at any
/// depth. Visuals, sensors, lights, plugins and other namespaces are left to their own readers.
void report_unknown_elements(const Element& element, Diagnostics& diagnostics);

}  // namespace roboss::sdf_import
