// The files that a run reads and writes: no output may replace an input or a file of another kind.
#pragma once

#include <string>
#include <vector>

#include "app/run/run_options.h"
#include "core/result.h"

namespace roboss {

/// The files that the options name to be read, the journal among them.
std::vector<std::string> inputs_of(const RunOptions& options);

/// Before anything is opened. Errors: those of OutputCheck and of may_save_to().
Result<> check_outputs(const RunOptions& options);

/// The kind of file that a reading is written as, by its ending (output/reading_file.h); empty: none.
std::string_view reading_kind(const std::string& file);

}  // namespace roboss
