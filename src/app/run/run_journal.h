// RunJournal: the start and the journal of a run, according to --from, --journal and --replay.
#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "app/run/journal_location.h"
#include "app/run/run_options.h"
#include "journal/journal_writer.h"
#include "simulation/simulation.h"

namespace roboss {

class RunJournal {
  public:
    /// Opens what the options name; `model` is that of the world file.
    static Result<std::unique_ptr<RunJournal>> open(const RunOptions& options, const Model& model);
    /// For --replay, which needs no world.
    static Result<std::unique_ptr<RunJournal>> open_replay(const RunOptions& options);
    /// The run to step again, and the states that it must reach: one branch of the lineage after the other.
    struct Replay {
        Lineage lineage;
        Lineage::Part part;  // of it, that is stepped now
        std::shared_ptr<const Model> model;
        Branch branch;
        std::vector<CheckpointEntry> checks;  // ascending
    };
    const std::optional<Replay>& replay() const { return replay_; }
    /// Turns the replay to another time of the file; branch 0: the lineage that is replayed. It begins at
    /// from() and is to be stepped to start().
    Result<> seek(BranchId branch, double time_s);
    /// At this tick the replay continues in the next branch of its lineage: see go_on().
    bool turns_at(Tick now) const;
    /// Turns to the next branch, where from() is; `hash`: of the world where the one before was left. An
    /// Error: the next branch did not begin there.
    Result<> go_on(std::uint64_t hash);
    /// Recorded states that were compared and are equal, and whether one was not.
    std::size_t compared() const { return compared_; }
    bool differs() const { return differs_; }
    /// In a replay: hash of the Model of the world file.
    std::uint64_t world_hash() const { return world_hash_; }

    /// The file that can be looked into: the journal, or the file that is replayed; empty: none.
    const std::string& file() const { return file_; }
    /// Branch of that file; in a replay the one whose lineage is replayed; 0: none.
    BranchId branch() const;
    /// RunStatus::timeline.
    std::uint64_t timeline_serial() const;
    RunTimeline timeline(double dt_s) const;
    /// Bytes of the file.
    std::uint64_t bytes() const;
    /// MB per minute of real time by which the file grew in the last minute.
    double growth_mb_per_min(std::int64_t now_ms);
    /// The next tick whose hash is known, or at which the replay continues in another branch.
    Tick next_check(Tick now) const;
    /// Compares the hash with the one recorded for this tick, if any.
    Result<> check(Tick now, std::uint64_t hash);

    /// Where the run starts; none: at the world's beginning.
    /// The Model at that time if it differs from the world file (for example, robots were added); else null.
    const std::shared_ptr<const Model>& changed_model() const { return changed_model_; }
    const SavedRun* from() const { return from_ ? &*from_ : nullptr; }
    Tick start() const { return start_; }
    /// The journal of a resumed run, which logs everything from the start; else null.
    RunLog* resumed() { return resumes_ ? writer_.get() : nullptr; }
    /// `names`: the Clients that a resumed run is given, by ClientId. Returns the Clients in other
    /// processes, which are awaited again if `others_may_come`; an Error if the Clients are not those of the
    /// run.
    Result<std::vector<std::string>> awaited(const std::vector<std::string>& names,
                                             bool others_may_come) const;

    /// The world is where the run starts: a new branch begins, and the Simulation is logged. Nothing to do
    /// for a resumed run or one without a journal.
    Result<> begin(Simulation& simulation);
    /// The same in the middle of a run.
    Result<> begin_branch(Simulation& simulation, BranchId parent, const std::string& reason);
    bool writes() const { return writer_ != nullptr; }
    JournalWriter& writer() { return *writer_; }
    Tick log_ticks() const { return log_ticks_; }
    /// The first tick that can be rewound to.
    Tick first_tick() const {
        return writer_ ? writer_->first_tick() : replay_ ? replay_->lineage.first() : 0;
    }
    std::vector<std::string> take_notices();
    Result<> close();

  private:
    explicit RunJournal(const RunOptions& options) : o_(options) {}
    Result<> open_from(const Model& model);
    Result<> open_journal(const Model& model);
    Result<> resume(const Model& model);
    Result<std::shared_ptr<const Model>> model_of(const Journal& journal, const Branch& branch,
                                                  const Model& world);
    Result<> load_replay(const Journal& journal, const Lineage& lineage, Tick start);
    static Result<SavedRun> last_run(const Journal& journal, const Branch& branch, const Model& model);

    const RunOptions& o_;
    std::unique_ptr<JournalWriter> writer_;
    std::optional<SavedRun> from_;
    std::optional<Replay> replay_;
    std::shared_ptr<const Model> changed_model_;
    Tick start_ = 0;
    std::vector<std::string> notices_;
    BranchId parent_ = 0;  // of the branch to begin
    std::string reason_ = "run";
    bool resumes_ = false;
    Tick log_ticks_ = 0;
    std::size_t compared_ = 0;
    bool differs_ = false;
    std::uint64_t world_hash_ = 0;
    std::string file_;
    std::vector<BranchSpan> replay_spans_;
    std::vector<Bookmark> replay_bookmarks_;
    std::deque<std::pair<std::int64_t, std::uint64_t>> sizes_;  // when (ms), and how large the file was
};

}  // namespace roboss
