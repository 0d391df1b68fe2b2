// Requests from the command line.
#include "app/commands/control_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "app/commands/add_copies.h"
#include "app/commands/exit_codes.h"
#include "app/commands/numbers.h"
#include "app/local/control_socket.h"
#include "app/local/run_list.h"
#include "app/output/say.h"
#include "app/processes/interrupt.h"
#include "app/run/run.h"
#include "client/control_text.h"
#include "gateway/run_json.h"

namespace roboss {
namespace {

constexpr std::int64_t kAgain_ms = 250;
constexpr double kPatience_s = 10;

const char* const kControlFooter =
    R"(It reaches every run of this computer, by its name (`roboss runs` lists them) or, if there is only one, without. With a
network option (--controller, --keys) it reaches a `roboss controller` on another computer, as the other members of the
run do. A request takes effect at the end of the current window. pause, step, speed, window and
simulators do not change the result. rewind, reset, add, remove, copy, restore and accuracy change the world at a tick;
with a journal, each starts a new branch there.

Examples:
  roboss run world.sdf --headless --journal run.journal      in another terminal
  roboss control pause
  roboss control --simulation world status                   of several runs, the one of this name
  roboss control step 100
  roboss control rewind 12.5
  roboss control add robot.sdf --pose "1 0 0.5 0 0 0" --name visitor
  roboss control add robot.sdf --name crowd --count 1000 --grid "2 2 40" --pose "0 50 0.5 0 0 0"
  roboss control remove visitor 'crowd_*'
  roboss control restore visitor
  roboss control copy car_1 car_2 --pose "3 0 0.1 0 0 1.57"
  roboss control reset
  roboss control save noon.roboss --overwrite
  roboss control quit --yes

On a terminal, quit, kill and overwriting ask for confirmation; --yes answers it. Scripts are not asked.

Exit codes: 0 done, 1 no run was found or a file cannot be read, 2 wrong usage, 3 the run refused the request.)";

struct ControlCommandOptions {
    MemberOptions member;
    std::string value, pose = "0 0 0 0 0 0", name;
    std::vector<std::string> values;
    CopyOptions copies;
    bool overwrite = false, yes = false, json = false, on_ground = false;
};

using Ask = std::function<void(const std::vector<std::string>&)>;

void add_yes(CLI::App& command, ControlCommandOptions& o) {
    command.add_flag("-y,--yes", o.yes, "do not ask for confirmation (only a terminal is asked)");
}

void add_save(CLI::App& command, ControlCommandOptions& o, const Ask& ask) {
    CLI::App* save = command.add_subcommand(
        "save", "save the state; the Controller writes the file on its computer, below its --save-folder");
    save->add_option("file", o.value)->required();
    save->add_flag("--overwrite", o.overwrite, "replace a saved run of this name");
    add_yes(*save, o);
    save->callback([ask, &o] { ask(save_words(o.value, o.overwrite)); });
}

void add_bookmark(CLI::App& command, ControlCommandOptions& o, const Ask& ask) {
    CLI::App* sub = command.add_subcommand(
        "bookmark", "name the present moment, or TIME or #BRANCH@TIME; or remove a name");
    sub->add_option("words", o.values, "NAME [TIME], or remove and a number from `timeline`")
        ->required()
        ->expected(1, 2);
    sub->callback([ask, &o] {
        std::vector<std::string> words{"bookmark"};
        words.insert(words.end(), o.values.begin(), o.values.end());
        ask(words);
    });
}

void add_plain(CLI::App& command, ControlCommandOptions& o, const Ask& ask) {
    const auto none = [&](const char* verb, const char* what) {
        command.add_subcommand(verb, what)->callback([verb, ask] { ask({verb}); });
    };
    const auto one = [&](const char* verb, const char* what, const char* value, bool required) {
        CLI::App* sub = command.add_subcommand(verb, what);
        sub->add_option(value, o.value)->required(required);
        sub->callback([verb, ask, &o] {
            if (o.value.empty()) return ask({verb});
            ask({verb, o.value});
        });
    };
    none("status", "print time, speed, Simulators, state hash and robots, as one JSON object");
    none("pause", "pause at the end of the current window; members stay connected");
    none("resume", "continue a paused run");
    one("step", "advance by this many ticks (default: 1), then pause", "ticks", false);
    one("speed", "set the speed: simulated seconds per real second, max or world", "speed", true);
    one("window", "set the synchronization interval in ticks, or auto", "window", true);
    none("groups", "print the Simulator and the island of each robot, as JSON");
    none("profile",
         "print where the time of the steps went in the last second, as JSON; the first answer is empty");
    none("bounds", "print the bounding box that each robot swept in the last window (m), as JSON");
    add_save(command, o, ask);
    one("rewind", "return to this time (s) of the journal, or #BRANCH@TIME, and continue from there", "time",
        true);
    none("timeline", "print the branches and bookmarks of the journal, as JSON");
    one("preview",
        "restore this time (s) of the journal, or #BRANCH@TIME, while the run goes on, and print its tick as "
        "JSON",
        "time", true);
    add_bookmark(command, o, ask);
    one("reset",
        "return to the world's beginning (start, the default; added robots go, removed ones return) or to "
        "the "
        "last `save` of this run (save), and continue from there",
        "to", false);
    CLI::App* quit = command.add_subcommand("quit", "end the run as if its duration were over");
    add_yes(*quit, o);
    quit->callback([ask] { ask({"quit"}); });
}

void ask_to_add(ControlCommandOptions& o, const Ask& ask, int& exit_code) {
    std::ifstream in(o.value, std::ios::binary);
    std::stringstream content;
    exit_code = kBadInput;
    if (!in || !(content << in.rdbuf()))
        return print(Error{o.value + " cannot be read", "check the path", "no-file"});
    std::vector<std::string> words{"add", o.value, content.str(), o.pose, o.name};
    if (o.copies.count > 1 || !o.copies.poses.empty()) {
        o.copies.pose = o.pose, o.copies.name = o.name, o.copies.file = o.value;
        Result<std::string> copies = copies_text(o.copies);
        if (!copies) return print(copies.error());
        words.push_back(std::move(copies).value());
    }
    if (o.on_ground) words.push_back("on-ground");
    ask(words);
}

void add_changes(CLI::App& command, ControlCommandOptions& o, const Ask& ask, int& exit_code) {
    const auto all = [&o, ask](const char* verb) {
        std::vector<std::string> words{verb};
        words.insert(words.end(), o.values.begin(), o.values.end());
        ask(words);
    };
    CLI::App* sub = command.add_subcommand(
        "simulators", "add or remove a Simulator that the run itself started, or kill one of its processes");
    sub->add_option("action", o.values, "add, remove, or kill and a number from `status`")
        ->required()
        ->expected(1, 2);
    add_yes(*sub, o);
    sub->callback([all] { all("simulators"); });
    sub = command.add_subcommand(
        "accuracy", "change the accuracy: fast, standard or high, and numbers (tolerance=1e-10)");
    sub->add_option("values", o.values)->required();
    sub->callback([all] { all("accuracy"); });
    sub = command.add_subcommand("remove", "remove robots from the world, by name");
    sub->add_option("robots", o.values)->required();
    sub->callback([all] { all("remove"); });
    sub =
        command.add_subcommand("restore", "bring back robots that were removed, as they were then, by name");
    sub->add_option("robots", o.values)->required();
    sub->callback([all] { all("restore"); });
    sub = command.add_subcommand("copy", "add a copy of a robot with its present joint positions, at rest");
    sub->add_option("robot", o.value, "name of the original")->required();
    sub->add_option("name", o.name, "name of the copy")->required();
    sub->add_option("--pose", o.pose, "\"x y z roll pitch yaw\" of the copy, m and rad")->required();
    sub->callback([&o, ask] { ask({"copy", o.value, o.name, o.pose}); });
    sub = command.add_subcommand("add", "add the models of an SDF, URDF or MJCF file to the world");
    sub->add_option("file", o.value,
                    "SDF, URDF or MJCF file; its meshes are looked up on the Controller's computer")
        ->required();
    sub->add_option("--pose", o.pose, "\"x y z roll pitch yaw\", m and rad")->capture_default_str();
    sub->add_option("--name", o.name, "name in the world (default: the name in the file)");
    CLI::Option* count =
        sub->add_option("--count", o.copies.count, "add so many copies at once, NAME_0, NAME_1 ...")
            ->check(whole_number(1, 1'000'000));
    sub->add_option("--grid", o.copies.grid,
                    "\"DX DY [COLUMNS]\": distances of the copies, m (default: 1 m, a square)")
        ->needs(count);
    sub->add_option("--poses", o.copies.poses,
                    "add a copy for each line \"NAME x y z roll pitch yaw\" of this file, m and rad")
        ->excludes(count)
        ->excludes("--pose")
        ->excludes("--name");
    sub->add_flag("--on-ground", o.on_ground, "stand them on the scenery below: only x, y and turn count");
    sub->callback([&o, ask, &exit_code] { ask_to_add(o, ask, exit_code); });
}

std::optional<ControlOutcome> find_reply(const std::vector<Envelope>& inbox) {
    for (const Envelope& envelope : inbox)
        if (const auto* reply = std::get_if<ControlReply>(&envelope.message)) return reply->outcome;
    return std::nullopt;
}

/// The reply of a run of this computer; with --patience, of one that begins within that time.
std::optional<ControlOutcome> reply_of_listed_run(const MemberOptions& options, const ControlAction& action) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(options.patience_s);
    const std::string name = options.named ? options.network.simulation : "";
    for (;;) {
        const Result<ListedRun> run = find_run(name);
        Result<ControlOutcome> reply = run ? ask_run(run.value().socket, action) : run.error();
        if (reply) return std::move(reply).value();
        if (reply.error().code != "no-run" || Clock::now() >= end || interrupted())
            return say(stderr, "roboss control: {}\n", reply.error().text()), std::nullopt;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

/// The reply to a request; nullopt if no run was found (it has been reported) or on Ctrl-C.
std::optional<ControlOutcome> reply_of_run(const MemberOptions& options, const ControlAction& action) {
    if (!options.networked) return reply_of_listed_run(options, action);
    MemberOptions patient = options;
    if (patient.patience_s <= 0) patient.patience_s = kPatience_s;
    Member member("control", patient);
    if (!member.open()) return std::nullopt;
    const Address self = member.new_address(Role::kClient);
    std::vector<Envelope> inbox;
    std::int64_t asked_ms = -kAgain_ms;
    for (;;) {
        const std::int64_t now = member.bus().now_ms();
        if (now - asked_ms >= kAgain_ms) {
            asked_ms = now;
            member.bus().send(self, kControllerAddress, ControlRequest{1, action});
        }
        member.bus().drain(self, inbox);
        if (std::optional<ControlOutcome> reply = find_reply(inbox)) return reply;
        if (interrupted() || !member.wait()) return std::nullopt;
    }
}

/// A command has time: it waits for the exact moment.
ControlAction patient(ControlAction action) {
    if (auto* preview = std::get_if<PreviewRun>(&action)) preview->patience_ms = 10'000;
    return action;
}

/// What a terminal is asked before this; empty: nothing.
std::string question_before(const ControlAction& action) {
    if (std::holds_alternative<QuitRun>(action)) return "End the run?";
    if (const auto* kill = std::get_if<KillSimulator>(&action))
        return fmt::format("Kill Simulator {}?", kill->id);
    return {};
}

bool confirmed(const std::string& question) {
    say(stderr, "{} [y/N] ", question);
    std::string reply;
    std::getline(std::cin, reply);
    if (reply == "y" || reply == "Y" || reply == "yes") return true;
    say(stderr, "roboss control: nothing was done\n");
    return false;
}

/// The file of a request to save that was refused because it exists; empty: it was not.
std::string file_that_exists(const ControlAction& action, const std::optional<ControlOutcome>& outcome) {
    const auto* save = std::get_if<SaveRun>(&action);
    const auto* refused = outcome ? std::get_if<ControlRefused>(&*outcome) : nullptr;
    return save != nullptr && refused != nullptr && refused->code == "file-exists" ? save->file : "";
}

std::string text_of(const ControlOutcome& outcome) {
    if (const auto* status = std::get_if<RunStatus>(&outcome)) return status_json(*status);
    if (const auto* groups = std::get_if<RobotGroups>(&outcome)) return groups_json(*groups);
    if (const auto* bounds = std::get_if<RobotBounds>(&outcome)) return bounds_json(*bounds);
    if (const auto* profile = std::get_if<RunProfile>(&outcome)) return profile_json(*profile);
    if (const auto* timeline = std::get_if<RunTimeline>(&outcome)) return timeline_json(*timeline);
    if (const auto* preview = std::get_if<RunPreview>(&outcome)) return preview_json(*preview);
    return std::get<ControlDone>(outcome).text;
}

/// One object for every reply; what only asks has its own.
std::string outcome_json(const ControlOutcome& outcome) {
    using Json = nlohmann::ordered_json;
    Json o;
    if (const auto* done = std::get_if<ControlDone>(&outcome)) return done_json(done->tick, done->text);
    if (const auto* refused = std::get_if<ControlRefused>(&outcome))
        o = {{"done", false},
             {"code", refused->code},
             {"message", refused->message},
             {"remedy", refused->remedy}};
    else
        return text_of(outcome);
    return o.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string done_json(Tick tick, const std::string& text) {
    using Json = nlohmann::ordered_json;
    return Json{{"done", true}, {"tick", tick}, {"text", text}}.dump(-1, ' ', false,
                                                                     Json::error_handler_t::replace);
}

Result<RunStatus> status_of_controller(const MemberOptions& options) {
    const std::optional<ControlOutcome> outcome = reply_of_run(options, GetStatus{true});
    if (!outcome) return Error{"no run replied", "see the messages above", "no-controller"};
    if (const auto* status = std::get_if<RunStatus>(&*outcome)) return *status;
    if (const auto* refused = std::get_if<ControlRefused>(&*outcome)) return refused->error();
    return Error{"the Controller replied to something else", "run the same version of RoBOSS everywhere",
                 "wrong-reply"};
}

std::vector<std::string> save_words(const std::string& file, bool overwrite) {
    std::vector<std::string> words{"save", file};
    if (overwrite) words.emplace_back("overwrite");
    return words;
}

int ask_controller(const MemberOptions& options, const std::vector<std::string>& words,
                   const AskOptions& ask) {
    const Result<ControlAction> action = parse_control(words);
    if (!action) return print(action.error()), kWrongUsage;
    const bool asks = !ask.yes && isatty(STDIN_FILENO) != 0 && isatty(STDERR_FILENO) != 0;
    if (const std::string question = question_before(action.value()); asks && !question.empty())
        if (!confirmed(question)) return kSuccess;
    std::optional<ControlOutcome> outcome = reply_of_run(options, patient(action.value()));
    if (const std::string file = file_that_exists(action.value(), outcome); asks && !file.empty()) {
        if (!confirmed(file + " exists. Overwrite it?")) return kSuccess;
        outcome = reply_of_run(options, SaveRun{file, true});
    }
    if (!outcome) return interrupted() ? kInterrupted : kBadInput;
    const auto* refused = std::get_if<ControlRefused>(&*outcome);
    if (refused != nullptr) say(stderr, "roboss control: {}\n", refused->error().text());
    if (ask.json)
        say("{}\n", outcome_json(*outcome));
    else if (refused == nullptr)
        say("{}\n", text_of(*outcome));
    return refused != nullptr ? kRunFailed : kSuccess;
}

void add_control_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("control", "pause, step, rewind or change a running simulation");
    command->footer(kControlFooter);
    command->require_subcommand(1);
    auto o = std::make_shared<ControlCommandOptions>();
    add_member_options(*command, o->member);
    command->add_flag("--json", o->json,
                      "print every reply as one JSON object: done, tick, text; or code, message, remedy");
    const Ask ask = [o, command, &exit_code](const std::vector<std::string>& words) {
        note_given(*command, o->member);
        exit_code = ask_controller(o->member, words, {o->yes, o->json});
    };
    add_plain(*command, *o, ask);
    add_changes(*command, *o, ask, exit_code);
    for (CLI::App* sub : command->get_subcommands({})) sub->fallthrough();
}

}  // namespace roboss
