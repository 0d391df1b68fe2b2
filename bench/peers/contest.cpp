// See contest.h.
#include "peers/contest.h"

#include <algorithm>
#include <cstdio>
#include <memory>

#include "median.h"
#include "peers/worker.h"

namespace roboss::bench {
namespace {

/// An engine in the contest.
struct Entry {
    Row row;
    std::unique_ptr<Worker> worker;
    int block_ticks = 0;
    std::vector<double> us;  // a block
};

void give_up(Entry& entry, const std::string& why) {
    entry.row.skipped = why;
    entry.worker.reset();
}

bool is_wanted(const std::vector<std::string>& wanted, const std::string& name) {
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
}

/// Builds and settles in ten parts, so that a slow engine is known early.
void settle(Entry& entry, const ContestOptions& options) {
    const int part = std::max(1, options.settle / 10);
    double spent = 0;
    for (int done = 0; done < options.settle; done += part) {
        const Report report = entry.worker->run(part, options.start_limit_s);
        if (report.failed) return give_up(entry, report.text);
        entry.row.engine = report.engine, entry.row.settings = report.settings;
        entry.row.build_s = report.build_s;
        spent += report.cpu_s;
        const double expected = report.build_s + spent * options.settle / (done + part);
        if (expected > options.start_limit_s) {
            char why[120];
            std::snprintf(why, sizeof why, "%d steps to settle would take %.0f s (limit %.0f s)",
                          options.settle, expected, options.start_limit_s);
            return give_up(entry, why);
        }
    }
    const double a_step = spent / options.settle;
    const int affordable = static_cast<int>(options.limit_s / std::max(a_step, 1e-9));
    entry.block_ticks = options.block_of(std::clamp(affordable, options.blocks, options.steps));
}

void run_block(Entry& entry, std::size_t robots, const ContestOptions& options) {
    const Report report = entry.worker->run(entry.block_ticks, 10 * options.limit_s);
    if (report.failed) return give_up(entry, report.text);
    entry.us.push_back(1e6 * report.cpu_s / entry.block_ticks / static_cast<double>(robots));
    entry.row.steps += entry.block_ticks;
}

void finish(Entry& entry, std::size_t robots, const ContestOptions& options) {
    const Report report = entry.worker->judge(options.start_limit_s);
    if (report.failed) return give_up(entry, report.text);
    entry.row.set_times(entry.us);
    entry.row.bytes_per_robot = report.bytes / static_cast<double>(robots);
    entry.row.right = report.good, entry.row.verdict = report.text;
    entry.worker.reset();
}

}  // namespace

void Row::set_times(const std::vector<double>& us) {
    const auto [least, most] = std::minmax_element(us.begin(), us.end());
    us_least = *least, us_median = median(us), us_most = *most;
}

std::vector<Row> hold_contest(const SceneKind& kind, std::size_t robots, const ContestOptions& wanted,
                              std::span<const EngineKind> engines) {
    ContestOptions options = wanted;
    options.steps = options.steps_of(robots);
    const Scene scene = kind.make(robots);
    options.settle = std::max(options.settle, scene.settle);
    std::vector<Entry> entries;
    for (const EngineKind& engine : engines) {
        if (!is_wanted(options.engines, engine.name)) continue;
        std::fprintf(stderr, "  %s: building and settling\n", engine.name.c_str());
        Entry& entry = entries.emplace_back();
        entry.row.scene = kind.name, entry.row.robots = robots, entry.row.engine = engine.name;
        entry.worker = std::make_unique<Worker>(engine, scene, options.accuracy);
        settle(entry, options);
        if (!entry.row.skipped.empty())
            std::fprintf(stderr, "  %s: left out: %s\n", engine.name.c_str(), entry.row.skipped.c_str());
    }
    for (int block = 0; block < options.blocks; ++block) {
        std::fprintf(stderr, "  block %d of %d\n", block + 1, options.blocks);
        for (Entry& entry : entries)
            if (entry.worker) run_block(entry, robots, options);
    }
    std::vector<Row> rows;
    for (Entry& entry : entries) {
        if (entry.worker) finish(entry, robots, options);
        rows.push_back(entry.row);
    }
    const double ours = rows.empty() || !rows[0].engine.starts_with("RoBOSS") ? 0 : rows[0].us_median;
    for (Row& row : rows) {
        row.ratio = ours > 0 ? row.us_median / ours : 0;
        const double step_us = row.us_median * static_cast<double>(robots);
        row.real_time_factor = step_us > 0 ? 1e6 * scene.dt_s / step_us : 0;
    }
    return rows;
}

}  // namespace roboss::bench
