// FILE[#BRANCH][@TIME]: a moment in a journal or save file, as the command line names it.
#pragma once

#include <optional>
#include <string>

#include "journal/journal.h"

namespace roboss {

struct JournalPlace {
    std::string file;
    std::optional<BranchId> branch;  // none: the youngest
    std::optional<double> time_s;    // none: the end
};

/// "run.journal#2@12.5". A file that exists under the whole name is that file.
Result<JournalPlace> parse_place(const std::string& text);

/// The branch that has this moment (an ancestor of the one named, if that begins later), and the tick.
struct Moment {
    Branch branch;
    std::shared_ptr<const Model> model;
    Tick tick = 0;
};
Result<Moment> find_moment(const Journal& journal, const JournalPlace& place);

/// The file that the text names, opened, and the moment in it.
struct OpenedMoment {
    JournalPlace place;
    Journal journal;
    Moment moment;
};
Result<OpenedMoment> open_moment(const std::string& text);

}  // namespace roboss
