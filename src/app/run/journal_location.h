// FILE[#BRANCH][@TIME]: a point in time in a journal or save file, as the command line names it.
#pragma once

#include <optional>
#include <string>

#include "journal/journal.h"

namespace roboss {

struct JournalLocation {
    std::string file;
    std::optional<BranchId> branch;  // none: the newest
    std::optional<double> time_s;    // none: the end
};

/// "run.journal#2@12.5". A file that exists under the whole name is that file.
Result<JournalLocation> parse_location(const std::string& text);

/// The lineage of the branch that was named, the branch of it that holds the point in time, and the tick.
struct JournalTime {
    Lineage lineage;
    Branch branch;
    std::shared_ptr<const Model> model;
    Tick tick = 0;
};
Result<JournalTime> find_time(const Journal& journal, const JournalLocation& location);

/// The file that the text names, opened, and the point in time in it.
struct OpenedJournalTime {
    JournalLocation location;
    Journal journal;
    JournalTime time;
};
Result<OpenedJournalTime> open_location(const std::string& text);

/// For people, if a command went through more than one branch: "goes through branch 1 to 1 s, branch 2 to
/// 2.5 s"; else empty.
std::string ways(const Lineage& lineage, double dt_s);

}  // namespace roboss
