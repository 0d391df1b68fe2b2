// From a run in virtual time to its figures.
#include "cluster/measure.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "cluster/even_work.h"
#include "cluster/virtual_cluster.h"
#include "roles/simulator/window_stepper.h"

namespace roboss::bench {
namespace {

double share(double part, double whole) {
    return whole > 0 ? part / whole : 0;
}

/// What n Simulators could reach with so many equal islands, none of which can be parted.
double packing_ceiling(std::size_t islands, std::size_t n) {
    const std::size_t most = (islands + n - 1) / n;
    return static_cast<double>(islands) / static_cast<double>(n * most);
}

VirtualCluster::Options options_for(const Work& work, std::size_t simulators,
                                    const ClusterSettings& settings) {
    VirtualCluster::Options options;
    options.simulators = simulators;
    options.lanes = settings.lanes;
    options.network = settings.network;
    // Who cannot be cut short misses nothing, and keeps its cache to itself as on a computer of its own.
    options.network.mid_turn = work.model->robots.size() <= simulators * kLockstepMost;
    options.controller.seed = 7;
    options.controller.window_max = settings.window_max;
    options.controller.loss_ms = options.controller.resend_ms = 60'000;  // nothing is lost here
    if (!settings.work_stealing)
        options.controller.stealing_least_ns = std::numeric_limits<double>::infinity();
    options.controller.checkpoint_work_s = 0.2;  // as `roboss controller` has it
    return options;
}

void check_hash(const Work& work, std::uint64_t hash, const char* whose) {
    if (hash != work.hash) throw std::runtime_error(work.name + ": " + whose + " came to another state hash");
}

/// Both to the end of the work, by turns.
void run_by_turns(const Work& work, VirtualCluster& cluster, OneProcess& alone) {
    constexpr double kTurn_s = 0.1;  // so long that what a turn finds in caches is no matter
    double stepped_s = cluster.controller().counters().step_cpu_s;
    cluster.run_until(work.ticks, [&](double) {
        const double now_s = cluster.controller().counters().step_cpu_s;
        if (now_s - stepped_s < kTurn_s) return;
        stepped_s = now_s;
        alone.run_until(cluster.controller().tick());
    });
    alone.run_until(work.ticks);
    check_hash(work, cluster.controller().hash(), "the cluster");
    check_hash(work, alone.hash(), "one process");
}

/// Bytes of what Simulators tell of windows, so far.
double window_bytes(const VirtualCluster& cluster) {
    double bytes = 0;
    for (const char* name : {"WindowResult", "Late"}) {
        const auto found = cluster.network().received.find(name);
        if (found != cluster.network().received.end()) bytes += static_cast<double>(found->second.bytes);
    }
    return bytes;
}

/// The efficiency before messages if what islands cost is counted (Newton iterations) instead of measured, by
/// the Simulators and here: how well assignments share out the work, whatever the machine's moods.
double counted_efficiency(const Work& work, std::size_t simulators, VirtualCluster::Options options) {
    options.measure_cpu = false;
    options.network = {0, 0, 1e9, options.network.mid_turn};
    VirtualCluster cluster(work.model, options, work.start());
    cluster.run_until(work.settle);
    const Counters before = cluster.controller().counters();
    cluster.run_until(work.ticks);
    check_hash(work, cluster.controller().hash(), "the cluster of counted work");
    const Counters& c = cluster.controller().counters();
    return share(c.step_cpu_s - before.step_cpu_s,
                 static_cast<double>(simulators) * (c.critical_cpu_s - before.critical_cpu_s));
}

}  // namespace

Json measure(const Work& work, std::size_t simulators, const ClusterSettings& settings, bool one_island) {
    VirtualCluster::Options options = options_for(work, simulators, settings);
    options.controller.forecast.merge_all = one_island;
    VirtualCluster cluster(work.model, options, work.start());
    cluster.run_until(work.settle);
    OneProcess alone(work, settings.lanes, one_island);
    const Counters before = cluster.controller().counters();
    const double begin_s = cluster.time_s(), begin_cpu_s = cluster.controller_cpu_s(),
                 begin_bytes = window_bytes(cluster);
    run_by_turns(work, cluster, alone);

    const Counters& c = cluster.controller().counters();
    const auto since = [&](auto member) {
        return static_cast<double>(c.*member) - static_cast<double>(before.*member);
    };
    const double time_s = cluster.time_s() - begin_s, controller_s = cluster.controller_cpu_s() - begin_cpu_s;
    const auto n = static_cast<double>(simulators), robots = static_cast<double>(work.model->robots.size());
    const auto ticks = static_cast<double>(work.ticks - work.settle);
    const double windows = since(&Counters::windows);
    Json row = {{"world", one_island ? work.name + ", one island" : work.name},
                {"robots", work.model->robots.size()},
                {"simulators", simulators},
                {"ceiling", one_island ? 1 / n : packing_ceiling(work.model->robots.size(), simulators)},
                {"stepping", share(alone.step_cpu_s(), n * since(&Counters::critical_cpu_s))},
                {"everything", share(alone.step_cpu_s(), n * time_s)},
                {"dearer", share(since(&Counters::step_cpu_s), alone.step_cpu_s())},
                {"speedup", share(alone.cpu_s(), time_s)},
                {"step_us", 1e6 * time_s / ticks},
                {"alone_us", 1e6 * alone.cpu_s() / ticks},
                {"window_ticks", share(ticks, windows)},
                {"repeated", share(since(&Counters::windows_repeated), windows)},
                {"islands", share(since(&Counters::island_ticks), ticks)},
                {"migrations", share(since(&Counters::migrations), windows)},
                {"cuts", share(since(&Counters::cuts), windows)},
                {"controller_us", share(1e6 * controller_s, windows)},
                {"frame_bytes", share(window_bytes(cluster) - begin_bytes,
                                      robots * windows + since(&Counters::robots_repeated))}};
    if (settings.count_work) {
        row["counted"] = counted_efficiency(work, simulators, options);
        row["even"] = even_efficiency(work, simulators, settings.lanes);
    }
    return row;
}

Json detach(const Work& work, std::size_t simulators, Tick every, const ClusterSettings& settings) {
    VirtualCluster cluster(work.model, options_for(work, simulators, settings), work.start());
    constexpr double kBin_s = 0.5;  // simulated
    Json points = Json::array();
    double bin_began_s = 0;
    Tick bin_tick = 0, leaves_at = every;
    cluster.run_until(work.ticks, [&](double time_s) {
        const Tick tick = cluster.controller().tick();
        const double dt = work.model->dt_s;
        if (bin_tick == 0) bin_began_s = time_s, bin_tick = tick;  // joining is not stepping
        if (static_cast<double>(tick - bin_tick) * dt >= kBin_s) {
            points.push_back({static_cast<double>(tick) * dt,
                              1e6 * (time_s - bin_began_s) / static_cast<double>(tick - bin_tick),
                              cluster.controller().counters().simulators});
            bin_began_s = time_s, bin_tick = tick;
        }
        if (tick < leaves_at || leaves_at >= every * static_cast<Tick>(simulators)) return;
        cluster.controller().dismiss_simulator();
        leaves_at += every;
    });
    check_hash(work, cluster.controller().hash(), "the cluster");
    return points;
}

std::string line_of(const Json& row) {
    char text[500];
    const auto number = [&](const char* name) { return row[name].get<double>(); };
    std::snprintf(text, sizeof text,
                  "%-18s %5.0f robots, %2.0f Simulators: efficiency ceiling %.3f, stepping %.3f, everything "
                  "%.3f, a step %.3f times as dear as in one process; speed-up %.2f; %.1f us a step; "
                  "windows of %.1f ticks, %.3f repeated; Controller %.0f us a window, %.1f bytes a robot to "
                  "it; %.1f moves, %.1f cut short; in one process %.1f us a step",
                  row["world"].get<std::string>().c_str(), number("robots"), number("simulators"),
                  number("ceiling"), number("stepping"), number("everything"), number("dearer"),
                  number("speedup"), number("step_us"), number("window_ticks"), number("repeated"),
                  number("controller_us"), number("frame_bytes"), number("migrations"), number("cuts"),
                  number("alone_us"));
    if (!row.contains("counted")) return text;
    char counted[100];
    std::snprintf(counted, sizeof counted,
                  "; stepping by counted work %.3f; the same work everywhere, timed: %.3f", number("counted"),
                  number("even"));
    return std::string(text) + counted;
}

}  // namespace roboss::bench
