// Paths are compared after links have been followed, so that no link leads out of the folder.
#include "app/run/save_place.h"

#include <algorithm>

#include "journal/saved_run.h"

namespace roboss {
namespace {

namespace fs = std::filesystem;

/// Whether `inner` is `outer` or lies below it; both are canonical.
bool lies_in(const fs::path& inner, const fs::path& outer) {
    return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

Error outside(const std::string& file, const fs::path& folder) {
    return {"'" + file + "' is not below " + folder.string(),
            "name a file below that folder, or start the run with another --save-folder", "outside-folder"};
}

}  // namespace

Result<fs::path> save_place(const std::string& folder, const SaveRun& save,
                            const std::vector<std::string>& in_use) {
    std::error_code error;
    const fs::path root = fs::canonical(folder.empty() ? fs::path(".") : fs::path(folder), error);
    if (error)
        return Error{"the folder " + folder + " of --save-folder is gone", "create it again", "no-folder"};
    const fs::path wanted = root / save.file;  // an absolute path stays as it is
    const fs::path name = wanted.filename();
    if (save.file.find('\0') != std::string::npos || name.empty() || name == "." || name == "..")
        return Error{"'" + save.file + "' does not name a file", "give the name of a file", "outside-folder"};
    if (!lies_in(fs::weakly_canonical(wanted.parent_path(), error), root) || error)
        return outside(save.file, root);
    const fs::path parent = fs::canonical(wanted.parent_path(), error);
    if (error)
        return Error{"there is no folder for '" + save.file + "' below " + root.string(),
                     "create it, or save in one that exists", "no-folder"};
    const fs::path file = parent / name;
    const fs::file_status found = fs::symlink_status(file, error);
    if (!fs::exists(found)) return file;
    if (!save.overwrite)
        return Error{file.string() + " exists", "give another name, or ask to overwrite it", "file-exists"};
    for (const std::string& used : in_use)
        if (fs::equivalent(file, used, error))
            return Error{file.string() + " is a file of this run: " + used, "give another name",
                         "file-in-use"};
    if (!fs::is_regular_file(found))
        return Error{file.string() + " is not a saved run, and nothing else is overwritten",
                     "give another name, or remove the file yourself", "not-a-saved-run"};
    if (Result<> may = may_save_to(file.string()); !may) return may.error();
    return file;
}

}  // namespace roboss
