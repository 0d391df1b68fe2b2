// See numbers.h.
#include "app/commands/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace roboss {
namespace {

std::optional<std::int64_t> read_whole(const std::string& text) {
    std::int64_t value = 0;
    const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(begin, end, value);
    return error == std::errc{} && stop == end ? std::optional(value) : std::nullopt;
}

template <class Fits>
CLI::Validator finite_number(const std::string& kind, const std::string& rule, Fits fits) {
    return CLI::Validator(
        [rule, fits](std::string& text) -> std::string {
            const std::optional<double> value = read_number(text);
            if (!value) return "'" + text + "' is not a number";
            return fits(*value) ? std::string() : "'" + text + "' is not " + rule;
        },
        kind);
}

}  // namespace

CLI::Validator positive_number() {
    return finite_number("POSITIVE", "above 0", [](double x) { return x > 0; });
}

CLI::Validator non_negative_number() {
    return finite_number("NUMBER", "0 or above", [](double x) { return x >= 0; });
}

CLI::Validator whole_number(std::int64_t low, std::int64_t high) {
    return CLI::Validator(
        [low, high](std::string& text) -> std::string {
            const std::optional<std::int64_t> value = read_whole(text);
            if (!value) return "'" + text + "' is not a whole number";
            return *value >= low && *value <= high
                       ? std::string()
                       : fmt::format("'{}' is not from {} to {}", text, low, high);
        },
        fmt::format("{}..{}", low, high));
}

CLI::Validator number_or(const std::vector<std::string>& words, double low, double high) {
    const std::string known = fmt::format("{}", fmt::join(words, " or "));
    return CLI::Validator(
        [=](std::string& text) -> std::string {
            if (std::ranges::find(words, text) != words.end()) return {};
            const std::optional<double> value = read_number(text);
            if (!value) return "'" + text + "' is neither a number nor " + known;
            if (!(*value > 0)) return "'" + text + "' is not above 0";
            return *value >= low && *value <= high
                       ? std::string()
                       : fmt::format("'{}' is not from {:g} to {:g}", text, low, high);
        },
        fmt::format("NUMBER|{}", fmt::join(words, "|")));
}

}  // namespace roboss
