// Property: a journal of random additions, removals, changes of accuracy, rewinds, resets and saves replays
// from any of its ticks to any later one of the same lineage, with the hashes that the run committed.
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "core/hash.h"
#include "fuzz/property.h"
#include "fuzz/random_program.h"
#include "journal/journal_writer.h"
#include "model/edit.h"
#include "simulation/replay.h"

namespace roboss::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr int kActions = 8, kWalks = 12;

/// A file of this process and seed, removed at the end.
class TemporaryFile {
  public:
    TemporaryFile(std::uint64_t seed, const char* ending)
        : path_(fs::temp_directory_path() /
                ("roboss_fuzz_" + std::to_string(getpid()) + "_" + std::to_string(seed) + ending)) {}
    ~TemporaryFile() {
        std::error_code none;
        for (const char* end : {"", "-wal", "-shm"}) fs::remove(path() + end, none);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    std::string path() const { return path_.string(); }

  private:
    fs::path path_;
};

/// A run that is recorded and controlled, as `roboss run` does it, and the hashes that it committed.
class RecordedRun {
  public:
    RecordedRun(const Setting& setting, std::string file)
        : random_(setting.seed + 77),
          seed_(setting.seed),
          start_(make_start(setting)),
          log_ticks_(random_.integer(3, 30)),
          writer_(std::move(JournalWriter::open(file)).value()),
          file_(std::move(file)) {
        SavedRun from;
        from.seed = setting.seed, from.states = start_.states;
        begin(start_.model, from, 0);
    }

    /// Up to the last tick that is finite.
    void advance(Tick ticks) {
        for (const Tick until = simulation_->tick() + ticks; simulation_->tick() < until && whole_;) {
            give_order();
            whole_ =
                simulation_->run_until(std::min<Tick>(until, simulation_->tick() + random_.integer(1, 7)))
                    .ok();
            note();
        }
    }
    void act() {
        switch (random_.integer(0, 7)) {
            case 0:
                return add();
            case 1:
                return remove();
            case 2:
                return change_accuracy();
            case 3:
            case 4:
                return rewind();
            case 5:
                return begin_anew();
            case 6:
                return keep();
            default:
                return return_to_kept();
        }
    }
    void close() {
        if (simulation_) simulation_->start_log(nullptr, 0);
        ROBOSS_CHECK(writer_->close().ok(), file_);
        writer_.reset();
    }
    bool whole() const { return whole_; }
    /// The hashes of each branch, by tick.
    const std::map<BranchId, std::map<Tick, std::uint64_t>>& hashes() const { return hashes_; }

  private:
    struct Kept {
        std::shared_ptr<const Model> model;
        SavedRun run;
        BranchId branch = 0;
    };

    void note() { hashes_[writer_->branch()][simulation_->tick()] = simulation_->hash(); }

    void begin(std::shared_ptr<const Model> model, const SavedRun& from, BranchId parent) {
        if (simulation_) simulation_->start_log(nullptr, 0);
        SimulationOptions options;
        options.controller.window = random_.integer(0, 9);
        options.controller.seed = from.seed;
        options.simulators = static_cast<std::size_t>(random_.integer(1, 2));
        auto made = Simulation::create(model, options, {}, &from);
        ROBOSS_CHECK(made.ok(), made.ok() ? "" : made.error().text());
        simulation_ = std::move(made).value();
        model_ = std::move(model);
        whole_ = simulation_->run_until(from.logged_until).ok();
        if (!whole_) return;
        Branch branch;
        branch.parent = parent, branch.tick = simulation_->tick(), branch.seed = from.seed;
        branch.world_file = "fuzz", branch.reason = "fuzz";
        ROBOSS_CHECK(writer_->start_branch(branch, *model_).ok(), file_);
        simulation_->start_log(writer_.get(), log_ticks_);
        ROBOSS_CHECK(writer_->flush().ok(), file_);
        note();
    }

