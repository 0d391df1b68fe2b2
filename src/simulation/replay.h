// Replay: steps a journal's run again without its Clients, and compares it with the checkpoints.
#pragma once

#include <functional>
#include <memory>

#include "journal/journal.h"
#include "simulation/simulation.h"

namespace roboss {

/// How a run is stepped again. No result depends on it.
struct ReplayOptions {
    unsigned threads = 1;  // that step islands
    Tick window = 0;       // synchronization interval in ticks; 0: adaptive
};

/// A Simulation at this checkpoint, whose orders are those of the branch up to `until`. An Error if the
/// journal's entries cannot be read.
Result<std::unique_ptr<Simulation>> replay_from(const Journal& journal, const Branch& branch,
                                                const CheckpointEntry& entry,
                                                const std::shared_ptr<const Model>& model, Tick until,
                                                const ReplayOptions& options);

/// The same, run to `tick` from the nearest checkpoint before; it can go on to `until`. An Error also if
/// there is no checkpoint at or before `tick`.
Result<std::unique_ptr<Simulation>> replay_at(const Journal& journal, const Branch& branch,
                                              const std::shared_ptr<const Model>& model, Tick tick,
                                              Tick until, const ReplayOptions& options);

/// From one checkpoint where a branch's hash is known to the next.
struct Stretch {
    BranchId branch = 0;                         ///< of the journal
    Tick from = 0,                               ///< tick of the checkpoint that it begins at
        until = 0;                               ///< tick at which the hashes are compared
    std::uint64_t kept = 0,                      ///< hash of the world at `until` in the journal
        found = 0;                               ///< hash of the world at `until` when stepped again
    BranchId next = 0;                           ///< that begins at `until` with the hash `kept`; 0: none
    bool good() const { return kept == found; }  ///< stepping again gave the same state
};

/// All stretches of the branch: how it begins where it left another, if that has the same Model; then from
/// its first checkpoint to the last tick whose hash is known. Nothing is stepped yet: `found` is 0.
std::vector<Stretch> stretches_of(const Journal& journal, const Branch& branch);

/// Watches the steps of a verification: gets the stretch and its present tick; false ends it.
using VerifyWatch = std::function<bool(const Stretch&, Tick)>;

/// Steps every stretch of the branch again, each from its checkpoint, so that one fault does not hide the
/// next. Calls `tell` after each. An Error, "interrupted": `watch` has ended it.
Result<std::vector<Stretch>> verify(const Journal& journal, const Branch& branch,
                                    const ReplayOptions& options,
                                    const std::function<void(const Stretch&)>& tell = {},
                                    const VerifyWatch& watch = {});

}  // namespace roboss
