// Names of moments, and where they are.
#include "app/journal_place.h"

#include <filesystem>

#include "app/orders_file.h"

namespace roboss {
namespace {

/// The number behind the last `mark`, which is cut off with it; nothing if there is none.
Result<std::optional<double>> cut_number(std::string& text, char mark, const char* what) {
    const std::size_t at = text.rfind(mark);
    if (at == std::string::npos || text.find('/', at) != std::string::npos) return std::optional<double>{};
    const std::string number = text.substr(at + 1);
    try {
        std::size_t used = 0;
        const double value = std::stod(number, &used);
        if (used == number.size() && value >= 0 && value < 1e12) {
            text.resize(at);
            return std::optional<double>(value);
        }
    } catch (const std::exception&) {
    }
    return Error{"'" + number + "' in '" + text + "' is not a " + what,
                 "write FILE, FILE@TIME or FILE#BRANCH@TIME, with the time in s"};
}

}  // namespace

Result<JournalPlace> parse_place(const std::string& text) {
    JournalPlace place;
    place.file = text;
    std::error_code none;
    if (std::filesystem::exists(text, none)) return place;
    Result<std::optional<double>> time = cut_number(place.file, '@', "time");
    if (!time) return time.error();
    place.time_s = time.value();
    if (std::filesystem::exists(place.file, none)) return place;
    Result<std::optional<double>> branch = cut_number(place.file, '#', "branch");
    if (!branch) return branch.error();
    if (branch.value()) place.branch = static_cast<BranchId>(*branch.value());
    return place;
}

Result<Moment> find_moment(const Journal& journal, const JournalPlace& place) {
    Result<Branch> named = journal.branch(place.branch);
    if (!named) return named.error();
    Moment moment{named.value(), nullptr, named.value().end};
    Result<std::shared_ptr<const Model>> model = journal.model(moment.branch);
    if (!model) return model.error();
    if (place.time_s) {  // the step is the same for all branches of a journal
        moment.tick = tick_at(*place.time_s, model.value()->dt_s);
        moment.branch = journal.holder_of(moment.branch, moment.tick);
        model = journal.model(moment.branch);
        if (!model) return model.error();
    }
    moment.model = model.value();
    return moment;
}

Result<OpenedMoment> open_moment(const std::string& text) {
    Result<JournalPlace> place = parse_place(text);
    if (!place) return place.error();
    Result<Journal> journal = Journal::open(place.value().file);
    if (!journal) return journal.error();
    Result<Moment> moment = find_moment(journal.value(), place.value());
    if (!moment) return moment.error();
    return OpenedMoment{std::move(place).value(), std::move(journal).value(), std::move(moment).value()};
}

}  // namespace roboss