    RobotId any_robot() {
        return RobotId(
            static_cast<std::size_t>(random_.integer(0, static_cast<int>(model_->robots.size()) - 1)));
    }
    /// Some take effect only after later branches have begun.
    void give_order() {
        const RobotId robot = any_robot();
        const Tick at = simulation_->tick() + random_.integer(0, 40);
        const Order order{at, ClientId(0u), ++sequence_, robot,
                          SetVelocity{random_.vector(1), random_.vector(1)}};
        if (check_order(*model_, order)) (void)simulation_->submit(order);
    }

    void edit(const Result<ModelEdit>& edit) {
        if (!edit) return;
        SavedRun run = simulation_->saved_run();
        run.states = carry_over(edit.value(), run.states);
        std::erase_if(run.orders, [&](LoggedOrder& o) { return !carry_over(edit.value(), o.order); });
        begin(edit.value().model, run, writer_->branch());
    }
    void add() {
        const RobotId original = any_robot();
        Pose X_WR = model_->robots[original.index()].X_WR;
        X_WR.p += random_.vector(2) + Vec3{0, 0, 3};
        const std::vector<RobotFrom> robots{
            {model_, original, "copy_" + std::to_string(++sequence_), X_WR, {}, false}};
        edit(with_robots(*model_, robots));
    }
    void remove() {
        if (model_->robots.size() > 1)
            edit(without_robots(*model_, {model_->robots[any_robot().index()].name}));
    }
    void change_accuracy() {
        AccuracySpec spec;
        spec.setting = random_.integer(0, 1) == 0 ? "fast" : "high";
        edit(with_accuracy(*model_, spec));
    }
    void rewind() {
        ROBOSS_CHECK(writer_->flush().ok(), file_);
        const Journal journal = std::move(Journal::open_own(file_)).value();
        const Lineage lineage = journal.lineage(journal.branch(writer_->branch()).value());
        const Tick tick =
            lineage.first() + random_.integer(0, static_cast<int>(simulation_->tick() - lineage.first()));
        const Branch holder = journal.holder(lineage, tick, model_->dt_s).value();
        std::shared_ptr<const Model> model = journal.model(holder).value();
        const Result<SavedRun> run = journal.run_at(holder, *model, tick);
        ROBOSS_CHECK(run.ok(), run.ok() ? "" : run.error().text());
        begin(std::move(model), run.value(), holder.id);
    }
    void begin_anew() {
        SavedRun run;
        run.seed = seed_, run.states = start_.states;
        begin(start_.model, run, writer_->branch());
    }
    /// The file of a save has the same state, also after robots came.
    void keep() {
        kept_ = Kept{model_, simulation_->saved_run(), writer_->branch()};
        if (model_->hash != start_.model->hash) kept_->run.world_hash = start_.model->hash;
        const TemporaryFile file(seed_, ".roboss");
        ROBOSS_CHECK(save_run(file.path(), *model_, kept_->run).ok(), file.path());
        const Journal saved = std::move(Journal::open(file.path(), true)).value();
        const Branch only = saved.branch().value();
        ROBOSS_CHECK(only.hash == simulation_->hash(), "the save has another state");
        ROBOSS_CHECK(check_world(saved, only, *start_.model).ok(), "the save is of another world");
    }
    void return_to_kept() {
        if (kept_) begin(kept_->model, kept_->run, kept_->branch);
    }

    Random random_;
    std::uint64_t seed_, sequence_ = 0;
    Start start_;
    Tick log_ticks_;
    std::unique_ptr<JournalWriter> writer_;
    std::string file_;
    std::shared_ptr<const Model> model_;
    std::unique_ptr<Simulation> simulation_;
    std::optional<Kept> kept_;
    bool whole_ = true;
    std::map<BranchId, std::map<Tick, std::uint64_t>> hashes_;
};

/// Steps a lineage again and compares; what is wrong, or empty.
class Walk {
  public:
    Walk(const Journal& journal, const RecordedRun& recorded) : journal_(journal), recorded_(recorded) {}

