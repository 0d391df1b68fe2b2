// Requests to a run (`roboss control`). Requests that change the state take effect at a tick between two
// windows and start a new branch of the journal; the others (pause, speed, window, Simulators) do not change
// the result and are noted in it.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "app/processes/private_folder.h"
#include "app/run/added_findings.h"
#include "app/run/journal_location.h"
#include "app/run/run.h"
#include "app/run/run_outputs.h"
#include "app/run/save_place.h"
#include "app/worlds/orders_file.h"
#include "model/accuracy.h"
#include "model/edit.h"
#include "physics/start_overlaps.h"
#include "sdf/load_world.h"

namespace roboss {
namespace {

std::string first_error(const Diagnostics& found) {
    for (const Diagnostic& d : found.items())
        if (d.severity == Severity::kError) return to_text(d);
    return "no model";
}

std::string robot_count(std::size_t count) {
    return fmt::format("{} robot{}", count, count == 1 ? "" : "s");
}

Error no_journal() {
    return {"the run has no journal, so earlier moments are not kept",
            "start it with --journal FILE (run.sh --live does)", "no-journal"};
}

/// Requests that save or change the world, and so have to wait for all of it.
template <class A>
constexpr bool needs_states(const A&) {
    return std::is_same_v<A, SaveRun> || std::is_same_v<A, ChangeAccuracy> || std::is_same_v<A, AddModels> ||
           std::is_same_v<A, RemoveRobots> || std::is_same_v<A, CopyRobots> ||
           std::is_same_v<A, RestoreRobots>;
}

}  // namespace

void Run::take_requests() {
    answer_previews();
    for (ControlCall& call : simulation_->take_control_calls()) {
        const Address asker = call.from;
        ControlAction action = call.request.action;
        take(asker, std::move(action), [this, call = std::move(call)](ControlOutcome outcome) {
            simulation_->answer(call, std::move(outcome));
        });
    }
    if (!socket_) return;
    for (ControlSocket::Call& call : socket_->take_calls()) {
        const auto shared = std::make_shared<ControlSocket::Call>(std::move(call));
        take({Role::kClient, ++socket_askers_}, shared->action(),
             [shared](ControlOutcome outcome) { shared->answer(std::move(outcome)); });
    }
}

void Run::take(Address asker, ControlAction action, std::function<void(ControlOutcome)> answer) {
    const auto* wanted = std::get_if<PreviewRun>(&action);
    if (wanted == nullptr || journal_->file().empty())
        return requests_.push_back({std::move(action), std::move(answer)});
    if (!preview_) preview_ = std::make_unique<JournalPreview>(journal_->file());
    preview_->ask({asker, *wanted, std::move(answer)}, model_, journal_->branch());
}

void Run::answer_previews() {
    if (!preview_) return;
    for (JournalPreview::Reply& reply : preview_->take_replies()) reply.answer(std::move(reply.outcome));
}

void Run::serve_requests() {
    if (const std::int64_t now = simulation_->bus().now_ms(); traffic_.due(now))
        traffic_.take(simulation_->bus().flows(), now);
    take_profile();
    measure();
    take_requests();
    for (const Request& request : std::exchange(requests_, {})) {
        const ControlAction& action = request.action;
        const Tick tick = simulation_->tick();
        ControlOutcome outcome = execute(action);
        if (const auto* done = std::get_if<ControlDone>(&outcome)) {
            notices_.push_back(fmt::format("request {}: {}", control_verb(action), done->text));
            // Further lines say what was found about robots that came.
            if (journal_->writes())
                journal_->writer().note(tick, done->text.substr(0, done->text.find('\n')));
        }
        if (journal_->writes() && !only_asks(action))
            (void)journal_->writer().flush();  // a request that got its reply is in the journal
        request.answer(std::move(outcome));
    }
}

ControlOutcome Run::execute(const ControlAction& action) {
    return std::visit(
        [this](const auto& a) -> ControlOutcome {
            using A = std::decay_t<decltype(a)>;
            if constexpr (std::is_same_v<A, GetStatus>) {
                return status(a.robots);
            } else if constexpr (std::is_same_v<A, GetGroups>) {
                return groups();
            } else if constexpr (std::is_same_v<A, GetBounds>) {
                return bounds();
            } else if constexpr (std::is_same_v<A, GetProfile>) {
                return profile();
            } else if constexpr (std::is_same_v<A, GetTimeline>) {
                return journal_->timeline(model_->dt_s);
            } else if constexpr (std::is_same_v<A, PreviewRun>) {
                return ControlRefused(no_journal());  // take() serves those of a run with a journal
            } else {
                const Tick tick = simulation_->tick();
                if (needs_states(a) && !await_states(true)) return ControlRefused(no_states());
                Done done = act(a);
                if (!done) return ControlRefused(done.error());
                return ControlDone{tick, std::move(done).value()};
            }
        },
        action);
}

Run::Done Run::act(const PauseRun&) {
    pace_.paused = true;
    return fmt::format("paused at {:.6f} s", simulation_->time_s());
}

Run::Done Run::act(const ResumeRun&) {
    pace_.resume(simulation_->tick());
    return fmt::format("resumed at {:.6f} s", simulation_->time_s());
}

Run::Done Run::act(const StepRun& step) {
    pace_.resume(simulation_->tick());
    pace_.step_until = simulation_->tick() + step.ticks;
    return fmt::format("stepping to tick {}, then pausing", *pace_.step_until);
}

Run::Done Run::act(const QuitRun&) {
    pace_.quit = true;
    return std::string("ending the run");
}

Run::Done Run::act(const SetSpeed& speed) {
    pace_.speed = speed.kind == SetSpeed::Kind::kMax     ? 0.0
                  : speed.kind == SetSpeed::Kind::kWorld ? world_speed_
                                                         : speed.factor;
    pace_.begin(simulation_->tick());
    return fmt::format("speed {} from {:.6f} s", pace_.speed > 0 ? fmt::format("{:g}", pace_.speed) : "max",
                       simulation_->time_s());
}

Run::Done Run::act(const SetWindow& window) {
    simulation_->set_window(window.ticks);
    return fmt::format("synchronization interval {} ticks from tick {}",
                       window.ticks > 0 ? std::to_string(window.ticks) : "auto", simulation_->tick());
}

Run::Done Run::act(const AddSimulator&) {
    Result<bool> started = members_->add_simulator();
    if (!started) return started.error();
    if (!started.value()) simulation_->add_simulator();
    return std::string("one more Simulator is starting");
}

Run::Done Run::act(const RemoveSimulator&) {
    if (simulation_->remove_simulator()) return std::string("one Simulator is leaving");
    return Error{"the run has only one Simulator", "a run needs one; add another first", "last-simulator"};
}

Run::Done Run::act(const KillSimulator& kill) {
    for (const MemberReport& member : simulation_->members()) {
        if (member.number != kill.id || !member.alive) continue;
        if (Result<> killed = members_->kill(member.name); !killed) return killed.error();
        return fmt::format("Simulator {} ({}) killed", kill.id, member.name);
    }
    return Error{fmt::format("there is no Simulator {}", kill.id), "`roboss control status` lists them",
                 "no-simulator"};
}

Run::Done Run::act(const SaveRun& save) {
    const Result<std::filesystem::path> file = save_place(o_.save_folder, save, inputs_of(o_));
    if (!file) return file.error();
    SavedRun run = saved_run();
    if (Result<> saved = save_run(file.value().string(), *model_, run); !saved) return saved.error();
    last_save_ = Kept{model_, std::move(run), journal_->branch()};
    return fmt::format("saved {:.6f} s (tick {}) in {}", simulation_->time_s(), simulation_->tick(),
                       file.value().string());
}

Run::Done Run::act(const RewindRun& rewind) {
    if (journal_->replay()) return seek(rewind);
    if (!journal_->writes()) return no_journal();
    if (Result<> flushed = journal_->writer().flush(); !flushed) return flushed.error();
    const BranchId branch = rewind.branch > 0 ? rewind.branch : journal_->writer().branch();
    Result<Journal> journal = Journal::open_own(o_.journal);
    if (!journal) return journal.error();
    Result<JournalTime> time = find_time(journal.value(), {o_.journal, branch, rewind.time_s});
    if (!time) return time.error();
    Result<SavedRun> run =
        journal.value().run_at(time.value().branch, *time.value().model, time.value().tick);
    if (!run) return run.error();
    const std::string text =
        fmt::format("rewound from tick {} to tick {}", simulation_->tick(), time.value().tick);
    if (Result<> again =
            start_again(time.value().model, run.value(), {time.value().branch.id, text, true, nullptr});
        !again)
        return again.error();
    return text + fmt::format(", branch {}", journal_->writer().branch());
}

/// A replay turns to another time: a new Simulation on the same Bus, which writes nothing.
Run::Done Run::seek(const RewindRun& to) {
    const Tick before = simulation_->tick();
    if (Result<> turned = journal_->seek(to.branch, to.time_s); !turned) return turned.error();
    if (Result<> again = restart(journal_->replay()->model, *journal_->from(), true); !again)
        return again.error();
    busy_until_ = journal_->start();
    if (!advance_to(journal_->start()))
        return Error{"the replay could not be turned to that time", "see the messages above"};
    pace_.begin(simulation_->tick());
    return fmt::format("turned from tick {} to tick {} of branch {}", before, simulation_->tick(),
                       journal_->replay()->branch.id);
}

Run::Done Run::act(const AddBookmark& add) {
    if (journal_->replay())
        return Error{"a replay writes nothing into its file", "set bookmarks while the run is recorded",
                     "read-only"};
    if (!journal_->writes()) return no_journal();
    const BranchId branch = add.branch > 0 ? add.branch : journal_->branch();
    const Tick tick = add.time_s < 0 ? simulation_->tick() : tick_at(add.time_s, model_->dt_s);
    const auto holds = [&](const BranchSpan& s) { return s.id == branch; };
    const std::vector<BranchSpan> spans = journal_->writer().spans();
    const auto span = std::ranges::find_if(spans, holds);
    if (span == spans.end() || tick > std::max(span->end, simulation_->tick()) ||
        tick < Lineage::of(spans, branch).first())
        return Error{fmt::format("the journal has nothing at {:.6f} s of branch {}", add.time_s, branch),
                     "`roboss control timeline` shows what it has", "no-such-time"};
    Result<std::int64_t> added = journal_->writer().add_bookmark({0, branch, tick, add.name});
    if (!added) return added.error();
    return fmt::format("bookmark {} '{}' at {:.6f} s of branch {}", added.value(), add.name,
                       static_cast<double>(tick) * model_->dt_s, branch);
}

Run::Done Run::act(const RemoveBookmark& remove) {
    if (!journal_->writes()) return no_journal();
    if (Result<> removed = journal_->writer().remove_bookmark(remove.id); !removed) return removed.error();
    return fmt::format("bookmark {} removed", remove.id);
}

Run::Done Run::act(const ResetRun& reset) {
    if (!world_model_)
        return Error{"a replay has no beginning to return to", "reset the run itself", "no-reset"};
    if (reset.to == ResetRun::To::kLastSave) return reset_to_save();
    SavedRun run;
    run.world_file = o_.world;
    run.seed = simulation_->seed();
    for (std::size_t i = 0; i < world_model_->robots.size(); ++i)
        run.states.push_back(initial_state(*world_model_, RobotId(i)));
    const std::string text = fmt::format("reset from tick {} to the world's beginning", simulation_->tick());
    const BranchId parent = journal_->writes() ? journal_->writer().branch() : 0;
    if (Result<> again = start_again(world_model_, run, {parent, text, true, &orders_}); !again)
        return again.error();
    if (pace_.step_until) pace_.paused = true, pace_.step_until.reset();
    if (!journal_->writes() && !last_save_) visuals_.keep_only(*world_model_);
    return journal_->writes() ? text + fmt::format(", branch {}", journal_->writer().branch()) : text;
}

Run::Done Run::reset_to_save() {
    if (!last_save_)
        return Error{"nothing has been saved in this run",
                     "save first: `roboss control save FILE`, or start with --from", "no-save"};
    const auto [model, run, branch] = *last_save_;
    const std::string text =
        fmt::format("reset from tick {} to the last save, tick {}", simulation_->tick(), run.tick);
    if (Result<> again = start_again(model, run, {branch, text, true, nullptr}); !again) return again.error();
    if (pace_.step_until) pace_.paused = true, pace_.step_until.reset();
    return journal_->writes() ? text + fmt::format(", branch {}", journal_->writer().branch()) : text;
}

/// The run continues with this Model, at the same tick.
Run::Done Run::change_model(const ModelEdit& edit, const std::string& what,
                            std::span<const RobotState> arrived) {
    SavedRun run = simulation_->saved_run();
    run.states = carry_over(edit, run.states);
    std::ranges::copy(arrived, run.states.end() - std::ssize(arrived));
    std::erase_if(run.orders, [&](LoggedOrder& o) { return !carry_over(edit, o.order); });
    visuals_.change(*model_, *edit.model);
    if (edit.model->robots.size() < model_->robots.size())  // sensor samples are stored by RobotId
        for (auto& [client, memory] : run.memory) memory = without_samples(memory);
    const std::string text = fmt::format("{} at {:.6f} s (tick {})", what, simulation_->time_s(), run.tick);
    const BranchId parent = journal_->writes() ? journal_->writer().branch() : 0;
    if (Result<> again = start_again(edit.model, run, {parent, text, false, nullptr}); !again)
        return again.error();
    if (!journal_->writes() && !last_save_) visuals_.keep_only(*model_);  // there is no way back
    return text;
}

Run::Done Run::act(const ChangeAccuracy& change) {
    AccuracySpec spec;
    spec.setting = change.setting;
    std::string text = "accuracy";
    if (!change.setting.empty()) text += " " + change.setting;
    for (const ChangeAccuracy::Number& n : change.numbers) {
        spec.numbers.push_back({n.name, n.value});
        text += fmt::format(" {}={}", n.name, n.value);
    }
    Result<ModelEdit> edit = with_accuracy(*model_, spec);
    if (!edit) return edit.error();
    return change_model(edit.value(), text);
}

/// The findings about robots that come: warnings, and notes about their start.
std::vector<std::string> Run::findings_of(const ModelEdit& edit, Diagnostics found) const {
    for (const Diagnostic& d : edit.found.items()) found.add(d);
    report_overlaps(*edit.model, carry_over(edit, simulation_->saved_run().states), model_->robots.size(),
                    found);
    return told_findings(found);
}

Run::Done Run::act(const AddModels& add) {
    const std::optional<PrivateFolder> folder = PrivateFolder::make("add");
    if (!folder)
        return Error{"no temporary folder can be created", "set TMPDIR to a writable folder with free space",
                     "not-writable"};
    const std::filesystem::path file = folder->path() / std::filesystem::path(add.file).filename();
    if (!(std::ofstream(file) << add.content))
        return Error{file.string() + " cannot be written",
                     "free some space there, and give the name of a file", "not-writable"};
    Diagnostics found;
    std::optional<World> world = load_world(file.string(), {o_.paths, {}, true}, found);
    const std::string& name = add.copies.size() == 1 ? add.copies.front().name : add.name;
    if (world) add_drives(o_, name, *world);
    CompileOptions options;
    options.dt_s = model_->dt_s;
    const auto addition = world && !found.has_errors() ? compile(*world, options, found) : nullptr;
    found = under_name(found, file.string(), add.file);
    if (!addition) return Error{first_error(found), "fix the file", "bad-model"};
    std::vector<CopyPlace> places = add.copies;
    if (places.empty()) places.push_back({add.name, add.X_WA});
    Result<ModelEdit> edit =
        with_models(*model_, *addition, places, add.on_ground ? Standing::kOnGround : Standing::kAsPlaced);
    if (!edit) return edit.error();
    const std::vector<std::string> told = findings_of(edit.value(), found);
    if (keeps_looks(*edit.value().model))
        visuals_.add({*model_, *edit.value().model, *addition}, std::move(*world), places);
    const std::size_t came = edit.value().model->robots.size() - model_->robots.size();
    Done done = change_model(edit.value(), fmt::format("{} of {} added", robot_count(came), add.file));
    if (!done) return done;
    std::string text = std::move(done).value();
    for (const std::string& finding : told) text += "\n" + finding;
    return text;
}

Run::Done Run::act(const RemoveRobots& remove) {
    Result<ModelEdit> edit = without_robots(*model_, remove.names);
    if (!edit) return edit.error();
    constexpr std::size_t kNamedMost = 10;  // in the notice and the journal
    std::string text = "remove";
    for (std::size_t i = 0; i < std::min(remove.names.size(), kNamedMost); ++i) text += " " + remove.names[i];
    if (remove.names.size() > kNamedMost)
        text += fmt::format(" and {} more", remove.names.size() - kNamedMost);
    const RemovedRobots::Removal removal{model_, edit.value().now, simulation_->saved_run().states,
                                         visuals_.worlds_of(*model_)};
    Done done = change_model(edit.value(), text);
    if (done) removed_.keep(removal);
    return done;
}

Run::Done Run::act(const CopyRobots& copy) {
    const std::vector<RobotState> states = simulation_->saved_run().states;
    std::vector<RobotFrom> robots;
    for (const CopyRobots::Copy& one : copy.copies) {
        const std::optional<RobotId> original = model_->find_robot(one.robot);
        if (!original)
            return Error{"there is no robot '" + one.robot + "' in the world",
                         "see `roboss control status` for their names", "no-robot"};
        const std::vector<double>& q = states[original->index()].q;
        robots.push_back({model_, *original, one.name, one.X_WR, {q.begin() + 7, q.end()}});
    }
    Result<ModelEdit> edit = with_robots(*model_, robots);
    if (!edit) return edit.error();
    if (keeps_looks(*edit.value().model)) visuals_.copy(*model_, *edit.value().model, copy.copies);
    return change_model(edit.value(), robot_count(robots.size()) + " copied");
}

Run::Done Run::act(const RestoreRobots& restore) {
    Result<std::vector<RemovedRobot>> found = removed_.find(restore.names);
    if (!found) return found.error();
    std::vector<RobotFrom> robots;
    std::vector<RobotState> states;
    for (const RemovedRobot& removed : found.value()) {
        const Robot& robot = removed.model->robots[removed.robot.index()];
        robots.push_back({removed.model, removed.robot, robot.name, robot.X_WR, robot.start_q, true});
        states.push_back(removed.state);
    }
    Result<ModelEdit> edit = with_robots(*model_, robots);
    if (!edit) return edit.error();
    for (const RemovedRobot& removed : found.value())
        if (keeps_looks(*edit.value().model))
            visuals_.bring_back(*model_, *edit.value().model, removed.worlds);
    Done done = change_model(edit.value(), robot_count(robots.size()) + " restored", states);
    if (done) removed_.forget(restore.names);
    return done;
}

}  // namespace roboss
