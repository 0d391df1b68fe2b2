// Findings about input files as people read them: errors first, and one line for findings that differ in
// names or numbers only.
#pragma once

#include <string>
#include <vector>

#include "core/diagnostics.h"

namespace roboss {

/// A finding and the number of others like it.
struct FindingGroup {
    const Diagnostic* first = nullptr;  ///< the one to show
    std::size_t more = 0;  ///< others whose texts differ in quoted names, numbers and places only
};

/// Findings of this severity, in groups, in the order of the first of each.
std::vector<FindingGroup> group_findings(const Diagnostics& diagnostics, Severity severity);

/// "file:line: warning: message [code] (and 11 more like it)\n    remedy"
std::string to_text(const FindingGroup& group);

}  // namespace roboss