    std::string from_to(const Lineage& lineage, Tick from, Tick until) {
        for (const Lineage::Part* part = lineage.at(from); part != nullptr && part->from <= until;
             part = lineage.after(*part)) {
            const bool last = lineage.after(*part) == nullptr;
            const Tick end = std::min(until, part->until);
            if (std::string wrong = step(*part, std::max(from, part->from), end); !wrong.empty())
                return wrong;
            if (end == part->until && !last)
                if (std::string wrong = join(*lineage.after(*part)); !wrong.empty()) return wrong;
        }
        return {};
    }
    int compared() const { return compared_; }
    Tick tick() const { return tick_; }

  private:
    std::string step(const Lineage::Part& part, Tick from, Tick until) {
        const Branch branch = journal_.branch(part.branch).value();
        const std::shared_ptr<const Model> model = journal_.model(branch).value();
        auto simulation = replay_at(journal_, branch, model, from, part.until, {1, 0});
        if (!simulation) return simulation.error().text();
        hash_ = simulation.value()->hash(), model_hash_ = model->hash;
        const auto& known = recorded_.hashes().at(part.branch);
        for (auto next = known.lower_bound(from); next != known.end() && next->first <= until; ++next) {
            if (Result<> done = simulation.value()->run_until(next->first); !done) return done.error().text();
            tick_ = next->first, hash_ = simulation.value()->hash(), ++compared_;
            if (hash_ != next->second)
                return "branch " + std::to_string(part.branch) + " has hash " + to_hex(hash_) +
                       " instead of " + to_hex(next->second);
        }
        if (Result<> done = simulation.value()->run_until(until); !done) return done.error().text();
        hash_ = simulation.value()->hash();
        return {};
    }
    std::string join(const Lineage::Part& next) const {
        const Branch branch = journal_.branch(next.branch).value();
        if (branch.model_hash != model_hash_ || journal_.checkpoints(branch).front().hash == hash_) return {};
        return "branch " + std::to_string(next.branch) + " does not begin where the one before is left";
    }

    const Journal& journal_;
    const RecordedRun& recorded_;
    std::uint64_t hash_ = 0, model_hash_ = 0;
    int compared_ = 0;
    Tick tick_ = 0;
};

}  // namespace

Finding run_branches(const Request& request) {
    const Setting& setting = request.setting;
    const TemporaryFile file(setting.seed, ".journal");
    const auto ticks = std::max<Tick>(1, std::lround(request.seconds / setting.dt_s / kActions));
    RecordedRun recorded(setting, file.path());
    for (int i = 0; i < kActions && recorded.whole(); ++i) {
        recorded.advance(ticks);
        if (recorded.whole()) recorded.act();
    }
    recorded.close();
    Finding finding;
    const auto fail = [&](Tick tick, const std::string& text) {
        finding.failed = true, finding.tick = tick, finding.text = text;
        return finding;
    };
    const Result<Journal> journal = Journal::open(file.path(), true);
    if (!journal) return fail(0, journal.error().text());
    if (const Result<> whole = journal.value().inspect(); !whole) return fail(0, whole.error().text());
    Random random(setting.seed + 99);
    Walk walk(journal.value(), recorded);
    const auto& branches = journal.value().branches();
    for (int i = 0; i < kWalks; ++i) {
        const Branch& tip = i == 0 ? branches.back()
                                   : branches[static_cast<std::size_t>(
                                         random.integer(0, static_cast<int>(branches.size()) - 1))];
        const Lineage lineage = journal.value().lineage(tip);
        const auto& known = recorded.hashes().at(tip.id);
        const Tick end =
            lineage.parts().size() == 1 && known.empty() ? lineage.first() : known.rbegin()->first;
        const auto span = static_cast<int>(end - lineage.first());
        const Tick from = lineage.first() + (i == 0 ? 0 : random.integer(0, span));
        const Tick until = i == 0 ? end : from + random.integer(0, static_cast<int>(end - from));
        if (const std::string wrong = walk.from_to(lineage, from, until); !wrong.empty())
            return fail(walk.tick(), wrong);
        if (request.print_line)
            request.print_line(lineage.text(setting.dt_s) + ": from tick " + std::to_string(from) + " to " +
                               std::to_string(until));
    }
    finding.figure = walk.compared();
    return finding;
}

}  // namespace roboss::fuzz
