// Watches the Simulator processes of a run, and describes their failures.
#include "app/processes/simulator_processes.h"

#include <fmt/format.h>

#include <algorithm>

#include "bus/bus.h"

namespace roboss {
namespace {

constexpr std::size_t kLinesShown = 5;  // of a log
constexpr std::size_t kMembersShown = 4;

}  // namespace

Result<> SimulatorProcesses::start(const std::vector<std::string>& arguments) {
    Result<LocalProcess> process = LocalProcess::start(arguments);
    if (!process) return process.error();
    processes_.push_back({++started_, std::move(process).value()});
    return Ok{};
}

std::vector<std::string> SimulatorProcesses::names() const {
    std::vector<std::string> names;
    for (const Member& member : processes_) names.push_back(process_name(member.process.id()));
    return names;
}

bool SimulatorProcesses::has(const std::string& name) const {
    return std::ranges::any_of(
        processes_, [&](const Member& member) { return name == process_name(member.process.id()); });
}

bool SimulatorProcesses::kill(const std::string& name) {
    for (Member& member : processes_) {
        if (name != process_name(member.process.id())) continue;
        member.process.kill();
        return true;
    }
    return false;
}

Result<> SimulatorProcesses::watch_start(const std::vector<std::string>& joined, std::uint64_t fetched,
                                         std::int64_t now_ms, std::int64_t patience_ms) {
    if (!starting_) return Ok{};
    if (moved_ms_ == 0 || fetched != fetched_) moved_ms_ = now_ms;
    fetched_ = fetched;
    bool all = true;
    for (Member& member : processes_) {
        const bool was_there = member.joined;
        member.joined = was_there || std::find(joined.begin(), joined.end(),
                                               process_name(member.process.id())) != joined.end();
        if (member.joined && !was_there) moved_ms_ = now_ms;
        all = all && member.joined;
    }
    if (const std::vector<std::string> ended = take_ended(); !ended.empty()) return have_ended(ended);
    if (all) starting_ = false;
    if (all || now_ms - moved_ms_ < patience_ms) return Ok{};
    return have_not_joined(now_ms - moved_ms_);
}

std::vector<std::string> SimulatorProcesses::take_ended() {
    std::vector<std::string> lines;
    std::erase_if(processes_, [&](Member& member) {
        const auto ended = member.process.ended();
        if (!ended) return false;
        lines.push_back(name_of(member) + " " + *ended);
        if (const std::string log = member.process.last_lines(kLinesShown); !log.empty())
            lines.back() += "; end of its log:\n" + log;
        return true;
    });
    return lines;
}

std::string SimulatorProcesses::name_of(const Member& member) const {
    return fmt::format("Simulator process {} of {} (pid {})", member.number, started_, member.process.id());
}

Error SimulatorProcesses::have_ended(const std::vector<std::string>& lines) const {
    std::string message;
    for (std::size_t i = 0; i < std::min(lines.size(), kMembersShown); ++i)
        message += (i == 0 ? "" : "\n") + lines[i];
    if (lines.size() > kMembersShown)
        message += fmt::format("\nand {} others ended", lines.size() - kMembersShown);
    return {message + "\nbefore the start of the run",
            "see the reason above; fewer --processes need less memory and time", "process-ended"};
}

Error SimulatorProcesses::have_not_joined(std::int64_t silent_ms) const {
    std::string message;
    std::size_t absent = 0;
    for (const Member& member : processes_) {
        if (member.joined || ++absent > kMembersShown) continue;
        message += fmt::format("{} has not joined; state: {}\n", name_of(member), member.process.doing());
        if (const std::string log = member.process.last_lines(kLinesShown); !log.empty())
            message += "end of its log:\n" + log + "\n";
    }
    if (absent > kMembersShown)
        message += fmt::format("and {} others have not joined\n", absent - kMembersShown);
    message += fmt::format("no Simulator joined for {:.1f} s", 1e-3 * static_cast<double>(silent_ms));
    return {message, "see the states above; fewer --processes need less memory and time", "not-joined"};
}

void SimulatorProcesses::await_exit(std::int64_t ms_max) {
    const std::int64_t end = monotonic_ms() + ms_max;
    for (Member& member : processes_)
        member.process.wait(static_cast<int>(std::max<std::int64_t>(end - monotonic_ms(), 0)));
    processes_.clear();
}

}  // namespace roboss
