// Requests to a run (`roboss control`). Requests that change the state take effect at a tick between two
// windows and start a new branch of the journal; the others (pause, speed, window, Simulators) do not change
// the result and are noted in it.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "app/processes/private_folder.h"
#include "app/run/run.h"
#include "app/worlds/orders_file.h"
#include "model/accuracy.h"
#include "model/edit.h"
#include "model/order.h"
#include "sdf/load_world.h"

namespace roboss {
namespace {

using Words = std::vector<std::string>;
using Answer = Result<std::string>;

Answer wrong(const Words& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word.substr(0, 40);
    return Error{"unknown request '" + text + "'", "see `roboss control --help`", "unknown-request"};
}

/// Requests that change nothing are not logged.
bool only_asks(const Words& words) {
    return words.empty() || words[0] == "status" || words[0] == "groups" || words[0] == "bounds";
}

std::optional<double> number(const std::string& text) {
    try {
        std::size_t used = 0;
        const double value = std::stod(text, &used);
        if (used == text.size() && std::isfinite(value)) return value;
    } catch (const std::exception&) {
    }
    return std::nullopt;
}

std::string together(const Words& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

/// "x y z roll pitch yaw", as SDFormat writes a pose.
std::optional<Pose> pose_of(const std::string& text) {
    std::istringstream in(text);
    double x[6] = {};
    for (double& value : x)
        if (!(in >> value) || !(std::fabs(value) <= kOrderLimits.position)) return std::nullopt;
    std::string rest;
    if (in >> rest) return std::nullopt;
    return Pose{{x[0], x[1], x[2]}, from_rpy(x[3], x[4], x[5])};
}

std::string first_error(const Diagnostics& found) {
    for (const Diagnostic& d : found.items())
        if (d.severity == Severity::kError) return to_text(d);
    return "no model";
}

}  // namespace

void Run::serve_calls() {
    if (const std::int64_t now = simulation_->bus().now_ms(); traffic_.due(now))
        traffic_.take(simulation_->bus().flows(), now);
    for (ControlCall& call : simulation_->controller().control().take_calls())
        calls_.push_back(std::move(call));
    for (const ControlCall& call : std::exchange(calls_, {})) {
        const Tick tick = simulation_->tick();
        const Answer answer = execute(call.request.arguments);
        const std::string text = answer ? answer.value() : answer.error().text();
        if (answer && !only_asks(call.request.arguments)) {
            notices_.push_back(fmt::format("request {}: {}", call.request.arguments[0], text));
            if (journal_->writes()) journal_->writer().note(tick, text);
        }
        if (journal_->writes() && !only_asks(call.request.arguments))
            (void)journal_->writer().flush();  // a request that got its reply is in the journal
        simulation_->controller().control().answer(simulation_->bus(), call, answer.ok(), text);
    }
}

Answer Run::execute(const Words& words) {
    if (words.empty()) return wrong(words);
    const std::string& verb = words[0];
    const std::size_t n = words.size();
    if (verb == "status" && n == 1) return status();
    if (verb == "groups" && n == 1) return groups();
    if (verb == "bounds" && n == 1) return bounds();
    if (verb == "pause" && n == 1)
        return pace_.paused = true, fmt::format("paused at {:.6f} s", simulation_->time_s());
    if (verb == "resume" && n == 1)
        return resume(), fmt::format("resumed at {:.6f} s", simulation_->time_s());
    if (verb == "step" && n <= 2) return step(words);
    if (verb == "speed" && n == 2) return set_speed(words);
    if (verb == "window" && n == 2) return set_window(words);
    if (verb == "simulators" && (n == 2 || n == 3)) return change_simulators(words);
    if (verb == "save" && n == 2) return save(words[1]);
    if (verb == "rewind" && n == 2) return rewind(words[1]);
    if (verb == "accuracy" && n >= 2) return change_accuracy(words);
    if (verb == "add" && n == 5) return add_models(words);
    if (verb == "remove" && n >= 2) return remove_robots(words);
    if (verb == "quit" && n == 1) return pace_.quit = true, std::string("ending the run");
    return wrong(words);
}

void Run::resume() {
    pace_.paused = false;
    pace_.step_until.reset();
    pace_.begin(simulation_->tick());
}

Answer Run::step(const Words& words) {
    const std::optional<double> ticks = words.size() == 2 ? number(words[1]) : 1.0;
    if (!ticks || *ticks < 1 || *ticks > 1e15 || *ticks != std::floor(*ticks)) return wrong(words);
    resume();
    pace_.step_until = simulation_->tick() + static_cast<Tick>(*ticks);
    return fmt::format("stepping to tick {}, then pausing", *pace_.step_until);
}

Answer Run::set_speed(const Words& words) {
    const std::optional<double> speed = words[1] == "max"     ? 0.0
                                        : words[1] == "world" ? world_speed_
                                                              : number(words[1]);
    if (!speed || *speed < 0 || (*speed == 0 && words[1] != "max" && words[1] != "world"))
        return wrong(words);
    pace_.speed = *speed;
    pace_.begin(simulation_->tick());
    return fmt::format("speed {} from {:.6f} s", words[1], simulation_->time_s());
}

Answer Run::set_window(const Words& words) {
    const std::optional<double> ticks = words[1] == "auto" ? 0.0 : number(words[1]);
    if (!ticks || *ticks < 0 || *ticks > 1e6 || *ticks != std::floor(*ticks) ||
        (*ticks == 0 && words[1] != "auto"))
        return wrong(words);
    simulation_->controller().set_window(static_cast<Tick>(*ticks));
    return fmt::format("synchronization interval {} ticks from tick {}", words[1], simulation_->tick());
}

Answer Run::change_simulators(const Words& words) {
    if (words[1] == "kill" && words.size() == 3) return kill_simulator(words);
    if (words.size() != 2) return wrong(words);
    if (words[1] == "remove") {
        if (simulation_->remove_simulator()) return std::string("one Simulator is leaving");
        return Error{"the run has only one Simulator", "a run needs one; add another first",
                     "last-simulator"};
    }
    if (words[1] != "add") return wrong(words);
    if (Result<bool> started = members_->add_simulator(); !started) {
        return started.error();
    } else if (!started.value()) {
        simulation_->add_simulator();
    }
    return std::string("one more Simulator is starting");
}

/// Kills a process that this run started, to watch the run recover.
Answer Run::kill_simulator(const Words& words) {
    for (const MemberReport& member : simulation_->controller().members()) {
        if (std::to_string(member.number) != words[2] || !member.alive) continue;
        if (Result<> killed = members_->kill(member.name); !killed) return killed.error();
        return fmt::format("Simulator {} ({}) killed", words[2], member.name);
    }
    return Error{"there is no Simulator '" + words[2] + "'", "`roboss control status` lists them",
                 "no-simulator"};
}

Answer Run::save(const std::string& file) {
    if (Result<> saved = simulation_->save(file); !saved) return saved.error();
    return fmt::format("saved {:.6f} s (tick {}) in {}", simulation_->time_s(), simulation_->tick(), file);
}

Answer Run::rewind(const std::string& time_text) {
    if (!journal_->writes())
        return Error{"the run has no journal", "start it with --journal FILE", "no-journal"};
    if (Result<> flushed = journal_->writer().flush(); !flushed) return flushed.error();
    const std::string where =
        o_.journal + (time_text.find('@') == std::string::npos
                          ? fmt::format("#{}@{}", journal_->writer().branch(), time_text)
                          : time_text);
    Result<JournalLocation> location = parse_location(where);
    if (!location) return location.error();
    Result<Journal> journal = Journal::open(o_.journal);
    if (!journal) return journal.error();
    Result<JournalTime> time = find_time(journal.value(), location.value());
    if (!time) return time.error();
    Result<SavedRun> run =
        journal.value().run_at(time.value().branch, *time.value().model, time.value().tick);
    if (!run) return run.error();
    const std::string text =
        fmt::format("rewound from tick {} to tick {}", simulation_->tick(), time.value().tick);
    if (Result<> again = start_again(time.value().model, run.value(), {time.value().branch.id, text, true});
        !again)
        return again.error();
    return text + fmt::format(", branch {}", journal_->writer().branch());
}

/// The run continues with this Model, at the same tick.
Answer Run::change_model(const ModelEdit& edit, const std::string& what) {
    SavedRun run = simulation_->saved_run();
    run.states = carry_over(edit, run.states);
    std::erase_if(run.orders, [&](LoggedOrder& o) { return !carry_over(edit, o.order); });
    visuals_.change(*model_, *edit.model);
    if (edit.model->robots.size() < model_->robots.size())  // sensor samples are stored by RobotId
        for (auto& [client, memory] : run.memory) memory = without_samples(memory);
    const std::string text = fmt::format("{} at {:.6f} s (tick {})", what, simulation_->time_s(), run.tick);
    const BranchId parent = journal_->writes() ? journal_->writer().branch() : 0;
    if (Result<> again = start_again(edit.model, run, {parent, text, false}); !again) return again.error();
    return text;
}

Answer Run::change_accuracy(const Words& words) {
    AccuracySpec spec;
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::size_t equals = words[i].find('=');
        if (equals == std::string::npos) {
            spec.setting = words[i];
            continue;
        }
        const std::optional<double> value = number(words[i].substr(equals + 1));
        if (!value) return wrong(words);
        spec.numbers.push_back({words[i].substr(0, equals), *value});
    }
    Result<ModelEdit> edit = with_accuracy(*model_, spec);
    if (!edit) return edit.error();
    return change_model(edit.value(), together(words));
}

/// add FILE CONTENT POSE NAME: the request carries the content, since the file may be on another computer.
Answer Run::add_models(const Words& words) {
    const std::optional<Pose> X_WA = pose_of(words[3]);
    if (!X_WA)
        return Error{"'" + words[3] + "' is not a pose",
                     "give \"x y z roll pitch yaw\", m and rad, none above 1e9", "bad-pose"};
    const std::optional<PrivateFolder> folder = PrivateFolder::make("add");
    if (!folder)
        return Error{"no temporary folder can be created", "set TMPDIR to a writable folder with free space",
                     "not-writable"};
    const std::filesystem::path file = folder->path() / std::filesystem::path(words[1]).filename();
    if (!(std::ofstream(file) << words[2]))
        return Error{file.string() + " cannot be written",
                     "free some space there, and give the name of a file", "not-writable"};
    Diagnostics found;
    std::optional<World> world = load_world(file.string(), {o_.paths, {}, is_shown()}, found);
    CompileOptions options;
    options.dt_s = model_->dt_s;
    const auto addition = world && !found.has_errors() ? compile(*world, options, found) : nullptr;
    if (!addition) return Error{first_error(found), "fix the file", "bad-model"};
    for (const Diagnostic& d : found.items())
        if (d.severity == Severity::kWarning) notices_.push_back(to_text(d));
    Result<ModelEdit> edit = with_models(*model_, *addition, *X_WA, words[4]);
    if (!edit) return edit.error();
    if (is_shown())
        visuals_.add({*model_, *edit.value().model, *addition}, std::move(*world), *X_WA, words[4]);
    return change_model(edit.value(),
                        fmt::format("{} robots of {} added", addition->robots.size(), words[1]));
}

Answer Run::remove_robots(const Words& words) {
    Result<ModelEdit> edit = without_robots(*model_, {words.begin() + 1, words.end()});
    if (!edit) return edit.error();
    return change_model(edit.value(), together(words));
}

}  // namespace roboss
