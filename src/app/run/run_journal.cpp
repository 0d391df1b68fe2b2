// Opens journals for a run.
#include "app/run/run_journal.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "app/worlds/orders_file.h"
#include "core/hash.h"

namespace roboss {

Result<std::unique_ptr<RunJournal>> RunJournal::open(const RunOptions& options, const Model& model) {
    std::unique_ptr<RunJournal> journal(new RunJournal(options));
    journal->log_ticks_ = std::max<Tick>(1, tick_at(options.journal_every_s, model.dt_s));
    if (!options.from.empty())
        if (Result<> opened = journal->open_from(model); !opened) return opened.error();
    if (!options.journal.empty())
        if (Result<> opened = journal->open_journal(model); !opened) return opened.error();
    return journal;
}

Result<std::unique_ptr<RunJournal>> RunJournal::open_replay(const RunOptions& options) {
    std::unique_ptr<RunJournal> result(new RunJournal(options));
    Result<OpenedJournalTime> opened = open_location(options.replay);
    if (!opened) return opened.error();
    const auto& [location, journal, time] = opened.value();
    result->file_ = location.file;
    result->replay_spans_ = journal.spans();
    result->replay_bookmarks_ = journal.bookmarks();
    const Tick start = location.time_s ? time.tick : time.lineage.first();
    if (Result<> loaded = result->load_replay(journal, time.lineage, start); !loaded) return loaded.error();
    if (const std::string text = ways(time.lineage, time.model->dt_s); !text.empty())
        result->notices_.push_back("the replay " + text + " [branches]");
    return result;
}

Result<> RunJournal::load_replay(const Journal& journal, const Lineage& lineage, Tick start) {
    const Lineage::Part part = *lineage.at(start);
    Result<Branch> branch = journal.branch(part.branch);
    if (!branch) return branch.error();
    Result<std::shared_ptr<const Model>> model = journal.model(branch.value());
    if (!model) return model.error();
    Replay replay{lineage, part, model.value(), branch.value(), journal.checkpoints(branch.value())};
    if (branch.value().hash != 0 && branch.value().committed > replay.checks.back().tick)
        replay.checks.push_back({part.branch, branch.value().committed, branch.value().hash});
    Result<SavedRun> run = journal.run_from(branch.value(), *journal.checkpoint_before(branch.value(), start),
                                            *replay.model, part.until);
    if (!run) return run.error();
    start_ = start;
    world_hash_ = journal.world_hash(branch.value());
    from_ = std::move(run).value();
    replay_ = std::move(replay);
    return Ok{};
}

Result<> RunJournal::seek(BranchId branch, double time_s) {
    Result<Journal> journal = Journal::open_own(file_);
    if (!journal) return journal.error();
    const BranchId wanted = branch > 0 ? branch : this->branch();
    Result<JournalTime> time = find_time(journal.value(), {file_, wanted, time_s});
    if (!time) return time.error();
    return load_replay(journal.value(), time.value().lineage, time.value().tick);
}

bool RunJournal::turns_at(Tick now) const {
    return replay_ && now == replay_->part.until && replay_->part.branch != replay_->lineage.branch();
}

Result<> RunJournal::go_on(std::uint64_t hash) {
    const Tick now = replay_->part.until;
    if (Result<> equal = check(now, hash); !equal) return equal;
    Result<Journal> journal = Journal::open_own(file_);
    if (!journal) return journal.error();
    const std::uint64_t model = replay_->model->hash;
    const BranchId before = replay_->branch.id;
    if (Result<> loaded = load_replay(journal.value(), replay_->lineage, now); !loaded) return loaded;
    if (replay_->model->hash != model) return Ok{};
    if (replay_->checks.front().hash == hash) return ++compared_, Ok{};
    differs_ = true;
    return Error{
        fmt::format("branch {} does not begin with the state that branch {} has at tick {}: hash {} "
                    "instead of {}",
                    replay_->branch.id, before, now, to_hex(replay_->checks.front().hash), to_hex(hash)),
        fmt::format("replay from its beginning: {}#{}@{}", file_, replay_->branch.id,
                    static_cast<double>(now) * replay_->model->dt_s),
        "bits-differ"};
}

BranchId RunJournal::branch() const {
    if (writer_) return writer_->branch();
    return replay_ ? replay_->lineage.branch() : 0;
}

std::uint64_t RunJournal::timeline_serial() const {
    if (writer_) return writer_->timeline_serial();
    return static_cast<std::uint64_t>(branch());
}

RunTimeline RunJournal::timeline(double dt_s) const {
    const auto seconds = [dt_s](Tick tick) { return static_cast<double>(tick) * dt_s; };
    RunTimeline timeline;
    timeline.serial = timeline_serial();
    timeline.branch = branch();
    const std::vector<BranchSpan> spans = writer_ ? writer_->spans() : replay_spans_;
    for (const BranchSpan& s : spans) {
        const bool parent_left =
            std::ranges::any_of(spans, [&](const BranchSpan& p) { return p.id == s.parent; });
        timeline.branches.push_back(
            {s.id, parent_left ? s.parent : 0, seconds(s.begin), seconds(s.first), seconds(s.end), s.reason});
    }
    for (const Bookmark& mark : writer_ ? writer_->bookmarks() : replay_bookmarks_)
        timeline.bookmarks.push_back({mark.id, mark.branch, seconds(mark.tick), mark.name});
    return timeline;
}

std::uint64_t RunJournal::bytes() const {
    std::uint64_t all = 0;
    for (const char* end : {"", "-wal"}) {
        std::error_code none;
        const std::uintmax_t size = std::filesystem::file_size(file_ + end, none);
        if (!none) all += size;
    }
    return all;
}

double RunJournal::growth_mb_per_min(std::int64_t now_ms) {
    constexpr std::int64_t kOver_ms = 60'000, kEvery_ms = 2'000;
    const std::uint64_t size = bytes();
    if (sizes_.empty() || now_ms - sizes_.back().first >= kEvery_ms) sizes_.emplace_back(now_ms, size);
    while (sizes_.size() > 1 && now_ms - sizes_.front().first > kOver_ms) sizes_.pop_front();
    const auto& [since_ms, before] = sizes_.front();
    if (now_ms - since_ms < kEvery_ms) return 0;
    return 60e-3 * (static_cast<double>(size) - static_cast<double>(before)) /
           static_cast<double>(now_ms - since_ms);
}

Tick RunJournal::next_check(Tick now) const {
    if (!replay_) return std::numeric_limits<Tick>::max();
    const auto next = std::ranges::upper_bound(replay_->checks, now, {}, &CheckpointEntry::tick);
    const Tick turn = turns_at(replay_->part.until) ? replay_->part.until : std::numeric_limits<Tick>::max();
    return next == replay_->checks.end() ? turn : std::min(turn, next->tick);
}

Result<> RunJournal::check(Tick now, std::uint64_t hash) {
    if (!replay_) return Ok{};
    const auto entry = std::ranges::lower_bound(replay_->checks, now, {}, &CheckpointEntry::tick);
    const bool restored = now == from_->tick;  // from this very checkpoint
    if (entry == replay_->checks.end() || entry->tick != now || restored) return Ok{};
    if (entry->hash == hash) return ++compared_, Ok{};
    differs_ = true;
    return Error{
        fmt::format("at tick {} the state of the replay differs from the recorded run: hash {} instead of {}",
                    now, to_hex(hash), to_hex(entry->hash)),
        "one of the two machines computes other bits: see `roboss journal verify`, and replay on "
        "another machine",
        "bits-differ"};
}

/// The branch's Model: that of the world file, or one into which a run of this world was changed.
Result<std::shared_ptr<const Model>> RunJournal::model_of(const Journal& journal, const Branch& branch,
                                                          const Model& world) {
    if (Result<> fits = check_world(journal, branch, world); !fits) return fits.error();
    Result<std::shared_ptr<const Model>> model = journal.model(branch);
    if (model && model.value()->hash != world.hash) changed_model_ = model.value();
    return model;
}

Result<> RunJournal::open_from(const Model& model) {
    Result<OpenedJournalTime> opened = open_location(o_.from);
    if (!opened) return opened.error();
    const auto& [location, journal, time] = opened.value();
    const Branch& branch = time.branch;
    Result<std::shared_ptr<const Model>> its_model = model_of(journal, branch, model);
    if (!its_model) return its_model.error();
    Result<SavedRun> run = journal.run_at(branch, *its_model.value(), time.tick);
    if (!run) return run.error();
    from_ = std::move(run).value();
    start_ = from_->logged_until;
    std::error_code none;
    if (!o_.journal.empty() && std::filesystem::equivalent(location.file, o_.journal, none)) {
        parent_ = branch.id;
    }
    reason_ = fmt::format("from {}", o_.from);
    return Ok{};
}

Result<> RunJournal::open_journal(const Model& model) {
    JournalWriterOptions options;
    if (o_.journal_keep.seconds) options.keep.ticks = tick_at(*o_.journal_keep.seconds, model.dt_s);
    options.keep.bytes = o_.journal_keep.bytes.value_or(0);
    Result<std::unique_ptr<JournalWriter>> writer = JournalWriter::open(o_.journal, options);
    if (!writer) return writer.error();
    writer_ = std::move(writer).value();
    file_ = o_.journal;
    if (writer_->is_new() || parent_ != 0) return Ok{};
    if (from_)
        return Error{o_.journal + " exists already, and --from names another file",
                     "give --journal a new name, or start --from this journal", "journal-exists"};
    return resume(model);
}

/// From the last checkpoint before which every connected Client had answered everything that it saw: a Client
/// in its own process will not see anything earlier again.
Result<SavedRun> RunJournal::last_run(const Journal& journal, const Branch& branch, const Model& model) {
    const std::vector<CheckpointEntry> entries = journal.checkpoints(branch);
    for (std::size_t i = entries.size(); i-- > 0;) {
        Result<SavedRun> run = journal.resume_from(branch, entries[i], model);
        if (!run || i == 0) return run;
        const auto silent = [&](const std::string& name) {
            return run.value().answered[name] < 0 &&
                   std::find(run.value().left.begin(), run.value().left.end(), name) ==
                       run.value().left.end();
        };
        if (std::none_of(run.value().clients.begin(), run.value().clients.end(), silent)) return run;
    }
    return Error{journal.path() + " has no checkpoint", "begin a new journal", "journal-empty"};
}

Result<> RunJournal::resume(const Model& model) {
    Result<Journal> journal = Journal::open(o_.journal);
    if (!journal) return journal.error();
    // What is continued shall be whole, or a rewind fails hours later.
    if (Journal::is_small(o_.journal))
        if (Result<> whole = journal.value().inspect(); !whole)
            return Error{
                whole.error().message,
                fmt::format("take another copy of the file, or go on from its end in a new one: --from {} "
                            "--journal ANOTHER",
                            o_.journal),
                whole.error().code};
    Result<Branch> branch = journal.value().branch();
    if (!branch) return branch.error();
    Result<std::shared_ptr<const Model>> its_model = model_of(journal.value(), branch.value(), model);
    if (!its_model) return its_model.error();
    Result<SavedRun> run = last_run(journal.value(), branch.value(), *its_model.value());
    if (!run) return run.error();
    from_ = std::move(run).value();
    start_ = from_->logged_until;
    resumes_ = true;
    writer_->continue_branch(journal.value(), branch.value());
    notices_.push_back(fmt::format("resuming {} at {:.6f} s (tick {}) [resumed]", o_.journal,
                                   static_cast<double>(branch.value().end) * model.dt_s, branch.value().end));
    return Ok{};
}

Result<std::vector<std::string>> RunJournal::awaited(const std::vector<std::string>& names,
                                                     bool others_may_come) const {
    if (!resumes_) return std::vector<std::string>{};
    std::vector<std::string> were;
    for (const std::string& name : from_->clients)
        if (std::find(from_->left.begin(), from_->left.end(), name) == from_->left.end())
            were.push_back(name);
    const bool fits = names.size() <= were.size() && std::equal(names.begin(), names.end(), were.begin());
    if (fits && (others_may_come || names.size() == were.size()))
        return std::vector<std::string>(were.begin() + static_cast<std::ptrdiff_t>(names.size()), were.end());
    const auto list = [](const std::vector<std::string>& all) {
        std::string text;
        for (const std::string& name : all) text += (text.empty() ? "'" : ", '") + name + "'";
        return text.empty() ? std::string("none") : text;
    };
    return Error{o_.journal + " was written with other Clients: " + list(were) + "; given: " + list(names),
                 "give the same Clients in the same order, or begin a branch with --from " + o_.journal,
                 "other-clients"};
}

Result<> RunJournal::begin(Simulation& simulation) {
    if (!writer_ || resumes_) return Ok{};
    return begin_branch(simulation, parent_, reason_);
}

Result<> RunJournal::begin_branch(Simulation& simulation, BranchId parent, const std::string& reason) {
    if (!writer_) return Ok{};
    Branch branch;
    branch.parent = parent;
    branch.tick = simulation.tick();
    branch.seed = simulation.seed();
    branch.world_file = o_.world;
    branch.reason = reason;
    Result<BranchId> begun = writer_->start_branch(branch, simulation.model());
    if (!begun) return begun.error();
    simulation.start_log(writer_.get(), log_ticks_);
    return writer_->flush();
}

std::vector<std::string> RunJournal::take_notices() {
    if (writer_)
        for (std::string& line : writer_->take_notices()) notices_.push_back(std::move(line));
    return std::exchange(notices_, {});
}

Result<> RunJournal::close() {
    if (!writer_) return Ok{};
    return writer_->close();
}

}  // namespace roboss
