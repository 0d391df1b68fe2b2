// Scripts for a plain sh, and their output.
#include "app/cluster/host_processes.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <future>
#include <sstream>
#include <utility>

#include "app/cluster/remote_shell.h"
#include "net/key_folder.h"
#include "net/key_ring.h"

namespace roboss {
namespace {

constexpr std::size_t kAtOnce = 16;  // hosts contacted at the same time
constexpr int kKey_days = 365;

using HostScripts = std::map<std::string, std::string>;
using HostAnswers = std::map<std::string, Result<std::string>>;

std::vector<std::string> shell_on(const ClusterFile& file, const std::string& host) {
    if (host == "local") return {"sh", "-s"};
    std::vector<std::string> words = file.reach;
    for (std::string& word : words)
        if (const std::size_t at = word.find("{host}"); at != std::string::npos) word.replace(at, 6, host);
    return words;
}

/// Each host's own script, some hosts at a time.
HostAnswers run_on_hosts(const ClusterFile& file, const HostScripts& scripts) {
    HostAnswers answers;
    for (auto next = scripts.begin(); next != scripts.end();) {
        std::vector<std::pair<std::string, std::future<Result<std::string>>>> under_way;
        for (; next != scripts.end() && under_way.size() < kAtOnce; ++next)
            under_way.emplace_back(next->first, std::async(std::launch::async, [&file, next] {
                                       return run_script(shell_on(file, next->first), next->second);
                                   }));
        for (auto& [host, answer] : under_way) answers.emplace(host, answer.get());
    }
    return answers;
}

std::string in_folder(const ClusterFile& file) {
    return file.folder.empty() ? "" : "cd " + quoted(file.folder) + " || exit 3\n";
}

std::string path_of_log(const ClusterFile& file, const ClusterProcess& process) {
    return "\"$folder\"/" + quoted(file.simulation + "-" + process.name + ".log");
}

/// Where a process finds its key on its host.
std::string folder_of_key(const ClusterFile& file, const ClusterProcess& process) {
    return "\"${HOME:-/tmp}\"/.roboss/keys/" + quoted(file.simulation + "/" + process.name);
}

/// Writes a key there, readable by its owner alone.
std::string key_script(const ClusterFile& file, const ClusterProcess& process, const Credentials& keys) {
    std::string revoked;
    for (const std::string& serial : keys.revoked) revoked += serial + "\n";
    std::string script = fmt::format("(umask 077; mkdir -p {0} && cd {0} && rm -f revoked || exit 3\n",
                                     folder_of_key(file, process));
    const auto write = [&](const char* name, const std::string& text) {
        script += fmt::format("cat >{} <<'END-OF-KEY'\n{}END-OF-KEY\n", name, text);
    };
    for (const auto& [name, text] : key_files(keys)) write(name, *text);
    write("revoked", revoked);
    return script + ") || exit 3\n";
}

/// Starts processes on one host, given by their index in the file, and prints for each a line "+ INDEX PID
/// LOG", or
/// "- INDEX" and the end of its log.
std::string starting_script(const ClusterFile& file, const std::vector<std::size_t>& indices,
                            const std::vector<Credentials>& keys) {
    const std::string program = quoted(file.program);
    const char* absent =
        file.program.find('/') == std::string::npos
            ? "\"is not found by PATH, which is $PATH there: give its full path as program [no-program]\""
            : "\"does not exist there [no-program]\"";
    std::string script = in_folder(file) + fmt::format(R"(folder="${{HOME:-/tmp}}/.roboss/logs"
(umask 077; mkdir -p "$folder") || exit 3
command -v {0} >/dev/null || {{ echo {0} {1}; exit 3; }}
)",
                                                       program, absent);
    for (const std::size_t i : indices) {
        const ClusterProcess& process = file.processes[i];
        if (!file.insecure) script += key_script(file, process, keys[i]);
        // A log is for its owner alone.
        script += fmt::format(
            "rm -f {0}; (umask 077; : >{0}) || exit 3\nsetsid nohup {1} >>{0} 2>&1 </dev/null &\npid{2}=$!\n",
            path_of_log(file, process), command_line(file, process, process.arguments), i);
    }
    script += "sleep 0.5\n";
    for (const std::size_t i : indices)
        script += fmt::format(
            "if kill -0 $pid{0} 2>/dev/null; then echo \"+ {0} $pid{0} \"{1}; else echo '- {0}'; tail -n 5 "
            "{1}; fi\n",
            i, path_of_log(file, file.processes[i]));
    return script;
}

/// A command that succeeds if the process runs and is the one that was started.
std::string about(const Started& process, const ClusterFile& file) {
    return fmt::format("tr '\\0' ' ' 2>/dev/null </proc/{0}/cmdline | grep -qF -e {1}", process.pid,
                       quoted("--simulation " + file.simulation + " "));
}

/// Parses the output of the starting script into `outcome`.
void take_output(const ClusterFile& file, const std::string& host, const std::string& output,
                 StartOutcome& outcome) {
    std::istringstream lines(output);
    Error* failure = nullptr;
    for (std::string line; std::getline(lines, line);) {
        char sign = 0;
        std::size_t i = 0;
        Started started{"", "", host, "", 0};
        std::istringstream words(line);
        if (!(words >> sign >> i) || (sign != '+' && sign != '-') || i >= file.processes.size()) {
            if (failure != nullptr) failure->message += "\n" + line;
            continue;
        }
        started.name = file.processes[i].name, started.role = file.processes[i].role;
        if (sign == '+' && words >> started.pid >> std::ws && std::getline(words, started.log))
            outcome.started.push_back(started), failure = nullptr;
        else
            failure = &outcome.errors.emplace_back(
                Error{started.name + " on " + host + ": it ended immediately:", ""});
    }
}

}  // namespace

