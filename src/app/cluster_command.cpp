// Starting, watching and ending the processes of a run on many hosts. It only starts and ends; who takes part
// in the run is between the members and the Controller, and any of them may as well be started by hand.
#include "app/cluster_command.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cluster_file.h"
#include "app/control_command.h"
#include "app/exit_codes.h"
#include "app/member.h"
#include "app/remote_shell.h"
#include "app/run.h"

namespace roboss {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kAtOnce = 16;  // shells open at the same time

const char* const kFooter =
    R"(HOSTS.toml says what runs where:

  simulation = "city"              # name of the run
  program = "/opt/roboss/bin/roboss"    # on the hosts; default: roboss, found by PATH
  folder = "/home/me/worlds"       # in which all is started there
  interface = "eth0"               # for all, and again for one where it differs; also: domain, peers = [...],
                                   # discovery_server = "HOST:PORT", multicast = false
  [controller]
  host = "node1"                   # as ssh knows it, or "local"
  world = "city.sdf"
  options = ["--simulators", "8", "--journal", "city.journal"]    # as of `roboss controller`
  [[simulators]]
  host = "node2"
  count = 4                        # processes there
  threads = 2                      # of each
  [[clients]]
  host = "node1"
  program = "driver.so"

Hosts are reached by ssh without a password (an agent or a key); reach = ["ip", "netns", "exec", "{host}", "sh", "-s"]
names another way to have a shell that reads a script. What was started is noted beside the file (HOSTS.toml.running),
logs are on the hosts under ~/.roboss/logs.

Examples:
  roboss cluster up hosts.toml
  roboss cluster status hosts.toml
  roboss cluster status --simulation city --interface eth0      # of any run, however it was started
  roboss cluster down hosts.toml

Exit codes: 0 done, 1 the file is wrong or nothing is there, 2 wrong usage, 3 a host cannot be reached or a process does not start.)";

struct Started {
    std::string name, role, host, log;
    long pid = 0;
};

std::vector<std::string> shell_on(const ClusterFile& file, const std::string& host) {
    if (host == "local") return {"sh", "-s"};
    std::vector<std::string> words = file.reach;
    for (std::string& word : words)
        if (const std::size_t at = word.find("{host}"); at != std::string::npos) word.replace(at, 6, host);
    return words;
}

/// `arguments` for `roboss` where this process is.
std::string command_line(const ClusterFile& file, const ClusterProcess& process,
                         const std::vector<std::string>& arguments) {
    std::string line = quoted(file.program);
    for (const std::string& word : arguments) line += " " + quoted(word);
    line += " --simulation " + quoted(file.simulation);
    for (const std::string& word : process.network) line += " " + quoted(word);
    return line;
}

std::string in_folder(const ClusterFile& file) {
    return file.folder.empty() ? "" : "cd " + quoted(file.folder) + " || exit 3\n";
}

std::string starting_script(const ClusterFile& file, const ClusterProcess& process) {
    return in_folder(file) + fmt::format(R"(folder="${{HOME:-/tmp}}/.roboss/logs"
mkdir -p "$folder" || exit 3
log="$folder/"{}
command -v {} >/dev/null || {{ echo {} is not there; exit 3; }}
setsid nohup {} >"$log" 2>&1 </dev/null &
pid=$!
sleep 0.5
kill -0 $pid 2>/dev/null || {{ echo it ended at once:; tail -n 5 "$log"; exit 4; }}
echo "started $pid $log"
)",
                                         quoted(file.simulation + "-" + process.name + ".log"),
                                         quoted(file.program), quoted(file.program),
                                         command_line(file, process, process.arguments));
}

/// Asks for the process, and makes sure that it is the one that was started.
std::string about(const Started& process, const ClusterFile& file) {
    return fmt::format("tr '\\0' ' ' </proc/{0}/cmdline 2>/dev/null | grep -qF -e {1}", process.pid,
                       quoted("--simulation " + file.simulation + " "));
}

std::string notes_of(const ClusterFile& file) {
    return file.path + ".running";
}

Result<> write_notes(const ClusterFile& file, const std::vector<Started>& all) {
    Json o{{"simulation", file.simulation}, {"processes", Json::array()}};
    for (const Started& s : all)
        o["processes"].push_back(
            {{"name", s.name}, {"role", s.role}, {"host", s.host}, {"pid", s.pid}, {"log", s.log}});
    std::ofstream out(notes_of(file));
    if (out << o.dump(1) << '\n') return Ok{};
    return Error{notes_of(file) + " cannot be written",
                 "what was started cannot be ended by `down` then: put the file where you may write"};
}

