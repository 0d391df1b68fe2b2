// Lineage: the history that leads to the end of a branch. A branch knows only what happened after it left its
// parent, so its history is a part of each ancestor, up to where the next branch left it, and then its own.
// Every reader of a journal goes by this: replays, recordings, comparisons, exports, the viewer's page.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/types.h"

namespace roboss {

using BranchId = std::int64_t;  // 1, 2, 3 ...; 0: none

/// A branch of the file, and what of it can be restored.
struct BranchSpan {
    BranchId id = 0, parent = 0;
    Tick begin = 0, first = 0, end = 0;  // where it left its parent; its first checkpoint; its last tick
    std::uint64_t model_hash = 0;
    std::string reason;
};

class Lineage {
  public:
    /// A branch's share: the ticks from `from` up to `until`. The state at `until` is that of the next part,
    /// which may have other robots; the last part has its `until`, too.
    struct Part {
        BranchId branch = 0;
        Tick from = 0, until = 0;
        friend bool operator==(const Part&, const Part&) = default;
    };

    /// `spans`: all branches of the file, with `branch` among them. The lineage begins at the first tick from
    /// which on nothing is missing: earlier ones may have been pruned.
    static Lineage of(std::span<const BranchSpan> spans, BranchId branch);

    /// Oldest first, without gaps; never empty. Branches that were left at once have no part.
    const std::vector<Part>& parts() const { return parts_; }
    BranchId branch() const { return parts_.back().branch; }
    Tick first() const { return parts_.front().from; }
    Tick last() const { return parts_.back().until; }
    /// The part that holds the tick; null: the lineage does not have it.
    const Part* at(Tick tick) const;
    /// The part behind one of parts(); null: it is the last.
    const Part* after(const Part& part) const;

    /// In words, with times: "branch 1 to 1 s, branch 3 to 2.5 s".
    std::string text(double dt_s) const;

  private:
    std::vector<Part> parts_;
};

/// A time for messages: up to nine digits, without trailing zeros: "2.5 s".
std::string time_text(Tick tick, double dt_s);

}  // namespace roboss
