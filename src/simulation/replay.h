// Replay: steps a journal's run again without its Clients, and compares it with the checkpoints.
#pragma once

#include <functional>
#include <memory>

#include "journal/journal.h"
#include "simulation/simulation.h"

namespace roboss {

struct ReplayOptions {
    unsigned threads = 1;
    Tick window = 0;  // 0: adaptive
};

/// A Simulation at this checkpoint, whose orders are those of the branch up to `until`.
Result<std::unique_ptr<Simulation>> replay_from(const Journal& journal, const Branch& branch,
                                                const CheckpointEntry& entry,
                                                const std::shared_ptr<const Model>& model, Tick until,
                                                const ReplayOptions& options);

/// The same, run to `tick` from the nearest checkpoint before; it can go on to `until`.
Result<std::unique_ptr<Simulation>> replay_at(const Journal& journal, const Branch& branch,
                                              const std::shared_ptr<const Model>& model, Tick tick,
                                              Tick until, const ReplayOptions& options);

/// From one checkpoint where a branch's hash is known to the next.
struct Stretch {
    BranchId branch = 0;
    Tick from = 0, until = 0;
    std::uint64_t kept = 0, found = 0;
    bool good() const { return kept == found; }
};

/// Steps every stretch of the branch again, from its first checkpoint to the last tick whose hash is known;
/// each from its checkpoint, so that one fault does not hide the next. Calls `tell` after each.
Result<std::vector<Stretch>> verify(const Journal& journal, const Branch& branch,
                                    const ReplayOptions& options,
                                    const std::function<void(const Stretch&)>& tell = {});

}  // namespace roboss