std::string command_line(const ClusterFile& file, const ClusterProcess& process,
                         const std::vector<std::string>& arguments) {
    std::string line = quoted(file.program);
    for (const std::string& word : arguments) line += " " + quoted(word);
    line += " --simulation " + quoted(file.simulation);
    for (const std::string& word : process.network) line += " " + quoted(word);
    return line + (file.insecure ? " --insecure" : " --keys " + folder_of_key(file, process));
}

Result<std::vector<Credentials>> keys_of(const ClusterFile& file) {
    std::vector<Credentials> all;
    if (file.insecure) return all;
    Result<KeyRing> ring = KeyRing::open(file.keys);
    if (!ring) return ring.error();
    for (const ClusterProcess& process : file.processes) {
        const Result<Seat> seat = seat_of(process.role);
        if (!seat) return seat.error();
        if (!ring.value().has(process.name))
            if (Result<> added = ring.value().add(process.name, seat.value(), kKey_days); !added)
                return added.error();
        Result<Credentials> keys = ring.value().credentials(process.name);
        if (!keys) return keys.error();
        all.push_back(std::move(keys).value());
    }
    return all;
}

StartOutcome start_processes(const ClusterFile& file, const std::vector<Credentials>& keys) {
    std::map<std::string, std::vector<std::size_t>> indices;
    for (std::size_t i = 0; i < file.processes.size(); ++i) indices[file.processes[i].host].push_back(i);
    HostScripts scripts;
    for (const auto& [host, its] : indices) scripts[host] = starting_script(file, its, keys);
    StartOutcome outcome;
    for (const auto& [host, output] : run_on_hosts(file, scripts)) {
        if (output) {
            take_output(file, host, output.value(), outcome);
            continue;
        }
        std::string who = file.processes[indices[host].front()].name;
        if (indices[host].size() > 1) who += fmt::format(" and {} more", indices[host].size() - 1);
        outcome.errors.push_back(
            {fmt::format("{} on {}: {}", who, host, output.error().message), output.error().remedy});
    }
    return outcome;
}

Presence ask_hosts(const ClusterFile& file, const std::vector<Started>& all) {
    HostScripts scripts;
    for (std::size_t i = 0; i < all.size(); ++i)
        scripts[all[i].host] += fmt::format("{} && echo '+ {}'\n", about(all[i], file), i);
    for (auto& [host, script] : scripts) script += "true\n";
    Presence presence;
    presence.runs.resize(all.size());
    for (const auto& [host, output] : run_on_hosts(file, scripts)) {
        if (!output) {
            presence.silent[host] = output.error().message;
            continue;
        }
        for (std::size_t i = 0; i < all.size(); ++i)
            if (all[i].host == host) presence.runs[i] = false;
        std::istringstream lines(output.value());
        for (std::string line; std::getline(lines, line);) {
            std::istringstream words(line);
            char sign = 0;
            std::size_t i = 0;
            if (words >> sign >> i && sign == '+' && i < all.size()) presence.runs[i] = true;
        }
    }
    return presence;
}

void send_signal(const ClusterFile& file, const std::vector<Started>& to, const char* name) {
    HostScripts scripts;
    for (const Started& s : to)
        scripts[s.host] += about(s, file) + fmt::format(" && kill -{} {}\n", name, s.pid);
    (void)run_on_hosts(file, scripts);
}

Result<std::string> run_on_host(const ClusterFile& file, const std::string& host, const std::string& script) {
    return run_script(shell_on(file, host), in_folder(file) + script);
}

}  // namespace roboss
