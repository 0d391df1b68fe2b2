// Writes the log of a run with spdlog.
#include "app/output/event_log.h"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <utility>

#include "app/output/cannot_write.h"
#include "core/printable.h"

namespace roboss {
namespace {

constexpr std::size_t kRangesMax = 24;  // of ids in a line; `roboss control groups` prints them all

/// Quoted, without line breaks.
std::string quoted(const std::string& text) {
    std::string word = "\"";
    for (const char c : printable_line(text)) {
        if (c == '"' || c == '\\') word += '\\';
        word += c;
    }
    return word + '"';
}

/// RobotIds of a Simulator, as 0-4,7,9-12.
std::string ranges(const std::vector<std::uint32_t>& ids) {
    std::string text;
    std::size_t count = 0;
    for (std::size_t i = 0; i < ids.size();) {
        if (++count > kRangesMax) return text + ",...";
        std::size_t last = i;
        while (last + 1 < ids.size() && ids[last + 1] == ids[last] + 1) ++last;
        text += fmt::format("{}{}", text.empty() ? "" : ",", ids[i]);
        if (last > i) text += fmt::format("-{}", ids[last]);
        i = last + 1;
    }
    return text;
}

}  // namespace

std::vector<std::string> state_lines(const Simulation& simulation) {
    const Counters& c = simulation.counters();
    const std::size_t robots = simulation.model().robots.size();
    const std::vector<MemberReport> members = simulation.members();
    std::vector<std::vector<std::uint32_t>> has(members.size());
    for (std::uint32_t r = 0; r < robots; ++r)
        if (const std::uint32_t seat = simulation.seat_of(RobotId(r)); seat < has.size())
            has[seat].push_back(r);
    std::vector<std::string> lines;
    lines.push_back(fmt::format(
        "event=state time_s={:.3f} simulators={} robots={} islands={} window={} windows={} repeated={} "
        "efficiency={:.3f} losses={} recoveries={} migrations={} cuts={}",
        simulation.time_s(), c.simulators, robots, c.islands_now, simulation.window_ticks(), c.windows,
        c.windows_repeated, simulation.balance(), c.losses, c.recoveries, c.migrations, c.cuts));
    for (std::size_t seat = 0; seat < members.size(); ++seat) {
        const MemberReport& member = members[seat];
        if (!member.alive) continue;
        lines.push_back(fmt::format(
            "event=load simulator={} name={} leaving={} threads={} robots={} islands={} step_us={:.1f} "
            "load={:.3f} has={}",
            member.number, quoted(member.name), member.leaving, member.threads, has[seat].size(),
            member.islands, member.step_us, member.load, ranges(has[seat])));
    }
    return lines;
}

Result<EventLog> EventLog::open(const std::string& path, double every_s) {
    std::shared_ptr<spdlog::sinks::sink> sink;
    try {
        if (path == "-")
            sink = std::make_shared<spdlog::sinks::stderr_sink_st>();
        else
            sink = std::make_shared<spdlog::sinks::basic_file_sink_st>(path);
    } catch (const spdlog::spdlog_ex& e) {
        return cannot_write(path, "the log ", e.what());
    }
    auto logger = std::make_shared<spdlog::logger>("roboss", std::move(sink));
    logger->set_pattern("%Y-%m-%dT%H:%M:%S.%eZ level=%l %v", spdlog::pattern_time_type::utc);
    logger->flush_on(spdlog::level::info);
    return EventLog(std::move(logger), every_s);
}

void EventLog::event(Tick tick, const std::string& text) {
    logger_->info("tick={} event=notice text={}", tick, quoted(text));
}

void EventLog::message(Tick tick, const std::string& text) {
    logger_->info("tick={} event=message text={}", tick, quoted(text));
}

void EventLog::end(Tick tick, const std::string& code) {
    logger_->info("tick={} event=end code={}", tick, code);
}

void EventLog::write_state_if_due(const Simulation& simulation) {
    if (std::chrono::duration<double>(Clock::now() - written_).count() >= every_s_) write_state(simulation);
}

void EventLog::write_state(const Simulation& simulation) {
    written_ = Clock::now();
    for (const std::string& line : state_lines(simulation))
        logger_->info("tick={} {}", simulation.tick(), line);
}

}  // namespace roboss
