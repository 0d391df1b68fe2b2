// JournalWriter: a RunLog that appends to a journal's file asynchronously, in a background thread. The run
// never waits for the disk: entries gather in memory and are written as one transaction at a time, at once if
// somebody waits for them, else several times a second. While the file cannot be written (disk full), entries
// wait in memory up to a limit and the run continues; the file stays consistent.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "journal/journal.h"
#include "journal/journal_pruning.h"
#include "journal/run_log.h"

namespace roboss {

struct JournalWriterOptions {
    std::int64_t gather_ms = 20;                // between two transactions for which nobody waits
    std::int64_t retry_ms = 500;                // after one that failed
    std::size_t waiting_bytes_max = 64u << 20;  // in memory while the file cannot be written
    JournalKeep keep{};
};

class JournalWriter : public RunLog {
  public:
    /// Opens a journal to append, or makes one. Refuses what open() of Journal refuses, and a journal that
    /// another process writes.
    static Result<std::unique_ptr<JournalWriter>> open(const std::string& path,
                                                       const JournalWriterOptions& options = {});
    ~JournalWriter() override;
    JournalWriter(const JournalWriter&) = delete;
    JournalWriter& operator=(const JournalWriter&) = delete;

    bool is_new() const { return branches_ == 0; }
    /// Begins a branch at `branch`.tick; its number is set here. All further entries belong to it. Call
    /// flush() after its first checkpoint and the orders still to be applied: it writes the beginning of the
    /// branch as a whole.
    Result<BranchId> start_branch(Branch branch, const Model& model);
    /// Further entries are appended to this branch.
    void continue_branch(const Journal& journal, const Branch& branch);
    BranchId branch() const { return branch_; }

    /// Writes all entries. Waits for the disk.
    Result<> flush();
    /// Calls flush() and ends, with all entries in the file itself; an Error if any is not.
    Result<> close();
    /// What happened since the last call (the disk is full, there is room again), one line each.
    std::vector<std::string> take_notices();

    /// All branches that the file has, ascending by id.
    std::vector<BranchSpan> spans() const;
    std::vector<Bookmark> bookmarks() const;
    /// Another number after each new branch, pruned branch and change of a bookmark.
    std::uint64_t timeline_serial() const { return timeline_serial_; }
    /// The first tick to which the current branch can be rewound.
    Tick first_tick() const;
    /// Its number is chosen here. An Error: the file has kBookmarksMost of them.
    Result<std::int64_t> add_bookmark(Bookmark bookmark);
    /// An Error: there is none with this number.
    Result<> remove_bookmark(std::int64_t id);
    static constexpr std::size_t kBookmarksMost = 1'000;

    void joined(ClientId client, const std::string& name) override;
    void order(const Order& order, Tick given_at) override;
    void reply(ClientId client, Tick observed) override;
    void note(Tick tick, const std::string& text) override;
    void planned(Tick until) override;
    void committed(Tick tick, std::uint64_t world_hash) override;
    bool takes_checkpoint() const override;
    void checkpoint(RunCheckpoint checkpoint) override;
    std::uint64_t given() const override { return given_; }
    bool safe(std::uint64_t count) const override { return safe_ >= count || failing_; }
    void hurry() override;
    void wait_safe(std::uint64_t count, std::int64_t ms_max) override;

  private:
    /// Entries waiting to be written.
    struct Pending {
        LogBatch entries;
        Tick planned = -1, committed = -1;
        std::uint64_t hash = 0;
        std::optional<RunCheckpoint> checkpoint;
        std::vector<Row> models, branches;  // that begin here
        std::vector<Row> bookmarks, bookmarks_removed;
        std::vector<Row> ends;    // of logs that go no further
        std::uint64_t given = 0;  // counted with the last of it
        bool empty() const { return !logs() && bookmarks.empty() && bookmarks_removed.empty(); }
        /// Something that belongs to the log of the branch.
        bool logs() const { return !entries.empty() || planned >= 0 || committed >= 0 || checkpoint; }
    };
    JournalWriter() = default;
    void serve();
    Result<> write(const Pending& pending);
    Result<> write_rows(const Pending& pending);
    void take_in(Pending& pending);
    void mark_end();
    void settle(const Result<>& written, Pending& pending);
    void prune();
    void forget(const JournalPruning& done);
    BranchSpan* span_of(BranchId id);

    std::string path_;
    JournalWriterOptions options_;
    int lock_file_ = -1;
    std::optional<Database> db_;  // of the thread alone, once it runs
    bool marks_ends_ = false;     // all branches that the file had have their ends in it
    std::uint64_t model_hash_ = 0;
    BranchId branches_ = 0, branch_ = 0;
    std::vector<std::uint64_t> models_;  // hashes of those that have been handed over
    Journal::Tail tail_, next_tail_;

    mutable std::mutex mutex_;
    std::vector<BranchSpan> spans_;
    std::vector<Bookmark> bookmarks_;
    std::int64_t last_bookmark_ = 0;
    std::condition_variable wake_, done_;
    Pending waiting_;
    bool writing_ = false, hurry_ = false, ending_ = false;
    bool beginning_ = false;  // a branch: nothing is written before flush()
    std::size_t waiting_bytes_ = 0;
    std::optional<Error> lost_;  // entries were dropped
    std::optional<Error> trouble_;
    std::vector<std::string> notices_;
    std::atomic<std::uint64_t> given_{0}, safe_{0};
    std::atomic<std::uint64_t> timeline_serial_{1};
    std::atomic<bool> failing_{false}, checkpoint_waits_{false};
    std::thread thread_;
};

}  // namespace roboss
