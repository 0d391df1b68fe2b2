// Reading, stepping, matching robots by name.
#include "app/run/journal_preview.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <unordered_map>

#include "app/worlds/orders_file.h"
#include "simulation/replay.h"

namespace roboss {
namespace {

constexpr std::int64_t kReadAgain_ms = 200;
constexpr double kNearEnd_s = 1;  // a time so little behind the end shows the end
constexpr int kLowPriority = 15;  // nice value of the thread

std::int64_t now_ms() {
    return std::chrono::duration_cast<std::chrono::milliseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// On Linux each thread has a nice value of its own.
void lower_priority() {
    (void)setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kLowPriority);
}

/// Their joint coordinates mean the same.
bool same_coordinates(const RobotType& a, const RobotType& b) {
    return std::equal(a.bodies.begin(), a.bodies.end(), b.bodies.begin(), b.bodies.end(),
                      [](const Body& x, const Body& y) {
                          return x.joint == y.joint && x.q_index == y.q_index && x.parent == y.parent;
                      });
}

}  // namespace

JournalPreview::~JournalPreview() {
    {
        const std::lock_guard guard(mutex_);
        ending_ = true;
        wake_.notify_all();
    }
    if (thread_.joinable()) thread_.join();
}

void JournalPreview::ask(Request request, std::shared_ptr<const Model> shown, BranchId present) {
    const std::lock_guard guard(mutex_);
    const auto same = [&](const Question& q) { return q.request.asker == request.asker; };
    const auto older = std::find_if(questions_.begin(), questions_.end(), same);
    if (older != questions_.end()) {
        replies_.push_back({std::move(older->request.answer),
                            ControlRefused(Error{"a newer preview was requested", "", "superseded"})});
        questions_.erase(older);
    }
    questions_.push_back({std::move(request), std::move(shown), present});
    if (!thread_.joinable()) thread_ = std::thread([this] { serve(); });
    wake_.notify_all();
}

std::vector<JournalPreview::Reply> JournalPreview::take_replies() {
    const std::lock_guard guard(mutex_);
    return std::exchange(replies_, {});
}

void JournalPreview::serve() {
    lower_priority();
    std::unique_lock guard(mutex_);
    for (;;) {
        wake_.wait(guard, [&] { return ending_ || !questions_.empty(); });
        if (ending_) return;
        const Question question = std::move(questions_.front());
        questions_.pop_front();
        guard.unlock();
        ControlOutcome outcome = preview(question);
        guard.lock();
        replies_.push_back({question.request.answer, std::move(outcome)});
    }
}

/// Nobody asks for something newer.
bool JournalPreview::goes_on(const Address& asker) {
    const std::lock_guard guard(mutex_);
    return !ending_ && std::none_of(questions_.begin(), questions_.end(),
                                    [&](const Question& q) { return q.request.asker == asker; });
}

ControlOutcome JournalPreview::preview(const Question& question) {
    const std::int64_t until_ms = now_ms() + question.request.wanted.patience_ms;
    Result<Moment> moment = find(question);
    if (!moment) return ControlRefused(moment.error());
    Result<Warm*> warm = warm_at(question, moment.value());
    if (!warm) {  // the journal may have been pruned in between
        journal_.reset();
        moment = find(question);
        if (moment) warm = warm_at(question, moment.value());
    }
    if (!moment) return ControlRefused(moment.error());
    if (!warm) return ControlRefused(warm.error());
    Simulation& simulation = *warm.value()->simulation;
    const Tick began = simulation.tick();
    // A window at least, so that many impatient requests come nearer, too.
    const auto patient = [&] {
        return simulation.tick() == began || (now_ms() < until_ms && goes_on(question.request.asker));
    };
    const Result<> stepped = simulation.run_until(moment.value().tick, patient);
    if (!stepped) return warm_.pop_front(), ControlRefused(stepped.error());
    return shown(question, moment.value(), *warm.value());
}

Result<> JournalPreview::read_journal() {
    read_ms_ = now_ms();
    if (journal_) {
        Result<> read = journal_->refresh();
        if (!read) journal_.reset();
        return read;
    }
    Result<Journal> opened = Journal::open_own(file_);
    if (!opened) return opened.error();
    journal_ = std::move(opened).value();
    return Ok{};
}

/// What is not known yet, or lies behind the end that is known, may have been written since.
Result<JournalPreview::Moment> JournalPreview::find(const Question& question) {
    const PreviewRun& wanted = question.request.wanted;
    const BranchId branch = wanted.branch > 0 ? wanted.branch : question.present;
    const double dt_s = question.shown->dt_s;
    if (!journal_)
        if (Result<> read = read_journal(); !read) return read.error();
    Result<Moment> moment = look_up(wanted, branch, dt_s);
    const bool short_of_it = !moment || moment.value().tick < tick_at(wanted.time_s, dt_s);
    if (!short_of_it || (moment && now_ms() - read_ms_ < kReadAgain_ms)) return moment;
    if (Result<> read = read_journal(); !read) return read.error();
    return look_up(wanted, branch, dt_s);
}

Result<JournalPreview::Moment> JournalPreview::look_up(const PreviewRun& wanted, BranchId branch,
                                                       double dt_s) const {
    Result<Branch> named = journal_->branch(branch);
    if (!named) return named.error();
    const Lineage lineage = journal_->lineage(named.value());
    Moment moment;
    moment.tick = tick_at(wanted.time_s, dt_s);
    const Tick end = named.value().committed;  // of what may still be written
    if (moment.tick > end && static_cast<double>(moment.tick - end) * dt_s <= kNearEnd_s) moment.tick = end;
    Result<Branch> holder = journal_->holder(lineage, moment.tick, dt_s);
    if (!holder) return holder.error();
    moment.branch = std::move(holder).value();
    moment.checkpoint = *journal_->checkpoint_before(moment.branch, moment.tick);
    const std::vector<CheckpointEntry> entries = journal_->checkpoints(moment.branch);
    const auto next = std::ranges::upper_bound(entries, moment.tick, {}, &CheckpointEntry::tick);
    moment.until = next != entries.end() ? next->tick : std::max(moment.tick, moment.branch.committed);
    return moment;
}

Result<JournalPreview::Warm*> JournalPreview::warm_at(const Question& question, const Moment& moment) {
    const auto fits = [&](const Warm& warm) {
        const Tick at = warm.simulation->tick();
        return warm.asker == question.request.asker && warm.branch == moment.branch.id && at <= moment.tick &&
               at >= moment.checkpoint.tick && warm.until >= moment.tick;
    };
    const auto found = std::find_if(warm_.begin(), warm_.end(), fits);
    if (found != warm_.end()) {
        warm_.splice(warm_.begin(), warm_, found);
        return &warm_.front();
    }
    std::shared_ptr<const Model> model = question.shown;
    for (const Warm& warm : warm_)
        if (warm.model->hash == moment.branch.model_hash) model = warm.model;
    std::erase_if(warm_, [&](const Warm& warm) { return warm.asker == question.request.asker; });
    if (model->hash != moment.branch.model_hash) {
        Result<std::shared_ptr<const Model>> read = journal_->model(moment.branch);
        if (!read) return read.error();
        model = std::move(read).value();
    }
    auto simulation = replay_from(*journal_, moment.branch, moment.checkpoint, model, moment.until, {1, 0});
    if (!simulation) return simulation.error();
    while (warm_.size() >= kWarmMost) warm_.pop_back();
    warm_.push_front(
        {question.request.asker, moment.branch.id, moment.until, model, std::move(simulation).value()});
    return &warm_.front();
}

RunPreview JournalPreview::shown(const Question& question, const Moment& moment, Warm& warm) {
    if (shown_model_ != question.shown) {
        shown_model_ = question.shown;
        layout_.emplace(*shown_model_);
    }
    const Model& now = *question.shown;
    const Model& then = *warm.model;
    const std::vector<RobotState>& states = warm.simulation->states();
    RunPreview preview;
    preview.model_hash = now.hash;
    preview.branch = moment.branch.id;
    preview.tick = warm.simulation->tick();
    preview.time_s = warm.simulation->time_s();
    preview.exact = preview.tick == moment.tick;
    std::unordered_map<std::string, std::size_t> by_name;
    if (then.hash != now.hash)
        for (std::size_t r = 0; r < then.robots.size(); ++r) by_name.emplace(then.robots[r].name, r);
    std::size_t matched = 0;
    for (std::size_t r = 0; r < now.robots.size(); ++r) {
        std::size_t source = r;
        if (then.hash != now.hash) {
            const auto found = by_name.find(now.robots[r].name);
            const bool same = found != by_name.end() &&
                              same_coordinates(now.type_of(RobotId(r)), then.type_of(RobotId(found->second)));
            if (!same) {
                ++preview.absent;
                continue;
            }
            source = found->second;
        }
        ++matched;
        layout_->append(now, RobotId(r), states[source], preview.entries);
    }
    preview.gone = then.robots.size() - matched;
    return preview;
}

}  // namespace roboss
