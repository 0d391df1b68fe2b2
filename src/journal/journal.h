// Journal: reads a run's file (SQLite): checkpoints, the log of orders, the Models, and branches, of which
// each has left its parent at a tick. It believes nothing that it has not checked, and writes nothing.
//
// A branch begins with a checkpoint of its own and with the orders that were still to come, so what it holds
// depends on no other. Before its first tick its history is that of its parent. A branch may have another
// Model than its parent (robots were added, the accuracy changed).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "journal/database.h"
#include "journal/saved_run.h"

namespace roboss {

using BranchId = std::int64_t;  // 1, 2, 3 ...; 0: none

struct Branch {
    BranchId id = 0, parent = 0;
    Tick tick = 0;  // where it begins
    std::uint64_t model_hash = 0, seed = 0;
    std::string world_file, reason;
    Tick committed = 0;      // the last tick known to be committed
    std::uint64_t hash = 0;  // of the world there; 0: not known
    Tick end = 0;            // the log is complete up to here
    std::size_t checkpoints = 0, orders = 0;
    std::uint64_t bytes = 0;  // of checkpoints and log
};

struct CheckpointEntry {
    BranchId branch = 0;
    Tick tick = 0;
    std::uint64_t hash = 0;  // of the world there
};

struct StoredCheckpoint {
    std::vector<RobotState> states;
    ClientMemory memory;
};

class Journal {
  public:
    /// `thorough`: every page is looked at, however large the file is.
    static Result<Journal> open(const std::string& path, bool thorough = false);

    const std::string& path() const { return path_; }
    const std::string& version() const { return version_; }
    const std::vector<Branch>& branches() const { return branches_; }
    /// The branch of this number; the youngest if none is given.
    Result<Branch> branch(std::optional<BranchId> id = {}) const;
    /// The branch, or an ancestor of it, that has this tick.
    Branch holder_of(Branch branch, Tick tick) const;
    Result<std::shared_ptr<const Model>> model(const Branch& branch) const;

    /// Those of the branch, ascending by tick.
    std::vector<CheckpointEntry> checkpoints(const Branch& branch) const;
    Result<StoredCheckpoint> checkpoint(const CheckpointEntry& entry, const Model& model) const;
    /// Orders that apply at `from` or later and were given before `until`, in canonical order; replies for
    /// observations, and notes, of the ticks between; all Clients.
    Result<LogBatch> log(const Branch& branch, Tick from, Tick until) const;

    /// To be at `tick` of this branch (not of an ancestor): the nearest checkpoint before, and the log up to
    /// `tick`.
    Result<SavedRun> run_at(const Branch& branch, const Model& model, Tick tick) const;
    /// run_at() from a given checkpoint.
    Result<SavedRun> run_from(const Branch& branch, const CheckpointEntry& entry, const Model& model,
                              Tick until) const;
    /// To go on with the branch from a checkpoint, after a crash: besides the log up to its end, what Clients
    /// said after that. Their words were acknowledged, so they do not say them again, and the ticks that they
    /// have seen come again as they were.
    Result<SavedRun> resume_from(const Branch& branch, const CheckpointEntry& entry,
                                 const Model& model) const;

    /// The last number of its log, and the hash that ties the next entry to it; for the writer.
    struct Tail {
        std::int64_t serial = 0;
        std::uint64_t chain = 0;
    };
    Tail tail(BranchId branch) const;
    /// Looks at every row, checkpoint and Model; the first fault. (open() leaves most to when it is used.)
    Result<> inspect() const;

  private:
    Result<SavedRun> run_with(const Branch& branch, const CheckpointEntry& entry, const Model& model,
                              Tick until, Tick said_until) const;
    Error damaged(const std::string& what) const;
    Result<> read_meta();
    Result<> read_branches();
    Result<> read_log_heads();
    Result<> read_checkpoint_entries();

    std::string path_, version_;
    std::optional<Database> db_;
    std::vector<Branch> branches_;
    std::vector<CheckpointEntry> checkpoints_;  // of all branches, by (branch, tick)
    std::map<BranchId, Tail> tails_;
};

/// Whether the Model of this branch is the one given; an Error in words that help.
Result<> check_world(const Journal& journal, const Branch& branch, const Model& model);

}  // namespace roboss
