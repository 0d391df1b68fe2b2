// Declares the options of `roboss run`, `replay` and `controller` with their help texts.
#include "app/run/run_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/commands/help_text.h"
#include "app/commands/numbers.h"
#include "app/processes/network_options.h"
#include "app/run/journal_limit.h"
#include "model/accuracy.h"
#include "ros2/world_drives.h"
#include "wire/control.h"

namespace roboss {
namespace {

const char* const kRunOptionsFooter = R"(Examples:
  roboss run example:city                                    `roboss examples` lists more
  roboss run worlds/city.sdf --client build/release/lib/roboss_city_driver.so --duration 60
  roboss run world.sdf --orders orders.jsonl --trace trace.csv --trace-every 0.1
  roboss run world.sdf --orders bag.mcap --until 60           the commands that a bag of ROS 2 has for its robots
  roboss run world.sdf --duration 30 --save half.roboss      and later
  roboss run world.sdf --from half.roboss --duration 30      same final hash as one run of 60 s

  roboss run world.sdf --journal run.journal --until 60      after a crash, run it again to resume
  roboss run world.sdf --from run.journal@12.5 --journal run.journal    starts a new branch at 12.5 s

  roboss run arm.urdf --fixed-base arm --duration 5
  roboss run rover.urdf --ground --on-ground --speed 1

  roboss run world.sdf --profile precise --accuracy high --tolerance 1e-13

An orders file has one JSON object per line:
  {"t":0.5,"robot":"car_7","joint":{"name":"wheel_0","velocity":10,"max_effort":0.4}}
  {"t":1.0,"robot":"car_7","set_pose":{"position":[0,0,1],"quat_xyzw":[0,0,0,1]}}
  {"t":1.0,"robot":"car_7","set_velocity":{"linear":[1,0,0],"angular":[0,0,0]}}
  {"t":2.0,"robot":"car_7","wrench":{"link":"chassis","force":[0,0,50],"torque":[0,0,0],"duration":0.1}}
  {"t":2.0,"robot":"car_7","pull":{"link":"chassis","point":[0,0,0],"target":[0,0,1],"max_force":500,"duration":3}}
  {"t":3.0,"robot":"rover_0","transmit":{"radio":"radio","text":"hello","to":"rover_1"}})";

const char* const kControllerFooter = R"(Examples:
  roboss controller worlds/city.sdf --simulators 2 --duration 60        then, in two other terminals
  roboss simulator
  roboss controller world.sdf --interface eth0 --simulators 12          then, on each other computer
  roboss simulator --interface eth0 --threads 8
  roboss controller worlds/city.sdf --local 1 --simulators 0 --await-client driver     then
  roboss client build/release/lib/roboss_city_driver.so --name driver

Simulators receive the compiled world from the Controller; they need no file. Killing a Simulator causes a short stall.
Results do not change.)";

const char* const kReplayFooter =
    R"(Steps a recorded run again, without its world file and its control programs, through all branches that led to the one
named, and compares the state with the journal at every checkpoint. Traces, contacts and pictures can be written as during the run itself.

Examples:
  roboss replay run.journal
  roboss replay run.journal@12 --duration 3 --trace crash.csv --contacts crash-contacts.csv
  roboss replay run.journal#2 --speed 1
  roboss replay run.journal --view 8090 --speed 1      in a browser: scrub, play, pause; stays open at the end

Exit codes: 0 all states are equal, 1 the journal cannot be read, 2 wrong usage, 3 a state differs or a file could not
be written, 130 interrupted by Ctrl-C.)";

const char* const kExitCodes =
    R"(Exit codes: 0 done (also if models with errors were left out), 1 the world, orders or saved state have errors
(with --strict: any model has one), 2 wrong usage, 3 the run failed (a Client threw, a state became infinite, a file could
not be written), 4 processes of --processes ended at the start or did not join (later losses are recovered from),
130 interrupted by Ctrl-C (the summary is printed).)";

