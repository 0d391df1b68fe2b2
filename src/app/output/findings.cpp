// See findings.h.
#include "app/output/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "core/similar.h"

namespace roboss {

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
