// Starts, watches and ends the processes of a run on many hosts. It only starts and ends processes: members
// join the Controller by themselves, and each of them may also be started by hand.
#include "app/commands/cluster_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "app/cluster/cluster_file.h"
#include "app/cluster/host_processes.h"
#include "app/cluster/remote_shell.h"
#include "app/commands/control_command.h"
#include "app/commands/exit_codes.h"
#include "app/output/say.h"
#include "app/processes/member.h"
#include "app/run/run.h"
#include "gateway/run_json.h"

namespace roboss {
namespace {

using Json = nlohmann::ordered_json;

const char* const kClusterFooter =
    R"(HOSTS.toml lists the processes and their hosts:

  simulation = "city"              # name of the run
  program = "/opt/roboss/bin/roboss"    # on the hosts; default: roboss, found through PATH
  folder = "/home/me/worlds"       # working directory on the hosts
  keys = "keys"                    # here: an authority and a key for each process, made if missing; default:
                                   # HOSTS.toml.keys. insecure = true: no keys and no encryption
  [controller]
  host = "node1"                   # name for ssh, or "local"
  interface = "eth0"               # at which it listens, there
  address = "192.0.2.1"            # where others find it; default: the host's name; port = 7117
  world = "city.sdf"
  options = ["--simulators", "8", "--journal", "city.journal"]    # options of `roboss controller`
  [[simulators]]
  host = "node2"
  count = 4                        # number of processes
  threads = 2                      # of each; default: all cores of the host, 1 if count is above 1
  [[clients]]
  host = "node1"
  program = "driver.so"

Hosts are reached by non-interactive ssh (an agent or a key; known hosts), with one shell per host;
reach = ["ip", "netns", "exec", "{host}", "sh", "-s"] sets another command that starts a shell which reads a script.
Started processes are listed in HOSTS.toml.running beside the file; their logs are on the hosts in ~/.roboss/logs.

Examples:
  roboss cluster up hosts.toml
  roboss cluster status hosts.toml
  roboss cluster status --simulation city      # any run, however it was started
  roboss cluster down hosts.toml

Exit codes: 0 done, 1 the file is wrong or nothing was started, 2 wrong usage, 3 a host cannot be reached or a process
does not start.)";

std::string notes_of(const ClusterFile& file) {
    return file.path + ".running";
}

Json json_of(const std::vector<Started>& all) {
    Json list = Json::array();
    for (const Started& s : all)
        list.push_back(
            {{"name", s.name}, {"role", s.role}, {"host", s.host}, {"pid", s.pid}, {"log", s.log}});
    return list;
}

Result<> write_notes(const ClusterFile& file, const std::vector<Started>& all) {
    const Json o{{"simulation", file.simulation}, {"processes", json_of(all)}};
    std::ofstream out(notes_of(file));
    if (out << o.dump(1) << '\n') return Ok{};
    return Error{notes_of(file) + " cannot be written",
                 "without this file `down` cannot end the processes: put HOSTS.toml into a writable folder",
                 "not-writable"};
}

Result<std::vector<Started>> read_notes(const ClusterFile& file) {
    std::ifstream in(notes_of(file));
    const Json o = Json::parse(in, nullptr, false);
    if (!in || o.is_discarded() || !o.contains("processes"))
        return Error{"nothing was started by " + file.path,
                     "start it with `roboss cluster up " + file.path + "`", "not-started"};
    std::vector<Started> all;
    for (const Json& p : o["processes"])
        all.push_back({p.value("name", ""), p.value("role", ""), p.value("host", ""), p.value("log", ""),
                       p.value("pid", 0l)});
    return all;
}

void report(const std::map<std::string, std::string>& silent) {
    for (const auto& [host, why] : silent)
        say(stderr, "roboss: host {} does not answer: {} [no-answer]\n", host, why);
}

/// Whether processes started before still run, or may still run; it has been reported.
bool is_up(const ClusterFile& file) {
    const Result<std::vector<Started>> before = read_notes(file);
    if (!before) return false;
    const Presence presence = ask_hosts(file, before.value());
    const std::string remedy = "`roboss cluster down " + file.path + "` ends it";
    if (std::find(presence.runs.begin(), presence.runs.end(), true) != presence.runs.end())
        return print(Error{"the cluster is already running", remedy, "already-running"}), true;
    report(presence.silent);
    if (!presence.silent.empty())
        print(Error{"processes started there before may still run",
                    remedy + "; if these hosts are gone for good, remove " + notes_of(file), "may-run"});
    return !presence.silent.empty();
}

int up(const std::string& path, bool json) {
    Result<ClusterFile> file = load_cluster_file(path);
    if (!file) return print(file.error()), kBadInput;
    if (is_up(file.value())) return kRunFailed;
    const Result<std::vector<Credentials>> keys = keys_of(file.value());
    if (!keys) return print(keys.error()), kBadInput;
    const StartOutcome outcome = start_processes(file.value(), keys.value());
    if (json) {
        const Json told{{"simulation", file.value().simulation}, {"started", json_of(outcome.started)}};
        say("{}\n", told.dump(2));
    } else {
        for (const Started& s : outcome.started)
            say("{:<24} on {:<16} process {}, log {}\n", s.name, s.host, s.pid, s.log);
    }
    for (const Error& error : outcome.errors) print(error);
    bool good = outcome.errors.empty() && outcome.started.size() == file.value().processes.size();
    if (!good)
        say(stderr, "roboss: not all processes have started; `roboss cluster down {}` ends the others\n",
            path);
    if (Result<> written = write_notes(file.value(), outcome.started); !written)
        print(written.error()), good = false;
    return good ? kSuccess : kRunFailed;
}

/// Ends processes, and remembers hosts that do not answer any more: it does not wait for them again.
class Ending {
  public:
    explicit Ending(const ClusterFile& file, std::vector<Started> all) : file_(file), left_(std::move(all)) {}

