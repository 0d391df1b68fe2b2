// Parses journal locations, and finds them in the file.
#include "app/run/journal_location.h"

#include <filesystem>

#include "app/worlds/orders_file.h"
#include "core/number_text.h"

namespace roboss {
namespace {

/// Cuts off and returns the number behind the last `mark`; nullopt if there is none.
Result<std::optional<double>> cut_number(std::string& text, char mark, const char* what) {
    const std::size_t at = text.rfind(mark);
    if (at == std::string::npos || text.find('/', at) != std::string::npos) return std::optional<double>{};
    const std::string number = text.substr(at + 1);
    if (const auto value = read_number(number); value && *value >= 0 && *value < 1e12) {
        text.resize(at);
        return value;
    }
    return Error{"'" + number + "' in '" + text + "' is not a " + what,
                 "write FILE, FILE@TIME or FILE#BRANCH@TIME, with the time in s", "bad-location"};
}

}  // namespace

Result<JournalLocation> parse_location(const std::string& text) {
    JournalLocation location;
    location.file = text;
    std::error_code none;
    if (std::filesystem::exists(text, none)) return location;
    Result<std::optional<double>> time = cut_number(location.file, '@', "time");
    if (!time) return time.error();
    location.time_s = time.value();
    if (std::filesystem::exists(location.file, none)) return location;
    Result<std::optional<double>> branch = cut_number(location.file, '#', "branch");
    if (!branch) return branch.error();
    if (branch.value()) location.branch = static_cast<BranchId>(*branch.value());
    return location;
}

Result<JournalTime> find_time(const Journal& journal, const JournalLocation& location) {
    Result<Branch> named = journal.branch(location.branch);
    if (!named) return named.error();
    JournalTime time{journal.lineage(named.value()), named.value(), nullptr, named.value().end};
    Result<std::shared_ptr<const Model>> model = journal.model(time.branch);
    if (!model) return model.error();
    if (location.time_s) {  // the step is the same for all branches of a journal
        time.tick = tick_at(*location.time_s, model.value()->dt_s);
        Result<Branch> holder = journal.holder(time.lineage, time.tick, model.value()->dt_s);
        if (!holder) return holder.error();
        time.branch = std::move(holder).value();
        model = journal.model(time.branch);
        if (!model) return model.error();
    }
    time.model = model.value();
    return time;
}

Result<OpenedJournalTime> open_location(const std::string& text) {
    Result<JournalLocation> location = parse_location(text);
    if (!location) return location.error();
    Result<Journal> journal = Journal::open(location.value().file);
    if (!journal) return journal.error();
    Result<JournalTime> time = find_time(journal.value(), location.value());
    if (!time) return time.error();
    return OpenedJournalTime{std::move(location).value(), std::move(journal).value(),
                             std::move(time).value()};
}

std::string ways(const Lineage& lineage, double dt_s) {
    return lineage.parts().size() > 1 ? "goes through " + lineage.text(dt_s) : std::string();
}

}  // namespace roboss
