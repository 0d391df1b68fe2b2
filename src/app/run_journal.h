// RunJournal: where a run starts and where it is kept, as --from, --journal and --replay say.
#pragma once

#include <memory>
#include <optional>

#include "app/journal_location.h"
#include "app/run_options.h"
#include "journal/journal_writer.h"
#include "simulation/simulation.h"

namespace roboss {

class RunJournal {
  public:
    /// Opens what the options name; `model` is that of the world file.
    static Result<std::unique_ptr<RunJournal>> open(const RunOptions& options, const Model& model);
    /// For --replay, which needs no world.
    static Result<std::unique_ptr<RunJournal>> open_replay(const RunOptions& options);
    /// What to step again, and what must come of it.
    struct Replay {
        std::shared_ptr<const Model> model;
        Branch branch;
        std::vector<CheckpointEntry> checks;  // ascending
    };
    const std::optional<Replay>& replay() const { return replay_; }
    /// The next tick whose hash is known.
    Tick next_check(Tick now) const;
    /// Whether this hash is the one that was kept for this tick, if one was.
    Result<> check(Tick now, std::uint64_t hash) const;

    /// Where the run starts; none: at the world's beginning.
    /// The Model of that moment, if it is not that of the world file (robots were added, say); else none.
    const std::shared_ptr<const Model>& changed_model() const { return changed_model_; }
    const SavedRun* from() const { return from_ ? &*from_ : nullptr; }
    Tick start() const { return start_; }
    /// The journal of a run that goes on where it ended; it is to be told everything from the start.
    RunLog* resumed() { return resumes_ ? writer_.get() : nullptr; }
    /// `names`: the Clients that a resumed run is given, by ClientId. Who else was there in other processes
    /// is awaited again, if `others_may_come`; an Error: they are not those that the run had.
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
    Tick first_tick() const { return first_tick_; }
    std::vector<std::string> take_notices();
    Result<> close();

  private:
    explicit RunJournal(const RunOptions& options) : o_(options) {}
    Result<> open_from(const Model& model);
    Result<> open_journal(const Model& model);
    Result<> resume(const Model& model);
    Result<std::shared_ptr<const Model>> model_of(const Journal& journal, const Branch& branch,
                                                  const Model& world);
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
    Tick first_tick_ = 0;
};

}  // namespace roboss
