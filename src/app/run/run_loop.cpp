// The loop of a run: advances to the next tick at which something is due.
#include <fmt/format.h>

#include <limits>
#include <thread>

#include "app/output/say.h"
#include "app/processes/interrupt.h"
#include "app/processes/threads.h"
#include "app/run/run.h"
#include "app/run/standstill_watch.h"
#include "app/worlds/orders_file.h"
#include "core/hash.h"

namespace roboss {
namespace {

constexpr double kPictureEvery_s = 0.25;
constexpr double kPaceEvery_s = 0.01;
constexpr Tick kNever = std::numeric_limits<Tick>::max();

/// Something due at a fixed interval of ticks; never if it is 0.
class Due {
  public:
    Due(double every_s, double dt_s, Tick start)
        : every_(every_s > 0 ? std::max<Tick>(1, tick_at(every_s, dt_s)) : 0), start_(start) {}
    Tick next(Tick now) const {
        return every_ == 0 ? kNever : start_ + ((now - start_) / every_ + 1) * every_;
    }
    bool at(Tick now) const { return every_ != 0 && (now - start_) % every_ == 0; }

  private:
    Tick every_, start_;
};

}  // namespace

struct Run::Schedule {
    Due trace, contacts, dataset, hash, picture;
    Tick next(Tick now) const {
        return std::min(
            {trace.next(now), contacts.next(now), dataset.next(now), hash.next(now), picture.next(now)});
    }
};

/// Advances to this tick; false if the run failed. A request ends it early, at the end of the current window.
bool Run::advance_to(Tick target) {
    Result<> looked_after = Ok{};
    StandstillWatch standstill;
    const Result<> stepped = simulation_->run_until(target, [&] {
        if (auto line = standstill.look(*simulation_, monotonic_ms())) notices_.push_back(std::move(*line));
        show_progress();
        looked_after = members_->look_after(*simulation_);
        take_requests();
        return looked_after.ok() && !interrupted() &&
               (requests_.empty() || simulation_->tick() < busy_until_);
    });
    if (!looked_after) return abandoned_ = true, fail(looked_after.error());
    if (!stepped) return stop(stepped.error()), false;
    return true;
}

bool Run::await_states(bool request) {
    constexpr std::int64_t kPatience_ms = 10'000;
    Result<> looked_after = Ok{};
    StandstillWatch standstill;
    std::optional<std::int64_t> since_ms;
    const bool here = simulation_->await_states([&] {
        const std::int64_t now_ms = monotonic_ms();
        if (auto line = standstill.look(*simulation_, now_ms)) notices_.push_back(std::move(*line));
        show_progress();
        looked_after = members_->look_after(*simulation_);
        const bool ends = request || interrupted() || simulation_->failed();
        if (ends && !since_ms) since_ms = now_ms;
        if (request && interrupted()) return false;  // the end of the run waits for them itself
        return looked_after.ok() && (!since_ms || now_ms - *since_ms < kPatience_ms);
    });
    if (!looked_after) abandoned_ = true, fail(looked_after.error());
    return here;
}

Error Run::no_states() {
    return {"the Simulators that have the states at this tick are gone",
            "repeat the request once a Simulator has joined", "no-states"};
}

/// Says once why the run cannot continue, behind what happened before.
void Run::stop(const Error& why) {
    report_notices();
    if (log_) log_->event(simulation_->tick(), "stopped: " + why.message);
    progress_.clear();
    fail(why);
}

/// One turn of a paused run; false if it cannot continue.
bool Run::rest() {
    const Clock::time_point began = Clock::now();
    simulation_->serve();
    if (!members_->reaches_others()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    show_progress();
    const Result<> looked_after = members_->look_after(*simulation_);
    rested_ += Clock::now() - began;
    if (!looked_after) return abandoned_ = true, fail(looked_after.error());
    return true;
}

bool Run::stays() {
    constexpr auto kUnseen = std::chrono::seconds(10);  // a page that is loaded again comes back within
    if (pace_.quit || interrupted() || takes_picture()) return false;
    const bool seen = gateway_ && gateway_->load().pages > 0;
    if (seen || !over_) last_page_ = Clock::now();  // a run that was continued ends with its last page, too
    const bool replays = journal_->replay() && gateway_ && !o_.no_stay;  // who scrubs is not sent away
    const bool stays =
        o_.stay || replays || (!o_.no_stay && (seen || (over_ && Clock::now() - last_page_ < kUnseen)));
    if (stays && !std::exchange(over_, true)) {
        pace_.paused = true;
        notices_.push_back(fmt::format("the duration is over; the run stays, paused, until {} [over]",
                                       o_.stay || replays
                                           ? "Ctrl-C or `roboss control quit`"
                                           : "its last page closes, Ctrl-C or `roboss control quit`"));
    }
    return stays;
}

/// The run is paused meanwhile.
bool Run::take_picture() {
    if (!takes_picture() || interrupted()) return true;
    if (o_.sense.wanted()) {
        const render::VisualsOf visuals = [this](const Model& model) { return visual_world(model); };
        const auto threads = static_cast<unsigned>(threads_of_each(o_.threads, 1));
        const Result<> read = take_reading(o_.sense, {model_, simulation_->states(), simulation_->tick(),
                                                      simulation_->seed(), threads, visuals});
        progress_.clear();
        if (!read) fail(read.error());
        return read.ok();
    }
    doing_ = "drawing the picture  ";
    // The page asks for news of the run, too: without answers it draws a veil over the picture.
    const Result<> taken = take_snapshot(o_.snapshot, gateway_->url(), [this] {
        serve_requests();
        return rest() && !interrupted() && !pace_.quit;
    });
    progress_.clear();
    if (!taken) return fail(taken.error());
    say(stderr, "wrote {}, {} x {} pixels\n", o_.snapshot.file, o_.snapshot.width, o_.snapshot.height);
    return true;
}

/// Writes and checks what is due at this tick.
bool Run::look(const Schedule& due) {
    const Tick now = simulation_->tick();
    const bool looks =
        due.trace.at(now) || due.contacts.at(now) || due.dataset.at(now) || due.picture.at(now);
    if (looks && !await_states(false)) return !abandoned_ && (interrupted() || advance_to(now));
    if (due.trace.at(now) && !write_trace()) return false;
    if (due.contacts.at(now) && !write_contacts()) return false;
    if (due.dataset.at(now) && !write_dataset()) return false;
    if (due.hash.at(now)) say("{:.6f} s  {}\n", simulation_->time_s(), to_hex(simulation_->hash()));
    if (due.picture.at(now)) collect_paths();
    const Result<> checked = journal_->check(now, simulation_->hash());
    if (!checked) fail(checked.error());
    return checked.ok();
}

/// Beyond which there is nothing: the end of what a replay has.
Tick Run::last_tick() const {
    return journal_->replay() ? journal_->replay()->lineage.last() : kNever;
}

/// The replay continues in the next branch of its lineage, perhaps with other robots.
bool Run::go_on() {
    Result<> turned = journal_->go_on(simulation_->hash());
    if (turned) turned = restart(journal_->replay()->model, *journal_->from(), false);
    if (!turned) return stop(turned.error()), false;
    notices_.push_back(fmt::format("at {:.6f} s the replay continues in branch {} ({}) [branch]",
                                   simulation_->time_s(), journal_->replay()->branch.id,
                                   journal_->replay()->branch.reason));
    return true;
}

Tick Run::end_of_run() const {
    Tick end = o_.duration_s ? start_ + tick_at(*o_.duration_s, model_->dt_s) : kNever;
    if (o_.until_s) end = std::min(end, tick_at(*o_.until_s, model_->dt_s));
    if (o_.dataset.frames > 0)
        end = std::min(end, start_ + (o_.dataset.frames - 1) *
                                         std::max<Tick>(1, tick_at(o_.dataset.every_s, model_->dt_s)));
    return std::min(end, last_tick());
}

/// True at the end of the duration or on Ctrl-C, false if the run failed.
bool Run::drive() {
    const double dt = model_->dt_s;
    const auto every = [dt](double s) { return s > 0 ? s : dt; };
    const Schedule due{{trace_ ? every(o_.trace_every_s) : 0.0, dt, start_},
                       {contacts_ ? every(o_.contacts_every_s) : 0.0, dt, start_},
                       {dataset_ ? o_.dataset.every_s : 0.0, dt, start_},
                       {o_.hash_every_s, dt, start_},
                       {o_.paths_picture.empty() ? 0.0 : kPictureEvery_s, dt, start_}};
    const bool has_nodes = o_.shows_nodes() && o_.ros2.face.lockstep.empty();  // they keep real time
    const bool watched = (gateway_ != nullptr || has_nodes) && !takes_picture();
    const std::string speed = !o_.speed.empty() ? o_.speed : watched ? "world" : "max";
    pace_.speed = speed == "max" ? 0.0 : speed == "world" ? world_speed_ : std::stod(speed);
    pace_.paused = o_.paused;
    pace_.begin(start_);
    Tick seen = -1;  // the last tick whose due work is done
    for (;;) {
        serve_requests();
        if (abandoned_) return false;  // while a request waited for states
        if (journal_->turns_at(simulation_->tick()) && !go_on()) return false;
        const Tick now = simulation_->tick();
        if (now != seen && !look(due)) return false;
        seen = now;
        if (pace_.step_until && now >= *pace_.step_until) pace_.paused = true, pace_.step_until.reset();
        const Tick end = end_of_run();  // a replay may have turned to another branch
        if (now < end) over_ = false;
        if ((now >= end && !stays()) || interrupted() || pace_.quit) return take_picture();
        if (now >= last_tick()) pace_.paused = true;
        if (pace_.paused) {
            if (!rest()) return false;
            continue;
        }
        const Due pace(pace_.speed > 0 ? kPaceEvery_s * pace_.speed : 0.0, dt, start_);
        const Tick next = std::min(
            {now < end ? end : last_tick(), due.next(now), pace.next(now), journal_->next_check(now)});
        if (!advance_to(std::min(next, pace_.step_until.value_or(kNever)))) return false;
        if (pace_.speed <= 0) continue;
        const double due_s = static_cast<double>(simulation_->tick() - pace_.from) * dt / pace_.speed;
        std::this_thread::sleep_until(
            pace_.since + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(due_s)));
    }
}

void Run::report_notices() {
    for (const auto& notices :
         {simulation_->take_notices(), members_->take_notices(), journal_->take_notices(),
          std::exchange(notices_, {}), gateway_ ? gateway_->take_notices() : std::vector<std::string>()})
        for (const std::string& notice : notices) {
            if (log_) log_->event(simulation_->tick(), notice);
            if (!o_.quiet && o_.log != "-") progress_.clear(), say(stderr, "roboss: {}\n", notice);
        }
}

void Run::show_progress() {
    progress_.show(*simulation_, dataset_ ? fmt::format("frame {}  ", dataset_->frames()) : doing_);
    report_notices();
    if (log_) log_->write_state_if_due(*simulation_);
}

bool Run::write_trace() {
    const Result<> written = trace_->write(*model_, simulation_->tick(), simulation_->states());
    if (!written) fail(written.error());
    return written.ok();
}

bool Run::write_contacts() {
    const Result<> written = contacts_->write(*model_, simulation_->tick(), simulation_->contacts());
    if (!written) fail(written.error());
    return written.ok();
}

bool Run::write_dataset() {
    Result<> written = Error{"the world was changed while its data set was recorded",
                             "record the changed world in a run of its own", "world-changed"};
    if (dataset_->is_of(*model_)) written = dataset_->write(simulation_->states(), simulation_->tick());
    if (!written) fail(written.error());
    return written.ok();
}

void Run::collect_paths() {
    const std::vector<RobotState>& states = simulation_->states();
    paths_.resize(std::max(paths_.size(), states.size()));
    for (std::size_t r = 0; r < states.size(); ++r) {
        paths_[r].robot = model_->robots[r].name;
        paths_[r].points_W.push_back(base_pose(states[r]).p);
    }
}

}  // namespace roboss
