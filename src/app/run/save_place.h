// Where a run writes what pages, Clients and `roboss control` ask it to save: below one folder only.
#pragma once

#include <filesystem>
#include <string>

#include "core/result.h"
#include "wire/control.h"

namespace roboss {

/// The file for a request to save, with the parts of its path resolved. `folder`: `--save-folder`; empty: the
/// current one. `journal`: the run's own, which is never replaced; empty: none.
///
/// An Error has one of these codes: outside-folder, no-folder (of the file), file-exists (and it was not
/// asked to overwrite it), not-a-saved-run (nothing else is overwritten), file-in-use (it is the run's
/// journal).
Result<std::filesystem::path> save_place(const std::string& folder, const SaveRun& save,
                                         const std::string& journal);

}  // namespace roboss
