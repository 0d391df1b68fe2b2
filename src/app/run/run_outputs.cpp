// The outputs of all options.
#include "app/run/run_outputs.h"

#include "app/run/journal_location.h"
#include "core/output_check.h"
#include "journal/saved_run.h"

namespace roboss {

std::vector<std::string> inputs_of(const RunOptions& o) {
    std::vector<std::string> files{o.world, o.orders, o.journal};
    files.insert(files.end(), o.clients.begin(), o.clients.end());
    for (const std::string& place : {o.from, o.replay})
        if (Result<JournalLocation> location = parse_location(place); location && !place.empty())
            files.push_back(location.value().file);
    std::erase(files, std::string());
    return files;
}

std::string_view reading_kind(const std::string& file) {
    const auto ends = [&](std::string_view ending) { return file.ends_with(ending); };
    return ends(".png") ? "png" : ends(".npy") ? "npy" : ends(".pcd") ? "pcd" : ends(".csv") ? "reading" : "";
}

Result<> check_outputs(const RunOptions& o) {
    OutputCheck check;
    for (const std::string& file : inputs_of(o)) check.reads(file);
    check.writes("--trace", o.trace, "trace");
    check.writes("--contacts", o.contacts, "contacts");
    check.writes("--json", o.json, "summary");
    check.writes("--log", o.log, "log");
    check.writes("--picture", o.paths_picture, "svg");
    check.writes("--output", o.snapshot.file, "png");
    if (const std::string_view kind = reading_kind(o.sense.file); !kind.empty())
        check.writes("--output", o.sense.file, kind);
    check.writes("--save", o.save, "saved state");
    if (Result<> fine = check.check(); !fine) return fine;
    return o.save.empty() ? Result<>(Ok{}) : may_save_to(o.save);
}

}  // namespace roboss
