// roboss-table1: the paper's experiment. Fifty cars in the city on 1 to 12 Simulators, and larger ones; one
// Simulator is detached every so often; and the worst case, one island of all robots.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cluster/crowd.h"
#include "cluster/dds_costs.h"
#include "cluster/virtual_cluster.h"
#include "cluster/work.h"
#include "physics/step.h"

namespace {

using namespace roboss;
using namespace roboss::bench;
using Json = nlohmann::ordered_json;

struct Wishes {
    std::vector<std::size_t> cars{50, 500, 2000};
    std::vector<std::size_t> simulators{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    std::string driver, worlds = "worlds", json;
    std::vector<std::size_t> crowd;
    double seconds = 20;  // simulated, for 50 cars; larger worlds take their share
    Tick window_max = 64;
    std::size_t lanes = 1;
    double send_us = -1, way_us = -1;
};

double share(double part, double whole) {
    return whole > 0 ? part / whole : 0;
}

/// What n Simulators could reach at best with fifty equal islands that cannot be parted, and so on.
double even_ceiling(std::size_t islands, std::size_t n) {
    const std::size_t most = (islands + n - 1) / n;
    return static_cast<double>(islands) / static_cast<double>(n * most);
}

Json measure(const Work& work, std::size_t n, const Wishes& wishes, const NetworkCosts& network,
             bool one_island) {
    VirtualCluster::Options options;
    options.simulators = n;
    options.lanes = wishes.lanes;
    options.network = network;
    options.controller.seed = 7;
    options.controller.window_max = wishes.window_max;
    options.controller.loss_ms = 60'000;
    options.controller.checkpoint_work_s = 0.2;  // as `roboss controller` has it
    options.controller.forecast.merge_all = one_island;
    VirtualCluster cluster(work.model, options, work.start());
    double begin_s = 0, begin_cpu_s = 0;
    cluster.run_until(1, [&](double) {});
    begin_s = cluster.time_s(), begin_cpu_s = cluster.controller_cpu_s();
    const Counters before = cluster.controller().counters();
    cluster.run_until(work.ticks);
    if (cluster.controller().hash() != work.hash)
        throw std::runtime_error(work.name + ": another state hash");
    const Counters& c = cluster.controller().counters();
    const double time_s = cluster.time_s() - begin_s, nn = static_cast<double>(n);
    const auto windows = static_cast<double>(c.windows - before.windows);
    const auto robots = static_cast<double>(work.model->robots.size());
    Json row{{"world", work.name},
             {"robots", work.model->robots.size()},
             {"simulators", n},
             {"one_island", one_island}};
    row["ceiling"] = one_island ? 1 / nn : even_ceiling(work.model->robots.size(), n);
    row["balanced"] = share(work.step_cpu_s, nn * (c.critical_cpu_s - before.critical_cpu_s));
    row["all"] = share(work.step_cpu_s, nn * time_s);
    row["speedup"] = share(work.process_cpu_s, time_s);
    row["step_us"] = 1e6 * time_s / static_cast<double>(work.ticks);
    row["window_ticks"] = share(static_cast<double>(work.ticks), windows);
    row["repeated"] = share(static_cast<double>(c.windows_repeated), static_cast<double>(c.windows));
    row["repeated_robots"] = share(static_cast<double>(c.robots_repeated), robots * windows);
    row["islands"] = share(static_cast<double>(c.island_ticks), static_cast<double>(c.ticks));
    row["migrations"] = c.migrations;
    row["controller_us"] = share(1e6 * (cluster.controller_cpu_s() - begin_cpu_s), windows);
    row["controller_us_robot"] = share(1e6 * (cluster.controller_cpu_s() - begin_cpu_s), windows * robots);
    std::uint64_t bytes = 0;
    for (const auto& [name, traffic] : cluster.network().received) {
        row["to_controller"][name] = {traffic.messages, traffic.bytes};
        if (name == "Frame") bytes = traffic.bytes;
    }
    row["frame_bytes_robot"] = share(static_cast<double>(bytes), robots * static_cast<double>(c.windows) +
                                                                     static_cast<double>(c.robots_repeated));
    return row;
}

void print(const Json& row) {
    std::printf(
        "%-10s %5d robots %3d Simulators%s: ceiling %.3f, stepping %.3f, everything %.3f; speed-up %5.2f; "
        "step %7.1f us; "
        "window %4.1f ticks, repeated %.3f; islands %.0f; Controller %.0f us a window (%.3f a robot), %.1f "
        "bytes a robot\n",
        row["world"].get<std::string>().c_str(), row["robots"].get<int>(), row["simulators"].get<int>(),
        row["one_island"].get<bool>() ? ", one island" : "", row["ceiling"].get<double>(),
        row["balanced"].get<double>(), row["all"].get<double>(), row["speedup"].get<double>(),
        row["step_us"].get<double>(), row["window_ticks"].get<double>(), row["repeated"].get<double>(),
        row["islands"].get<double>(), row["controller_us"].get<double>(),
        row["controller_us_robot"].get<double>(), row["frame_bytes_robot"].get<double>());
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app(
        "The paper's experiment: one world on 1 to 12 Simulators, each with a computer of its own in virtual "
        "time.");
    Wishes wishes;
    app.add_option("--cars", wishes.cars, "sizes of the city")->capture_default_str();
    app.add_option("--simulators", wishes.simulators, "numbers of Simulators")->capture_default_str();
    app.add_option("--driver", wishes.driver, "control program of the cars");
    app.add_option("--worlds", wishes.worlds, "folder with heap.sdf")->capture_default_str();
    app.add_option("--seconds", wishes.seconds, "simulated seconds of 50 cars")->capture_default_str();
    app.add_option("--crowd", wishes.crowd, "robots of a made-up load on the Controller alone");
    app.add_option("--window-max", wishes.window_max, "ticks")->capture_default_str();
    app.add_option("--lanes", wishes.lanes, "robots stepped at once")->capture_default_str();
    app.add_option("--send-us", wishes.send_us,
                   "CPU time of sending a message (default: measured over Fast DDS)");
    app.add_option("--way-us", wishes.way_us, "time on the way (default: measured)");
    app.add_option("--json", wishes.json, "rows as JSON");
    CLI11_PARSE(app, argc, argv);
    for (const std::size_t robots : wishes.crowd)
        for (const std::size_t n : wishes.simulators) {
            const CrowdCosts c = measure_crowd(robots, n, 20);
            std::printf(
                "crowd of %zu on %zu: Controller %.0f us a window (%.3f a robot), of it %.0f after the last "
                "frame; %.1f bytes a robot\n",
                robots, n, c.window_us, c.window_us / static_cast<double>(robots), c.last_frame_us,
                c.bytes_to_controller / static_cast<double>(robots));
        }
    if (!wishes.crowd.empty()) return 0;
    NetworkCosts network;
    if (wishes.send_us < 0 || wishes.way_us < 0) network = measure_dds(2000);
    if (wishes.send_us >= 0) network.send_us = wishes.send_us;
    if (wishes.way_us >= 0) network.way_us = wishes.way_us;
    std::printf("a message: %.1f us of CPU to send, %.1f us on the way\n", network.send_us, network.way_us);
    Json rows = Json::array();
    for (const std::size_t cars : wishes.cars) {
        const double seconds = std::max(1.0, wishes.seconds * 50 / static_cast<double>(cars));
        const Work work =
            record("city", city_file(cars), wishes.driver, static_cast<Tick>(seconds / 0.002), wishes.lanes);
        std::printf(
            "%s, %zu cars, %.1f s: stepping %.1f us a tick in one process, with the Controller %.1f\n",
            work.name.c_str(), cars, seconds, 1e6 * work.step_cpu_s / static_cast<double>(work.ticks),
            1e6 * work.process_cpu_s / static_cast<double>(work.ticks));
        for (const std::size_t n : wishes.simulators)
            print(rows.emplace_back(measure(work, n, wishes, network, false)));
        if (cars == wishes.cars.front()) print(rows.emplace_back(measure(work, 12, wishes, network, true)));
    }
    if (!wishes.json.empty())
        std::ofstream(wishes.json) << Json{
            {"send_us", network.send_us},
            {"way_us", network.way_us},
            {"rows", rows}}.dump(1);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "roboss-table1: %s\n", error.what());
    return 1;
}
