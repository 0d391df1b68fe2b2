// Keeping a journal's file small: what is older than a limit is removed from it, in one transaction, so that
// what remains has no gap and can be verified.
//
// Age is counted in recorded time, branch after branch as they were written: a run of 100 s that was rewound
// to 40 s and ran to 70 s has recorded 130 s. A branch begins at its first checkpoint that is left. Entries
// of removed rows that are still needed (names of Clients, orders that apply later) move to the row of the
// branch in the table `bases`.
#pragma once

#include <optional>
#include <vector>

#include "journal/journal.h"

namespace roboss {

/// How much of a run its journal keeps; 0: all.
struct JournalKeep {
    Tick ticks = 0;           // of recorded time
    std::uint64_t bytes = 0;  // of the file
    bool limited() const { return ticks > 0 || bytes > 0; }
};

/// What is to be removed, or was.
struct JournalPruning {
    /// A branch that begins later than before.
    struct Cut {
        BranchId branch = 0;
        Tick first = 0;  // tick of its first checkpoint that stays
    };
    std::vector<BranchSpan> dropped;    // whole branches
    std::vector<Cut> cuts;              // at most one of each branch
    std::vector<std::uint64_t> models;  // hashes of Models that no other branch has
    bool empty() const { return dropped.empty() && cuts.empty(); }
};

/// Bytes of the file that are in use.
std::uint64_t used_bytes(const Database& db);

/// What lies beyond the limit; at least the last checkpoint of the last branch stays. `spans`: all branches,
/// ascending by id. `used`: used_bytes().
JournalPruning plan_pruning(const Database& db, const std::vector<BranchSpan>& spans, const JournalKeep& keep,
                            std::uint64_t used);

/// Removes it, in one transaction.
Result<> prune_journal(Database& db, const JournalPruning& pruning);

}  // namespace roboss
