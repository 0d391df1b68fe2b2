// Declares the options of `roboss run`; their texts are what --help teaches.
#include "app/run_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/network_options.h"
#include "model/accuracy.h"

namespace roboss {
namespace {

const char* const kFooter = R"(Examples:
  roboss run worlds/city.sdf --client build/release/lib/roboss_city_driver.so --duration 60
  roboss run world.sdf --orders orders.jsonl --trace trace.csv --trace-every 0.1
  roboss run world.sdf --duration 30 --save half.roboss      and later
  roboss run world.sdf --from half.roboss --duration 30      ends with the hash of an undisturbed 60 s run

  roboss run world.sdf --journal run.journal --until 60      killed, and started again: goes on where it was
  roboss run world.sdf --from run.journal@12.5 --journal run.journal    goes on from 12.5 s as a new branch

  roboss run world.sdf --profile precise --accuracy high --tolerance 1e-13

An orders file has one JSON object a line:
  {"t":0.5,"robot":"car_7","joint":{"name":"wheel_0","velocity":10,"max_effort":0.4}}
  {"t":1.0,"robot":"car_7","set_pose":{"position":[0,0,1],"orientation":[1,0,0,0]}}
  {"t":1.0,"robot":"car_7","set_velocity":{"linear":[1,0,0],"angular":[0,0,0]}}
  {"t":2.0,"robot":"car_7","wrench":{"link":"chassis","force":[0,0,50],"torque":[0,0,0],"duration":0.1}})";

const char* const kControllerFooter = R"(Examples:
  roboss controller worlds/city.sdf --simulators 2 --duration 60        and, in other terminals, twice
  roboss simulator
  roboss controller world.sdf --interface eth0 --simulators 12          and on each other computer
  roboss simulator --interface eth0 --threads 8
  roboss controller worlds/city.sdf --await-client driver               and
  roboss client build/release/lib/roboss_city_driver.so --name driver

Simulators get the world from here; they need no file. One that is killed costs a moment and no result.)";

const char* const kReplayFooter =
    R"(Steps a kept run again, without its world file and its control programs, and compares the state with what was
kept at every checkpoint. Traces, contacts and pictures can be taken of it as of the run itself.

Examples:
  roboss replay run.journal
  roboss replay run.journal@12 --duration 3 --trace crash.csv --contacts crash-contacts.csv
  roboss replay run.journal#2 --speed 1

Exit codes: 0 all states equal, 1 the journal cannot be read, 2 wrong usage, 3 a state differs or a file could not be
written, 130 ended by Ctrl-C.)";

const char* const kExitCodes =
    R"(Exit codes: 0 done (also where models with errors were left out), 1 the world, orders or saved state have errors
(with --strict: any model has one), 2 wrong usage, 3 the run failed (a Client threw, a state became infinite, a file could
not be written), 4 processes of --processes died at the start or did not join (those that die later are done without),
130 ended by Ctrl-C (with the summary).)";

/// Accepts a positive number or one of the given words.
CLI::Validator number_or(const std::vector<std::string>& words) {
    std::string known;
    for (const std::string& word : words) known += (known.empty() ? "" : "|") + word;
    return CLI::Validator(
        [words, known](std::string& text) -> std::string {
            if (std::find(words.begin(), words.end(), text) != words.end()) return {};
            try {
                std::size_t used = 0;
                if (std::stod(text, &used) > 0 && used == text.size()) return {};
            } catch (const std::exception&) {
            }
            return "'" + text + "' is neither a positive number nor '" + known + "'";
        },
        "NUMBER|" + known);
}

