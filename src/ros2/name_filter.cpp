// See name_filter.h.
#include "ros2/name_filter.h"

#include <regex.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace roboss::ros2 {

struct NameFilter::Compiled {
    regex_t regex{};
    Compiled() = default;
    ~Compiled() { regfree(&regex); }
    Compiled(const Compiled&) = delete;
    Compiled& operator=(const Compiled&) = delete;
};

namespace {

Error refused(const std::string& why) {
    return {"the filter " + why, "give a short POSIX extended regular expression", "bad-filter"};
}

/// The product of the counts of all repetitions, which bounds what the compiled expression takes.
std::size_t repeats_of(const std::string& expression) {
    std::size_t product = 1;
    for (std::size_t at = expression.find('{'); at != std::string::npos; at = expression.find('{', at + 1)) {
        std::size_t largest = 1;
        for (std::size_t i = at + 1; i < expression.size() && expression[i] != '}'; ++i) {
            std::size_t count = 0;
            const char* const end = expression.data() + expression.size();
            const auto [stop, problem] = std::from_chars(expression.data() + i, end, count);
            if (problem == std::errc::result_out_of_range) return NameFilter::kMostRepeats + 1;
            if (problem != std::errc()) continue;
            largest = std::max(largest, count);
            i = static_cast<std::size_t>(stop - expression.data()) - 1;
        }
        if (largest > NameFilter::kMostRepeats) return largest;
        product *= largest;
        if (product > NameFilter::kMostRepeats) return product;
    }
    return product;
}

bool has_back_reference(const std::string& expression) {
    for (std::size_t i = 0; i + 1 < expression.size(); ++i) {
        if (expression[i] != '\\') continue;
        ++i;  // the character behind it belongs to it
        if (expression[i] >= '1' && expression[i] <= '9') return true;
    }
    return false;
}

}  // namespace

Result<NameFilter> NameFilter::of(const std::string& expression) {
    NameFilter filter;
    if (expression.empty()) return filter;
    if (expression.size() > kLongest)
        return refused("is longer than " + std::to_string(kLongest) + " characters");
    if (has_back_reference(expression)) return refused("has back references");
    if (repeats_of(expression) > kMostRepeats)
        return refused("repeats more than " + std::to_string(kMostRepeats) + " times");
    const auto compiled = std::make_shared<Compiled>();
    if (const int problem = regcomp(&compiled->regex, expression.c_str(), REG_EXTENDED | REG_NOSUB)) {
        std::array<char, 200> text{};
        regerror(problem, &compiled->regex, text.data(), text.size());
        return refused(std::string("is no regular expression: ") + text.data());
    }
    filter.compiled_ = compiled;
    return filter;
}

bool NameFilter::fits(const std::string& name) const {
    return !compiled_ || regexec(&compiled_->regex, name.c_str(), 0, nullptr, 0) == 0;
}

}  // namespace roboss::ros2
