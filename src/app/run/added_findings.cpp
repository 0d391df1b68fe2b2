// See added_findings.h.
#include "app/run/added_findings.h"

#include <fmt/format.h>

#include "app/output/findings.h"
#include "app/run/run.h"

namespace roboss {
namespace {

std::string with_name(std::string text, const std::string& file, const std::string& name) {
    for (std::size_t at = 0; (at = text.find(file, at)) != std::string::npos; at += name.size())
        text.replace(at, file.size(), name);
    return text;
}

}  // namespace

Diagnostics under_name(const Diagnostics& found, const std::string& file, const std::string& name) {
    Diagnostics named;
    for (Diagnostic d : found.items()) {
        d.where.file = with_name(std::move(d.where.file), file, name);
        d.message = with_name(std::move(d.message), file, name);
        d.remedy = with_name(std::move(d.remedy), file, name);
        named.add(std::move(d));
    }
    return named;
}

std::vector<std::string> told_findings(const Diagnostics& found) {
    constexpr std::size_t kShown = 20;
    std::vector<std::string> lines;
    for (const Severity severity : {Severity::kError, Severity::kWarning, Severity::kNote})
        for (const FindingGroup& group : group_findings(found, severity))
            if (is_told_by_run(*group.first)) lines.push_back(to_text(group));
    if (lines.size() <= kShown) return lines;
    const std::size_t more = lines.size() - kShown;
    lines.resize(kShown);
    lines.push_back(
        fmt::format("{} more {}; `roboss check` prints all", more, more == 1 ? "finding" : "findings"));
    return lines;
}

}  // namespace roboss