Result<std::vector<Started>> read_notes(const ClusterFile& file) {
    std::ifstream in(notes_of(file));
    const Json o = Json::parse(in, nullptr, false);
    if (!in || o.is_discarded() || !o.contains("processes"))
        return Error{"nothing was started by " + file.path,
                     "`roboss cluster up " + file.path + "` starts it"};
    std::vector<Started> all;
    for (const Json& p : o["processes"])
        all.push_back({p.value("name", ""), p.value("role", ""), p.value("host", ""), p.value("log", ""),
                       p.value("pid", 0l)});
    return all;
}

/// Runs what(i) for all i, some at a time.
template <class What>
void side_by_side(std::size_t count, What&& what) {
    for (std::size_t first = 0; first < count; first += kAtOnce) {
        std::vector<std::future<void>> under_way;
        for (std::size_t i = first; i < std::min(count, first + kAtOnce); ++i)
            under_way.push_back(std::async(std::launch::async, [&what, i] { what(i); }));
    }
}

Result<Started> start(const ClusterFile& file, const ClusterProcess& process) {
    Result<std::string> said = run_script(shell_on(file, process.host), starting_script(file, process));
    if (!said)
        return Error{process.name + " on " + process.host + ": " + said.error().text(),
                     "see that the host is reached and has the program"};
    Started started{process.name, process.role, process.host, "", 0};
    std::istringstream words(said.value());
    for (std::string word; words >> word;)
        if (word == "started" && words >> started.pid >> started.log) return started;
    return Error{process.name + " on " + process.host + " said: " + said.value(),
                 "is there a shell behind `reach`?"};
}

/// Those of `all` that still run, by their hosts' word.
std::vector<bool> alive(const ClusterFile& file, const std::vector<Started>& all) {
    std::vector<char> lives(all.size(), 0);
    side_by_side(all.size(), [&](std::size_t i) {
        lives[i] = run_script(shell_on(file, all[i].host), about(all[i], file) + "\n").ok() ? 1 : 0;
    });
    return {lives.begin(), lives.end()};
}

int up(const std::string& path) {
    Result<ClusterFile> file = load_cluster_file(path);
    if (!file) return print(file.error()), kBadInput;
    if (Result<std::vector<Started>> before = read_notes(file.value()); before) {
        const std::vector<bool> lives = alive(file.value(), before.value());
        if (std::find(lives.begin(), lives.end(), true) != lives.end())
            return print(Error{"it is up already", "`roboss cluster down " + path + "` ends it first"}),
                   kRunFailed;
    }
    const std::vector<ClusterProcess>& processes = file.value().processes;
    std::vector<Result<Started>> results(processes.size(), Error{"not started", ""});
    side_by_side(processes.size(), [&](std::size_t i) { results[i] = start(file.value(), processes[i]); });
    std::vector<Started> all;
    bool good = true;
    for (const Result<Started>& result : results) {
        good = good && result.ok();
        if (!result) print(result.error());
        if (!result) continue;
        all.push_back(result.value());
        fmt::print("{:<24} on {:<16} process {}, log {}\n", all.back().name, all.back().host, all.back().pid,
                   all.back().log);
    }
    if (Result<> written = write_notes(file.value(), all); !written) print(written.error()), good = false;
    if (!good)
        fmt::print(stderr, "roboss: not all has started; `roboss cluster down {}` ends the rest\n", path);
    return good ? kDone : kRunFailed;
}

/// Waits for the end of all, at most so long; those that are left.
std::vector<Started> outlived(const ClusterFile& file, std::vector<Started> all, int seconds) {
    for (int i = 0; i <= 2 * seconds && !all.empty(); ++i) {
        if (i > 0) std::this_thread::sleep_for(std::chrono::milliseconds(500));
        const std::vector<bool> lives = alive(file, all);
        std::vector<Started> left;
        for (std::size_t k = 0; k < all.size(); ++k)
            if (lives[k]) left.push_back(all[k]);
        all = std::move(left);
    }
    return all;
}

void send_signal(const ClusterFile& file, const std::vector<Started>& to, const char* name) {
    side_by_side(to.size(), [&](std::size_t i) {
        (void)run_script(shell_on(file, to[i].host),
                         about(to[i], file) + fmt::format(" && kill -{} {}\n", name, to[i].pid));
    });
}

int down(const std::string& path) {
    Result<ClusterFile> file = load_cluster_file(path);
    if (!file) return print(file.error()), kBadInput;
    Result<std::vector<Started>> all = read_notes(file.value());
    if (!all) return print(all.error()), kBadInput;
    std::vector<Started> controller, others;
    for (const Started& s : all.value()) (s.role == "controller" ? controller : others).push_back(s);
    send_signal(file.value(), controller,
                "INT");  // as Ctrl-C: the run ends as at its duration, and sends everybody home
    std::vector<Started> left = outlived(file.value(), all.value(), 10);
    for (const char* name : {"TERM", "KILL"}) {
        if (left.empty()) break;
        send_signal(file.value(), left, name);
        left = outlived(file.value(), left, 5);
    }
    for (const Started& s : left)
        fmt::print(stderr, "roboss: {} (process {} on {}) does not end\n", s.name, s.pid, s.host);
    if (!left.empty()) return kRunFailed;
    std::filesystem::remove(notes_of(file.value()));
    fmt::print("all {} processes have ended\n", all.value().size());
    return kDone;
}