/// --accuracy and one option for each number, --newton-max for newton_max; on the command line as in the file
/// the numbers count after the setting.
void add_accuracy_options(CLI::App& command, AccuracySpec& spec) {
    const std::string group = "Accuracy (part of the Model and its hash; costs: docs/physics.md)";
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
        ->check(non_negative_number());
    command
        .add_option("--until", o.until_s,
                    "world time at which the run ends, s; also the end of a resumed run")
        ->check(non_negative_number());
    command
        .add_option("--speed", o.speed,
                    "simulated seconds per real second, max, or world (the world's real_time_factor, usually "
                    "1); default: world with a viewer, max with --headless")
        ->check(number_or({"max", "world"}, kSlowest, kFastest));
    command.add_flag("--paused", o.paused,
                     "start paused; the play button of the page or `roboss control resume` starts it");
    CLI::Option* stay = command.add_flag(
        "--stay", o.stay,
        "stay, paused, when the duration is over, until Ctrl-C or `roboss control quit` (default: only while "
        "a page of the viewer is open)");
    command.add_flag("--no-stay", o.no_stay, "end when the duration is over, also while a page is open")
        ->excludes(stay);
    command
        .add_option(
            "--threads", o.threads,
            "threads per Simulator; the result is the same (default: one per core of this computer; with "
            "--processes an equal share, at least 1)")
        ->check(whole_number(1, 1024));
    command
        .add_option(
            "--lanes", o.lanes,
            "SIMD lanes: largest number of robots of a type stepped together: 1, 2 (NEON), 4 (AVX2, NEON) "
            "or 8 (AVX-512, NEON), with floats twice as many; the result is the same")
        ->check(whole_number(1, kMostLanes))
        ->capture_default_str();
    command.add_option("--window", o.window, "synchronization interval in ticks, or auto")
        ->check(number_or({"auto"}, 1, 1e6))
        ->capture_default_str();
    name_new_options(command, "Time, speed and threads");
}

/// Output files, log and viewer.
void add_watch_options(CLI::App& command, RunOptions& o, ViewerDefault viewer) {
    command.add_option("--trace", o.trace,
                       "write poses and velocities of all links to this CSV file (-: standard output)");
    command
        .add_option("--trace-every", o.trace_every_s,
                    "simulated time between two samples of the trace, s (default: every step)")
        ->check(positive_number());
    command.add_option(
        "--contacts", o.contacts,
        "write all contacts with bodies, point, normal and forces to this CSV file (-: standard "
        "output; columns: docs/physics.md)");
    command
        .add_option("--contacts-every", o.contacts_every_s,
                    "simulated time between two samples of the contacts, s (default: every step)")
        ->check(positive_number());
    command
        .add_option("--hash-every", o.hash_every_s, "simulated time between two prints of the state hash, s")
        ->check(positive_number());
    command.add_option(
        "--json", o.json,
        "write the summary as JSON to this file (-: standard output; the text then goes to standard "
        "error)");
    command.add_flag("--profile-steps,--stage-times", o.profile_steps,
                     "measure how long each stage of the steps takes and what the solver does; the summary "
                     "tells both (docs/performance.md)");
    command
        .add_option(
            "--log", o.log,
            "append key=value lines to this file (-: standard error): events, and at intervals the state of "
            "the run: window, repeated windows, efficiency, robots and load of each Simulator")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    command.add_option("--log-every", o.log_every_s, "real time between two such state lines, s")
        ->check(positive_number())
        ->capture_default_str();
    command.add_option("--picture", o.paths_picture, "draw the paths of the robots into this SVG file");
    add_viewer_options(command, o.viewer, viewer);
    command
        .add_option("--save-folder", o.save_folder,
                    "files that `roboss control save`, pages and Clients ask to write lie below this folder "
                    "(default: the current one)")
        ->check(CLI::ExistingDirectory);
    command.add_flag("--quiet", o.quiet, "print no progress, only the summary");
    name_new_options(command, "Output");
}