    void signal(const char* name) { send_signal(file_, left_, name); }
    /// False: none is running.
    bool signal_controller(const char* name) {
        wait(0);
        std::vector<Started> controller;
        for (const Started& s : left_)
            if (s.role == "controller") controller.push_back(s);
        send_signal(file_, controller, name);
        return !controller.empty();
    }
    /// Waits until all have ended, at most this long. True: some are left.
    bool wait(int seconds) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
        for (bool again = false; !left_.empty(); again = true) {
            if (again && std::chrono::steady_clock::now() >= end) break;
            if (again) std::this_thread::sleep_for(std::chrono::milliseconds(500));
            Presence presence = ask_hosts(file_, left_);
            silent_.merge(presence.silent);
            std::vector<Started> running;
            for (std::size_t k = 0; k < left_.size(); ++k) {
                if (!presence.runs[k]) unknown_.push_back(left_[k]);
                if (presence.runs[k].value_or(false)) running.push_back(left_[k]);
            }
            left_ = std::move(running);
        }
        return !left_.empty();
    }
    const std::vector<Started>& left() const { return left_; }
    const std::vector<Started>& unknown() const { return unknown_; }
    const std::map<std::string, std::string>& silent() const { return silent_; }

  private:
    const ClusterFile& file_;
    std::vector<Started> left_, unknown_;
    std::map<std::string, std::string> silent_;
};

int down(const std::string& path, bool json) {
    Result<ClusterFile> file = load_cluster_file(path);
    if (!file) return print(file.error()), kBadInput;
    Result<std::vector<Started>> all = read_notes(file.value());
    if (!all) return print(all.error()), kBadInput;
    Ending ending(file.value(), all.value());
    // Like Ctrl-C: the run ends as at its duration, and dismisses all members.
    bool some_left = ending.wait(ending.signal_controller("INT") ? 10 : 0);
    for (const char* name : {"TERM", "KILL"}) {
        if (!some_left) break;
        ending.signal(name);
        some_left = ending.wait(8);  // a Client without a Controller takes 5 s to leave
    }
    report(ending.silent());
    std::vector<Started> rest = ending.left();
    for (const Started& s : rest)
        say(stderr, "roboss: {} (process {} on {}) did not end\n", s.name, s.pid, s.host);
    for (const Started& s : ending.unknown())
        say(stderr, "roboss: {} (process {} on {}) may still run [may-run]\n", s.name, s.pid, s.host);
    rest.insert(rest.end(), ending.unknown().begin(), ending.unknown().end());
    const std::size_t ended = all.value().size() - rest.size();
    if (json) say("{}\n", Json{{"ended", ended}, {"left", json_of(rest)}}.dump(2));
    if (!rest.empty()) {
        if (Result<> written = write_notes(file.value(), rest); !written) print(written.error());
        say(stderr, "roboss: {} processes have ended; run `roboss cluster down {}` again for the others\n",
            ended, path);
        return kRunFailed;
    }
    std::filesystem::remove(notes_of(file.value()));
    if (!json) say("all {} processes have ended\n", ended);
    return kSuccess;
}

