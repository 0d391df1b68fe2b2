// Changes that an <include> makes in its model: plugins of its own, and <experimental:params>,
// which adds, modifies, removes or replaces elements (sdformat.org, "SDFormat Parameter Passing").
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/diagnostics.h"
#include "sdf/source_file.h"

namespace roboss::sdf_import {

/// The changes as text; empty: none.
std::string changes_in(const Element& include);

/// The model that an <include> names.
using FindModel = std::function<Element(const Element& include)>;

/// The included model with the changes of the <include>, as a file of its own; each element keeps its place.
/// nullptr with an error if a change is wrong.
std::unique_ptr<SourceFile> changed_file(const Element& model, const Element& include, const FindModel& find,
                                         Diagnostics& diagnostics);

}  // namespace roboss::sdf_import