/// Saved states and the journal.
void add_kept_options(CLI::App& command, RunOptions& o) {
    command.add_option("--save", o.save, "write the state at the end to this file");
    command.add_option(
        "--from", o.from,
        "start from a file written by --save or --journal: FILE, FILE@TIME or FILE#BRANCH@TIME; "
        "if --journal names the same file, the run becomes a new branch of it");
    command.add_option(
        "--journal", o.journal,
        "record the run in this file, so that every point in time can be restored; if the file exists, "
        "resume where it ended (for example after a crash)");
    command
        .add_option(
            "--journal-every", o.journal_every_s,
            "simulated time between two checkpoints of the journal, s; rewinding repeats at most this much")
        ->check(positive_number())
        ->capture_default_str();
    command
        .add_option_function<std::string>(
            "--journal-keep",
            [&o](const std::string& text) {
                const std::optional<JournalLimit> limit = parse_journal_limit(text);
                o.journal_keep.seconds = limit->seconds, o.journal_keep.bytes = limit->bytes;
            },
            "how much of the run its journal keeps (default: all; 50 cars write some 20 MB a minute): a "
            "recorded, simulated time (90s, 10min, 2h), or a size "
            "of "
            "the file (500MB, 2GB); what is older is removed. all: everything (the default)")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast)
        ->check(CLI::Validator(
            [](const std::string& text) {
                return parse_journal_limit(text) ? std::string()
                                                 : "give a time (10min), a size (500MB) or all";
            },
            "AGE|SIZE"));
    name_new_options(command, "Saved states and the journal");
}

void add_common_options(CLI::App& command, RunOptions& o) {
    command
        .add_option("world", o.world,
                    "the world: an SDF, URDF or MJCF file, or example:NAME (`roboss examples`)")
        ->required();
    command.add_option("--path", o.paths,
                       "folder in which model:// and package:// URIs are looked up (may be repeated)");
    command.add_flag("--strict", o.strict,
                     "refuse a world with any error (default: a model with errors is left out and reported, "
                     "and the rest runs)");
    command.add_flag("--ground", o.bare.ground,
                     "add a ground plane at z = 0 (for a file with a robot alone, such as a URDF)");
    command.add_option("--fixed-base", o.bare.fixed_base,
                       "fix the base of this model to the world where it stands (may be repeated)");
    command.add_flag("--on-ground", o.on_ground,
                     "stand the robots on the ground, box or mesh below them, with their lowest collision "
                     "shape (for a robot whose file starts it in the ground, or above)");
    command.add_option("--dt", o.dt_s, "time step, s (default: the world's max_step_size)")
        ->check(positive_number());
    command.add_option(
        "--profile", o.profile,
        "name of the world's <physics> to use (default: the one with default=\"true\", else the "
        "first); where the time of the steps goes: --profile-steps");
    command
        .add_option("--keyframe", o.keyframe,
                    "start an MJCF file at this <key> of its <keyframe>: name or number (default: where the "
                    "bodies stand, as MuJoCo does)")
        ->type_name("NAME");
    add_accuracy_options(command, o.accuracy);
    command
        .add_option_function<std::string>(
            "--precision",
            [&o](const std::string& text) {
                o.precision = text == "float" ? Precision::kFloat : Precision::kDouble;
            },
            "floating-point type for robots that do not interact with others: double, or float, which is "
            "faster (part of the Model and its hash; accuracy: docs/physics.md; default: the world's "
            "<roboss:precision>, else double)")
        ->check(CLI::IsMember({"double", "float"}));
    command.add_flag(
        "--no-sleep", o.no_sleep,
        "also step robots at rest (default: they sleep until a contact or an order wakes them, unless "
        "the world sets <roboss:sleep>false)");
    command.add_flag("--merge-islands", o.merge_islands,
                     "put all robots into one island (slower; the result is the same)");
    command.add_option("--client", o.clients, "control program: a shared library (may be repeated)");
    command.add_option(
        "--orders", o.orders,
        "read orders from this file, one JSON object per line; or the commands of a bag of ROS 2: "
        "an .mcap or .db3 file, or a folder (docs/ros2.md)");
    command.add_option(
        "--seed", o.seed,
        "seed of sensor noise and control programs (default: the seed in --from or the journal, else 0)");
    name_new_options(command, "World and robots");
    add_kept_options(command, o);
    add_pace_options(command, o);
    add_watch_options(command, o, ViewerDefault::kOn);
}

/// Options that begin with `prefix` mean nothing without this one.
void let_need(CLI::App& command, const std::string& prefix, CLI::Option* needed) {
    for (CLI::Option* option : command.get_options())
        if (option->get_name().starts_with(prefix)) option->needs(needed);
}

/// The nodes of ROS 2 that a run is shown to.
void add_ros2_options(CLI::App& command, RunOptions& o) {
    CLI::Option* ros2 = command.add_flag(
        "--ros2", o.ros2.wanted,
        "show the run to ROS 2 nodes: sensors as topics, /cmd_vel ... as commands (docs/ros2.md)");
    add_ros2_options(command, o.ros2, "--ros2-");
    let_need(command, "--ros2-", ros2);
    name_new_options(command, "ROS 2");
}