void print_status(const Json& o) {
    fmt::print("{} at {:.3f} s (tick {}), {}; {} robots in {} islands; windows of {} ticks\n",
               o.value("world", "?"), o.value("time_s", 0.0), o.value("tick", 0),
               o.value("paused", false) ? "paused" : "speed " + o.value("speed", "?"), o["robots"].size(),
               o.value("islands", 0), o.value("window_ticks", 0));
    fmt::print(
        "{} windows, {} repeated; efficiency before messages {:.3f}; {} losses, {} recoveries, {} "
        "migrations\n",
        o.value("windows", 0), o.value("windows_repeated", 0), o.value("efficiency", 0.0),
        o.value("losses", 0), o.value("recoveries", 0), o.value("migrations", 0));
    fmt::print("{:>4}  {:<32} {:<8} {:>7} {:>7} {:>8} {:>6} {:>10}\n", "id", "where", "state", "threads",
               "robots", "islands", "load", "us a tick");
    for (const Json& m : o["members"])
        fmt::print("{:>4}  {:<32} {:<8} {:>7} {:>7} {:>8} {:>6.2f} {:>10.1f}\n", m.value("id", 0),
                   m.value("name", ""), m.value("state", ""), m.value("threads", 0), m.value("robots", 0),
                   m.value("islands", 0), m.value("load", 0.0), m.value("step_us", 0.0));
}

struct StatusOptions {
    std::string path;
    bool json = false;
    MemberOptions member;
};

Result<std::string> ask_status(const StatusOptions& o, const ClusterFile* file) {
    if (file == nullptr) return request_of_controller(o.member, {"status"});
    const std::string script =
        in_folder(*file) + "exec " +
        command_line(*file, file->processes.front(), {"control", "status", "--quiet", "--patience", "5"}) +
        "\n";
    return run_script(shell_on(*file, file->processes.front().host), script);
}

int status(const StatusOptions& o) {
    std::optional<ClusterFile> file;
    Json processes = Json::array();
    if (!o.path.empty()) {
        Result<ClusterFile> loaded = load_cluster_file(o.path);
        if (!loaded) return print(loaded.error()), kBadInput;
        file = std::move(loaded).value();
        Result<std::vector<Started>> all = read_notes(*file);
        if (!all) return print(all.error()), kBadInput;
        const std::vector<bool> lives = alive(*file, all.value());
        for (std::size_t i = 0; i < lives.size(); ++i) {
            const Started& s = all.value()[i];
            processes.push_back({{"name", s.name},
                                 {"host", s.host},
                                 {"pid", s.pid},
                                 {"runs", static_cast<bool>(lives[i])},
                                 {"log", s.log}});
            if (!lives[i])
                fmt::print(stderr, "roboss: {} (process {} on {}) has ended; its log: {}\n", s.name, s.pid,
                           s.host, s.log);
        }
    }
    Result<std::string> text = ask_status(o, file ? &*file : nullptr);
    if (!text) return print(text.error()), kBadInput;
    Json told = Json::parse(text.value(), nullptr, false);
    if (told.is_discarded()) return print(Error{"the run said: " + text.value(), ""}), kRunFailed;
    if (file) told["processes"] = processes;
    if (o.json) return fmt::print("{}\n", told.dump(2)), kDone;
    print_status(told);
    return kDone;
}

}  // namespace

void add_cluster_command(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("cluster", "start, watch and end a run on many hosts");
    command->footer(kFooter);
    command->require_subcommand(1);
    auto o = std::make_shared<StatusOptions>();
    CLI::App* sub =
        command->add_subcommand("up", "start Controller, Simulators and Clients as the file says");
    sub->add_option("hosts", o->path, "TOML file")->required();
    sub->callback([o, &exit_code] { exit_code = up(o->path); });
    sub = command->add_subcommand("down", "end all that `up` has started: the run first, then who is left");
    sub->add_option("hosts", o->path, "TOML file")->required();
    sub->callback([o, &exit_code] { exit_code = down(o->path); });
    sub = command->add_subcommand("status", "who has what, and how evenly the work is spread");
    sub->add_option("hosts", o->path, "TOML file; without it the run is found by the network options");
    sub->add_flag("--json", o->json, "as JSON");
    add_member_options(*sub, o->member);
    sub->callback([o, &exit_code] { exit_code = status(*o); });
}

}  // namespace roboss
