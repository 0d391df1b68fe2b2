// A number and a unit.
#include "app/run/journal_limit.h"

#include <cmath>

namespace roboss {

std::optional<JournalLimit> parse_journal_limit(const std::string& text) {
    if (text == "all") return JournalLimit{};
    struct Unit {
        const char* name;
        double factor;
        bool is_time;
    };
    constexpr Unit kUnits[] = {{"s", 1, true},     {"min", 60, true},  {"h", 3600, true},
                               {"kB", 1e3, false}, {"MB", 1e6, false}, {"GB", 1e9, false}};
    std::size_t used = 0;
    double value = 0;
    try {
        value = std::stod(text, &used);
    } catch (const std::exception&) {
        return std::nullopt;
    }
    if (!std::isfinite(value) || value <= 0 || value > 1e12) return std::nullopt;
    for (const Unit& unit : kUnits) {
        if (text.substr(used) != unit.name) continue;
        JournalLimit limit;
        if (unit.is_time) limit.seconds = value * unit.factor;
        if (!unit.is_time) limit.bytes = static_cast<std::uint64_t>(value * unit.factor);
        return limit;
    }
    return std::nullopt;
}

}  // namespace roboss