void print_status(const Json& o) {
    say("{} at {:.3f} s (tick {}), {}; {} robots in {} islands; windows of {} ticks\n", o.value("world", "?"),
        o.value("time_s", 0.0), o.value("tick", 0),
        o.value("paused", false) ? "paused" : "speed " + o.value("speed", "?"), o["robots"].size(),
        o.value("islands", 0), o.value("window_ticks", 0));
    say("{} windows, {} repeated; load balance {:.3f}; {} losses, {} recoveries, {} migrations, {} windows "
        "with work stealing\n",
        o.value("windows", 0), o.value("windows_repeated", 0), o.value("efficiency", 0.0),
        o.value("losses", 0), o.value("recoveries", 0), o.value("migrations", 0), o.value("cuts", 0));
    say("{:>4}  {:<32} {:<8} {:>7} {:>7} {:>8} {:>6} {:>10}\n", "id", "host/pid", "state", "threads",
        "robots", "islands", "load", "us/tick");
    for (const Json& m : o["members"])
        say("{:>4}  {:<32} {:<8} {:>7} {:>7} {:>8} {:>6.2f} {:>10.1f}\n", m.value("id", 0),
            m.value("name", ""), m.value("state", ""), m.value("threads", 0), m.value("robots", 0),
            m.value("islands", 0), m.value("load", 0.0), m.value("step_us", 0.0));
}

struct StatusOptions {
    std::string path;
    bool json = false;
    MemberOptions member;
};

Result<std::string> ask_status(const StatusOptions& o, const ClusterFile* file) {
    if (file == nullptr) {
        const Result<RunStatus> status = status_of_controller(o.member);
        if (!status) return status.error();
        return status_json(status.value());
    }
    const ClusterProcess& controller = file->processes.front();
    return run_on_host(*file, controller.host,
                       "exec " + quoted(file->program) +
                           " control status --quiet --patience 5 --simulation " + quoted(file->simulation) +
                           "\n");
}

/// The status of the started processes, as their hosts report it; an Error if the Controller does not run.
Result<Json> ask_processes(const ClusterFile& file) {
    Result<std::vector<Started>> all = read_notes(file);
    if (!all) return all.error();
    const Presence presence = ask_hosts(file, all.value());
    report(presence.silent);
    Json processes = Json::array();
    std::optional<Error> ended;
    for (std::size_t i = 0; i < all.value().size(); ++i) {
        const Started& s = all.value()[i];
        const std::optional<bool> runs = presence.runs[i];
        processes.push_back({{"name", s.name}, {"host", s.host}, {"pid", s.pid}, {"log", s.log}});
        processes.back()["runs"] = runs ? Json(*runs) : Json();
        if (runs.value_or(true)) continue;
        say(stderr, "roboss: {} (process {} on {}) has ended; its log: {} [process-ended]\n", s.name, s.pid,
            s.host, s.log);
        if (s.role != "controller") continue;
        const Result<std::string> log = run_on_host(file, s.host, "tail -n 5 " + quoted(s.log) + "\n");
        ended = Error{"the run has ended; the last lines of its log:\n" + (log ? log.value() : ""), "",
                      "run-ended"};
    }
    if (ended) return *ended;
    return processes;
}

int status(const StatusOptions& o) {
    std::optional<ClusterFile> file;
    Json processes = Json::array();
    if (!o.path.empty()) {
        Result<ClusterFile> loaded = load_cluster_file(o.path);
        if (!loaded) return print(loaded.error()), kBadInput;
        file = std::move(loaded).value();
        Result<Json> asked = ask_processes(*file);
        if (!asked) return print(asked.error()), kBadInput;
        processes = std::move(asked).value();
    }
    Result<std::string> text = ask_status(o, file ? &*file : nullptr);
    if (!text) return print(text.error()), kBadInput;
    Json run = Json::parse(text.value(), nullptr, false);
    if (!run.is_object() || !run.contains("members") || !run.contains("robots"))
        return print(Error{"unexpected reply of the run: " + text.value(), ""}), kRunFailed;
    if (file) run["processes"] = processes;
    if (o.json) return say("{}\n", run.dump(2)), kSuccess;
    print_status(run);
    return kSuccess;
}

}  // namespace

void add_cluster_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("cluster", "start, watch and end a run on many hosts");
    command->footer(kClusterFooter);
    command->require_subcommand(1);
    auto o = std::make_shared<StatusOptions>();
    CLI::App* sub =
        command->add_subcommand("up", "start the Controller, Simulators and Clients that the file lists");
    sub->add_option("hosts", o->path, "TOML file")->required();
    sub->add_flag("--json", o->json, "print the started processes as JSON");
    sub->callback([o, &exit_code] { exit_code = up(o->path, o->json); });
    sub = command->add_subcommand(
        "down", "end all processes that `up` started: the run first, then the remaining ones");
    sub->add_option("hosts", o->path, "TOML file")->required();
    sub->add_flag("--json", o->json, "print how many ended, and those that may still run, as JSON");
    sub->callback([o, &exit_code] { exit_code = down(o->path, o->json); });
    sub = command->add_subcommand("status",
                                  "print the load of each Simulator and how evenly the work is spread");
    sub->add_option("hosts", o->path, "TOML file; without it, the run is found by the network options");
    sub->add_flag("--json", o->json, "print JSON");
    add_member_options(*sub, o->member);
    sub->callback([o, sub, &exit_code] {
        note_given(*sub, o->member);
        exit_code = status(*o);
    });
}

}  // namespace roboss
