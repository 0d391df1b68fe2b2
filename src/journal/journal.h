// Journal: reads a run's file (SQLite): checkpoints, the log of orders, the Models, and branches, of which
// each has left its parent at a tick. It verifies everything that it reads, and writes nothing.
//
// A branch begins with a checkpoint of its own and with the orders still to be applied, so it is independent
// of the other branches. Before its first tick its history is that of its parent. A branch may have another
// Model than its parent (robots were added, the accuracy changed).
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "journal/database.h"
#include "journal/lineage.h"
#include "journal/saved_run.h"

namespace roboss {

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
    Tick first = 0;           // its first checkpoint: later than `tick` once the branch is pruned
    BranchSpan span() const { return {id, parent, tick, first, end, model_hash, reason}; }
};

/// A named moment.
struct Bookmark {
    std::int64_t id = 0;  // 1, 2, 3 ...
    BranchId branch = 0;
    Tick tick = 0;
    std::string name;
    friend bool operator==(const Bookmark&, const Bookmark&) = default;
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
    /// `thorough`: checks every page, however large the file is.
    static Result<Journal> open(const std::string& path, bool thorough = false);
    /// Of a journal that this process writes: the pages of the file are not checked.
    static Result<Journal> open_own(const std::string& path);
    /// Whether open() checks every page of a file of this size.
    static bool is_small(const std::string& path);
    /// Reads what has been written since: new branches, checkpoints, log. After an Error the journal must not
    /// be used.
    Result<> refresh();

    const std::string& path() const { return path_; }
    const std::string& version() const { return version_; }
    /// Ascending by id. Branches that were pruned are missing.
    const std::vector<Branch>& branches() const { return branches_; }
    const std::vector<Bookmark>& bookmarks() const { return bookmarks_; }
    /// The branch of this number; the youngest if none is given.
    Result<Branch> branch(std::optional<BranchId> id = {}) const;
    /// Null: the file does not have it.
    const Branch* find(BranchId id) const;
    std::vector<BranchSpan> spans() const;
    Lineage lineage(const Branch& branch) const { return Lineage::of(spans(), branch.id); }
    /// The branch of this lineage that holds the tick. An Error, "no-such-time", says which ticks the lineage
    /// has, and which branch has this one.
    Result<Branch> holder(const Lineage& lineage, Tick tick, double dt_s) const;
    /// Hash of the Model of the world file with which the history of the branch began, pruned or not; also
    /// that of a saved run whose robots had been changed.
    std::uint64_t world_hash(const Branch& branch) const;
    Result<std::shared_ptr<const Model>> model(const Branch& branch) const;

    /// Those of the branch, ascending by tick.
    std::vector<CheckpointEntry> checkpoints(const Branch& branch) const;
    /// The last one of the branch at or before the tick; null: there is none.
    const CheckpointEntry* checkpoint_before(const Branch& branch, Tick tick) const;
    Result<StoredCheckpoint> checkpoint(const CheckpointEntry& entry, const Model& model) const;
    /// Orders that apply at `from` or later and were given before `until`, in canonical order; replies for
    /// observations, and notes, of the ticks between; all Clients.
    Result<LogBatch> log(const Branch& branch, Tick from, Tick until) const;

    /// To restore `tick` of this branch (not of an ancestor): the nearest checkpoint before it, and the log
    /// up to it.
    Result<SavedRun> run_at(const Branch& branch, const Model& model, Tick tick) const;
    /// run_at() from a given checkpoint.
    Result<SavedRun> run_from(const Branch& branch, const CheckpointEntry& entry, const Model& model,
                              Tick until) const;
    /// To continue the branch from a checkpoint after a crash: the log up to its end, and later replies of
    /// Clients. These were acknowledged, so Clients do not send them again, and ticks that they have observed
    /// are repeated exactly.
    Result<SavedRun> resume_from(const Branch& branch, const CheckpointEntry& entry,
                                 const Model& model) const;

    /// The serial of the last row of its log, and the hash that chains the next row to it; for the writer.
    struct Tail {
        std::int64_t serial = 0;
        std::uint64_t chain = 0;
    };
    Tail tail(BranchId branch) const;
    /// Its log ends where its writer left it. Else rows that are missing at its end are not noticed: the run
    /// was killed or still writes, or an older program wrote the file.
    bool has_end(BranchId branch) const;
    /// Checks every row, checkpoint and Model, and returns the first fault. (open() leaves most checks to
    /// later reads.)
    Result<> inspect() const;

  private:
    Result<SavedRun> run_with(const Branch& branch, const CheckpointEntry& entry, const Model& model,
                              Tick until, Tick said_until) const;
    /// What the rows of a branch's log say together.
    struct LogHead {
        Tail tail;
        std::int64_t ended = -1;  // the row that its writer left as the last; -1: none
        Tick committed = -1, end = -1;
        std::uint64_t hash = 0, bytes = 0;
        std::size_t orders = 0;
    };
    struct CheckpointBlobs {
        Blob memory, states;
    };
    Result<CheckpointBlobs> checkpoint_blobs(const CheckpointEntry& entry) const;
    static Result<Journal> open_as(const std::string& path, bool look_through);
    Error damaged(const std::string& what) const;
    bool has_whole_pages() const;
    bool has_bases() const;
    bool is_sealed() const;
    Error changed(const std::string& row, BranchId branch) const;
    Result<> read_meta();
    Result<> read_tables();
    Result<> read_branches();
    Result<> read_log_bases();
    Result<> read_log_heads();
    Result<> read_log_ends();
    Result<> read_checkpoint_entries();
    Result<> read_bookmarks();
    Result<> check_serials() const;
    Result<> check_older_checkpoints() const;
    Result<> check_tree() const;
    Result<> add_base(const Branch& branch, LogBatch& log) const;
    Branch* find_own(BranchId id);

    std::string path_, version_;
    std::int64_t format_ = 0;
    std::optional<std::uint64_t>
        world_;  // hash of the Model of the world file; none: that of the root branch
    std::optional<Database> db_;
    std::vector<Branch> branches_;
    std::vector<CheckpointEntry> checkpoints_;  // of all branches, by (branch, tick)
    std::map<BranchId, std::int64_t>
        last_serials_;                    // the last row of a log that a checkpoint was written with
    bool has_older_checkpoints_ = false;  // whose rows can only be checked with their blobs
    std::map<BranchId, LogHead> heads_;
    BranchId read_branch_ = 0;  // up to this row of this branch the log has been read
    std::int64_t read_serial_ = 0;
    std::vector<Bookmark> bookmarks_;
};

/// An Error unless the Model of this branch is the one given.
Result<> check_world(const Journal& journal, const Branch& branch, const Model& model);

}  // namespace roboss