/// The viewers Foxglove and Lichtblick.
void add_foxglove_options(CLI::App& command, RunOptions& o) {
    CLI::Option* foxglove = command.add_flag(
        fmt::format("--foxglove{{{}}}", kFoxglovePort), o.foxglove.listen,
        "serve Foxglove and Lichtblick at ws://localhost:8765, or with --foxglove=[ADDRESS:]PORT elsewhere "
        "(docs/foxglove.md)");
    add_foxglove_options(command, o.foxglove, "--foxglove-");
    let_need(command, "--foxglove-", foxglove);
    name_new_options(command, "Foxglove");
}

/// Of runs that no other computer joins.
void add_name_option(CLI::App& command, RunOptions& o) {
    command.add_option_function<std::string>(
        "--simulation", [&o](const std::string& name) { o.network.simulation = name; },
        "name of the run for `roboss control` and `roboss runs` (default: the name of the file)");
    command
        .add_flag("--insecure", o.network.insecure,
                  "no encryption: neither of the viewer at an address beyond loopback, nor between processes")
        ->envname("ROBOSS_INSECURE");
}

}  // namespace

void add_drives(const RunOptions& options, const std::string& name, World& world) {
    for (const ros2::TopicOptions* topics : {&options.ros2.face.topics, &options.foxglove.face.topics})
        if (topics->controllers) ros2::add_drives(*topics->controllers, topics->root, name, world);
}

void add_run_options(CLI::App& command, RunOptions& o) {
    command.footer(fmt::format("{}\n\n{}", kRunOptionsFooter, kExitCodes));
    add_common_options(command, o);
    add_ros2_options(command, o);
    add_foxglove_options(command, o);
    add_name_option(command, o);
    CLI::Option* simulators =
        command
            .add_option("--simulators", o.simulators,
                        "number of Simulators among which the robots are divided, all in this process")
            ->check(whole_number(1, 1024))
            ->capture_default_str();
    command
        .add_option(
            "--processes", o.processes,
            "number of Simulators, each as a separate process on this computer; if one fails, the end of "
            "its output is printed")
        ->check(whole_number(1, 1024))
        ->excludes(simulators);
    name_new_options(command, "Simulators of this run");
    limit_help_to(command, {"duration", "speed", "ground", "path", "client", "orders", "view", "headless",
                            "trace", "journal"});
}

void add_replay_options(CLI::App& command, RunOptions& o) {
    command.footer(kReplayFooter);
    command.add_option("journal", o.replay, "FILE, FILE@TIME to begin later, FILE#BRANCH@TIME")->required();
    add_pace_options(command, o);
    add_watch_options(command, o, ViewerDefault::kOnDemand);
    add_name_option(command, o);
    command
        .add_option("--simulators", o.simulators,
                    "number of Simulators among which the robots are divided, all in this process")
        ->check(whole_number(1, 1024))
        ->capture_default_str();
    name_new_options(command, "Simulators of this run");
    limit_help_to(command, {"duration", "speed", "view", "trace", "contacts", "json"});
}

void add_controller_options(CLI::App& command, RunOptions& o) {
    o.is_controller = true;
    command.footer(fmt::format("{}\n\n{}", kControllerFooter, kExitCodes));
    add_common_options(command, o);
    add_ros2_options(command, o);
    add_foxglove_options(command, o);
    command
        .add_option(
            "--simulators", o.simulators,
            "the run starts when this many `roboss simulator` have joined; others may join at any time")
        ->check(whole_number(0, 1024))
        ->capture_default_str();
    command
        .add_option(
            "--local", o.local,
            "Simulators inside this process; with --simulators 0 the run needs no other process, and can "
            "still be controlled and joined")
        ->check(whole_number(0, 1024))
        ->capture_default_str();
    command.add_option(
        "--await-client", o.clients_awaited,
        "the run also waits for this Client before it starts (`roboss client --name`; may be repeated)");
    name_new_options(command, "Members of this run");
    add_listen_options(command, o.network);
    limit_help_to(command, {"simulators", "local", "await-client", "interface", "simulation", "keys",
                            "duration", "speed", "client", "orders", "view", "headless", "journal"});
}

}  // namespace roboss
