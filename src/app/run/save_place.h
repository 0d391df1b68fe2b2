// Where a run writes what pages, Clients and `roboss control` ask it to save: below one folder only.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "wire/control.h"

namespace roboss {

/// The file for a request to save, with the parts of its path resolved. `folder`: `--save-folder`; empty: the
/// current one. `in_use`: files of the run that are never replaced: its journal, its world ...
///
/// An Error has one of these codes: outside-folder, no-folder (of the file), file-exists (and it was not
/// asked to overwrite it), not-a-saved-run (nothing else is overwritten), file-in-use (it is the of
/// `in_use`).
Result<std::filesystem::path> save_place(const std::string& folder, const SaveRun& save,
                                         const std::vector<std::string>& in_use);

}  // namespace roboss
