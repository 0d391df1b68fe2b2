// See findings.h.
#include "app/output/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

namespace roboss {
namespace {

/// The text without what stands in quotes, and without digits: equal for "robot 'a' has 3 wheels" and "robot
/// 'b' has 4".
std::string pattern_of(const std::string& text) {
    std::string pattern;
    bool in_quotes = false;
    for (const char c : text) {
        if (c == '\'') in_quotes = !in_quotes;
        if (!in_quotes && std::isdigit(static_cast<unsigned char>(c)) == 0) pattern += c;
    }
    return pattern;
}

}  // namespace

std::vector<FindingGroup> group_findings(const Diagnostics& diagnostics, Severity severity) {
    std::vector<FindingGroup> groups;
    std::map<std::pair<std::string, std::string>, std::size_t> index;
    for (const Diagnostic& d : diagnostics.items()) {
        if (d.severity != severity) continue;
        const auto [place, is_new] = index.try_emplace({d.code, pattern_of(d.message)}, groups.size());
        if (is_new)
            groups.push_back({&d, 0});
        else
            ++groups[place->second].more;
    }
    return groups;
}

std::string to_text(const FindingGroup& group) {
    std::string text = to_text(*group.first);
    if (group.more == 0) return text;
    const std::size_t end = std::min(text.find('\n'), text.size());
    return text.insert(end, fmt::format(" (and {} more like it)", group.more));
}

}  // namespace roboss