/// --accuracy and one option for each number, --newton-max for newton_max; on the command line as in the file
/// the numbers count after the setting.
void add_accuracy_options(CLI::App& command, AccuracySpec& spec) {
    const std::string group = "Accuracy (part of the Model and its hash; docs/physics.md says what it costs)";
    command
        .add_option("--accuracy", spec.setting,
                    "fast, standard or high (default: the world's <roboss:accuracy>, else standard)")
        ->check(CLI::IsMember({"fast", "standard", "high"}))
        ->group(group);
    for (const AccuracyNumber& number : accuracy_numbers()) {
        std::string name = number.name;
        std::replace(name.begin(), name.end(), '_', '-');
        const std::string key = number.name;
        command
            .add_option_function<double>(
                "--" + name,
                [&spec, key](const double& value) {
                    spec.numbers.push_back({key, value});
                },
                fmt::format("{}: from {:g} to {:g}", number.meaning, number.low, number.high))
            ->group(group);
    }
}

/// How far and how fast.
void add_pace_options(CLI::App& command, RunOptions& o) {
    command.add_option("--duration", o.duration_s, "simulated time to run, s (default: until Ctrl-C)")
        ->check(CLI::NonNegativeNumber);
    command
        .add_option("--until", o.until_s,
                    "world time to run to, s; the same again ends a resumed run where it should")
        ->check(CLI::NonNegativeNumber);
    command
        .add_option("--speed", o.speed,
                    "simulated seconds a real second, max, or world (its real_time_factor)")
        ->check(number_or({"max", "world"}))
        ->capture_default_str();
    command.add_flag("--paused", o.paused, "wait for `roboss control resume` at the start");
    command
        .add_option("--threads", o.threads,
                    "threads a Simulator steps its islands with; the same result (default: one for each core "
                    "of this computer, with --processes an equal share, at least 1)")
        ->check(CLI::Range(1, 1024));
    command
        .add_option("--lanes", o.lanes,
                    "robots of a type stepped at once, at most: 1, 4 (AVX2) or 8 (AVX-512), with floats 1, 8 "
                    "or 16; the same result")
        ->check(CLI::Range(std::size_t{1}, kMostLanes))
        ->capture_default_str();
    command.add_option("--window", o.window, "ticks between two talks with the Controller, or auto")
        ->check(number_or({"auto"}))
        ->capture_default_str();
}

/// What is written and shown of a run.
void add_watch_options(CLI::App& command, RunOptions& o, ViewerDefault viewer) {
    command.add_option("--trace", o.trace, "write poses and velocities of all links to this CSV file");
    command
        .add_option("--trace-every", o.trace_every_s,
                    "simulated time between two traces, s (default: every step)")
        ->check(CLI::PositiveNumber);
    command.add_option("--contacts", o.contacts,
                       "write who touches whom, where and how hard to this CSV file");
    command
        .add_option("--contacts-every", o.contacts_every_s,
                    "simulated time between two looks at the contacts, s (default: every step)")
        ->check(CLI::PositiveNumber);
    command.add_option("--hash-every", o.hash_every_s, "print the state hash each so many simulated seconds")
        ->check(CLI::PositiveNumber);
    command.add_option("--json", o.json, "write the summary to this file");
    command
        .add_option("--log", o.log,
                    "add to this file (-: standard error) a line for each event and, every so often, how "
                    "the run stands: window, repeated windows, efficiency, who has what and at what load")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    command.add_option("--log-every", o.log_every_s, "real time between two such states, s")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command.add_option("--picture", o.paths_picture, "draw where the robots went into this SVG file");
    add_viewer_options(command, o.viewer, viewer);
    command.add_flag("--quiet", o.quiet, "no progress, only the summary");
}

/// Where it comes from and where it is kept.
void add_kept_options(CLI::App& command, RunOptions& o) {
    command.add_option("--save", o.save, "write the state at the end to this file");
    command.add_option(
        "--from", o.from,
        "start from a file written by --save or --journal: FILE, FILE@TIME or FILE#BRANCH@TIME; "
        "with the same file as --journal, as a new branch of it");
    command.add_option(
        "--journal", o.journal,
        "keep the run in this file, so that every point in time can be restored; if the file exists, "
        "go on where it ended (after a crash, say)");
    command
        .add_option(
            "--journal-every", o.journal_every_s,
            "simulated time between two checkpoints of the journal, s; rewinding steps again at most so much")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
}

