// AGE|SIZE: how much of a run its journal keeps, as the command line names it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace roboss {

/// One of the two, or neither: everything is kept.
struct JournalLimit {
    std::optional<double> seconds;  // recorded, simulated time
    std::optional<std::uint64_t> bytes;
};

/// "90s", "10min", "2h", "500MB", "2GB" or "all". Nullopt: it is none of these.
std::optional<JournalLimit> parse_journal_limit(const std::string& text);

}  // namespace roboss
