// Faults of one line of a file of orders.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/diagnostics.h"
#include "core/similar.h"

namespace roboss {

/// A fault in one line; caught where lines are read, where it becomes a diagnostic.
struct LineFault : std::runtime_error {
    LineFault(const std::string& message, std::string what_to_do, Severity how_bad = Severity::kError)
        : std::runtime_error(message), remedy(std::move(what_to_do)), severity(how_bad) {}
    std::string remedy;
    Severity severity;
};

/// The faults of one line, those of robots that refuse it for the same cause as one.
class LineFaults {
  public:
    /// `robot`: the one that refuses the line; empty: the line itself is wrong.
    void add(const LineFault& fault, const std::string& robot) {
        const std::string pattern = pattern_of(fault.what());
        const auto same = std::ranges::find_if(kinds_, [&](const Kind& kind) {
            return kind.pattern == pattern && kind.fault.severity == fault.severity;
        });
        Kind& kind = same != kinds_.end() ? *same : kinds_.emplace_back(Kind{pattern, fault, {}});
        kind.robots.push_back(robot);
    }
    /// True if any is an error: then the line gives no order.
    bool refuse() const {
        return std::ranges::any_of(kinds_,
                                   [](const Kind& kind) { return kind.fault.severity == Severity::kError; });
    }
    void report(const SourceLocation& where, Diagnostics& diagnostics) const {
        for (const Kind& kind : kinds_)
            diagnostics.add(
                {kind.fault.severity, where, "bad-order", message_of(kind), kind.fault.remedy, false});
    }

  private:
    struct Kind {
        std::string pattern;
        LineFault fault;
        std::vector<std::string> robots;
    };

    static std::string message_of(const Kind& kind) {
        constexpr std::size_t kNamed = 3;
        const std::size_t count = kind.robots.size();
        if (count == 1) return kind.fault.what();
        std::string names;
        for (std::size_t i = 0; i < std::min(count, kNamed); ++i)
            names += (i == 0 ? "'" : ", '") + kind.robots[i] + "'";
        if (count > kNamed) names += ", ...";
        return std::to_string(count) + " robots refuse it (" + names + "): " + kind.fault.what();
    }

    std::vector<Kind> kinds_;
};

}  // namespace roboss
