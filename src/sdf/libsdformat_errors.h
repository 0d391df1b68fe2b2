// libsdformat's errors as diagnostics: its line numbers lead to elements of the source, repetitions are
// dropped, and what only says that an element is unknown is a warning.
#pragma once

#include <functional>
#include <sdf/Error.hh>
#include <sdf/Types.hh>

#include "core/diagnostics.h"
#include "sdf/source_file.h"

namespace roboss::sdf_import {

/// `locate`: the element of the source that an error is about; empty if the error has no line. Returns the
/// number of errors (not warnings) told.
std::size_t report_libsdformat_errors(const sdf::Errors& errors, const Element& model,
                                      const std::function<Element(const sdf::Error&)>& locate,
                                      Diagnostics& diagnostics);

}  // namespace roboss::sdf_import