void add_common_options(CLI::App& command, RunOptions& o) {
    command.add_option("world", o.world, "the world: an SDF or URDF file")->required();
    command.add_option("--path", o.paths,
                       "folder to look up model:// and package:// URIs in (may be given again)");
    command.add_flag("--strict", o.strict,
                     "refuse a world with any error (default: a model with errors is left out, with an error "
                     "that names it, and the rest runs)");
    command.add_option("--dt", o.dt_s, "time step, s (default: the world's max_step_size)")
        ->check(CLI::PositiveNumber);
    command.add_option(
        "--profile", o.profile,
        "name of the world's <physics> to use (default: the one with default=\"true\", else the "
        "first)");
    add_accuracy_options(command, o.accuracy);
    command
        .add_option_function<std::string>(
            "--precision",
            [&o](const std::string& text) {
                o.precision = text == "float" ? Precision::kFloat : Precision::kDouble;
            },
            "numbers that robots which meet no other are stepped with: double, or float, which is faster "
            "(part of the Model and its hash; docs/physics.md says for whom and how exact; default: the "
            "world's <roboss:precision>, else double)")
        ->check(CLI::IsMember({"double", "float"}));
    command.add_flag(
        "--no-sleep", o.no_sleep,
        "step robots at rest too (default: they sleep until something touches or orders them, unless "
        "the world says <roboss:sleep>false)");
    command.add_flag("--merge-islands", o.merge_islands,
                     "put all robots into one island (same result, slower)");
    command.add_option("--client", o.clients, "control program: a shared library (may be given again)");
    command.add_option("--orders", o.orders, "orders from a file, one JSON object a line");
    command.add_option(
        "--seed", o.seed,
        "seed of sensor noise and control programs (default: that of --from or of the journal, else 0)");
    add_kept_options(command, o);
    add_pace_options(command, o);
    add_watch_options(command, o, ViewerDefault::kOn);
}

}  // namespace

void add_run_options(CLI::App& command, RunOptions& o) {
    command.footer(fmt::format("{}\n\n{}", kFooter, kExitCodes));
    add_common_options(command, o);
    CLI::Option* simulators =
        command
            .add_option("--simulators", o.simulators, "Simulators that share the robots, all in this process")
            ->check(CLI::Range(1, 1024))
            ->capture_default_str();
    command
        .add_option("--processes", o.processes,
                    "Simulators as processes of their own on this computer, started and ended by this one; "
                    "what they say is shown if they fail")
        ->check(CLI::Range(1, 100))
        ->excludes(simulators);
}

void add_replay_options(CLI::App& command, RunOptions& o) {
    command.footer(kReplayFooter);
    command.add_option("journal", o.replay, "FILE, FILE@TIME to begin later, FILE#BRANCH@TIME")->required();
    add_pace_options(command, o);
    add_watch_options(command, o, ViewerDefault::kOnDemand);
    command.add_option("--simulators", o.simulators, "Simulators that share the robots, all in this process")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
}

void add_controller_options(CLI::App& command, RunOptions& o) {
    o.is_controller = true;
    command.footer(fmt::format("{}\n\n{}", kControllerFooter, kExitCodes));
    add_common_options(command, o);
    command
        .add_option("--simulators", o.simulators,
                    "the run starts when so many `roboss simulator` have come; others may join at any time")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    command
        .add_option(
            "--local", o.local,
            "Simulators in this process, too; with --simulators 0 a run that needs no other process and "
            "can be controlled and joined")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    command.add_option(
        "--await-client", o.clients_awaited,
        "the run starts when this Client has come, too (`roboss client --name`; may be given again)");
    add_network_options(command, o.network);
}

}  // namespace roboss
