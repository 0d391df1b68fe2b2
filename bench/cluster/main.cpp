// roboss-table1: the paper's experiment. One world on 1 to 12 Simulators, each with a computer of its own in
// virtual time; one Simulator is detached every so often; the worst case, one island of all robots; and how
// far a Controller reaches.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <fstream>

#include "cluster/crowd.h"
#include "cluster/measure.h"
#include "cluster/network_costs.h"

namespace {

using namespace roboss;
using namespace roboss::bench;

constexpr Tick kSettle = 1500;  // until windows have grown
constexpr double kDt_s = 0.002;
constexpr std::size_t kFew = 500, kVeryMany = 10'000;  // cars

struct BenchOptions {
    std::vector<std::size_t> cars{50, 500, 2000, 10'000}, simulators{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    std::vector<std::size_t> crowd{1000, 10'000, 100'000};
    std::string driver, pile, json;
    double seconds = 20, detach_s = 20;
    ClusterSettings settings;
    double send_us = -1, way_us = -1;
};

void add_options(CLI::App& app, BenchOptions& w) {
    app.add_option("--driver", w.driver, "shared library of the cars' control program")->required();
    app.add_option("--pile", w.pile, "world in which all robots lie in one pile");
    app.add_option("--cars", w.cars, "sizes of the city")->capture_default_str();
    app.add_option("--simulators", w.simulators, "numbers of Simulators")->capture_default_str();
    app.add_option("--crowd", w.crowd, "robots of the made-up load on the Controller")->capture_default_str();
    app.add_option("--seconds", w.seconds,
                   "simulated seconds measured with 50 cars; more cars get their share")
        ->capture_default_str();
    app.add_option("--detach", w.detach_s, "simulated seconds until a Simulator leaves; 0: none does")
        ->capture_default_str();
    app.add_option("--window-max", w.settings.window_max, "ticks (0: by the number of robots)")
        ->capture_default_str();
    app.add_flag("!--no-work-stealing", w.settings.work_stealing,
                 "idle Simulators do not take over work of stragglers");
    app.add_option("--lanes", w.settings.lanes, "robots stepped at once")->capture_default_str();
    app.add_option("--send-us", w.send_us,
                   "CPU time of sending a message (default: measured over TLS on loopback)");
    app.add_option("--way-us", w.way_us, "its time on the way (default: measured)");
    app.add_option("--json", w.json, "rows as JSON");
}

Json tell(Json row) {
    std::printf("%s\n", line_of(row).c_str());
    std::fflush(stdout);
    return row;
}

/// So many cars take minutes on each number of Simulators: the least, a middle one and the most must do.
std::vector<std::size_t> simulators_for(std::size_t cars, const BenchOptions& w) {
    if (cars < kVeryMany || w.simulators.size() < 3) return w.simulators;
    return {w.simulators.front(), w.simulators[w.simulators.size() / 2 - 1], w.simulators.back()};
}

void measure_cities(const BenchOptions& w, Json& rows) {
    for (const std::size_t cars : w.cars) {
        const double seconds = std::max(1.0, w.seconds * 50 / static_cast<double>(cars));
        const Work work = record("city", city_file(cars), w.driver, kSettle,
                                 kSettle + static_cast<Tick>(seconds / kDt_s), w.settings.lanes);
        for (const std::size_t n : simulators_for(cars, w)) {
            ClusterSettings settings = w.settings;
            settings.count_work = cars <= kFew || (cars < kVeryMany && n == w.simulators.back());
            rows.push_back(tell(measure(work, n, settings)));
        }
        if (cars != w.cars.front()) continue;
        for (const std::size_t n : {w.simulators.front(), w.simulators.back()})
            rows.push_back(tell(measure(work, n, w.settings, true)));
    }
}

void measure_pile(const BenchOptions& w, Json& rows) {
    if (w.pile.empty()) return;
    const Work work = record("pile", w.pile, "", kSettle, 2 * kSettle, w.settings.lanes);
    for (const std::size_t n : {w.simulators.front(), w.simulators.back()})
        rows.push_back(tell(measure(work, n, w.settings)));
}

Json measure_crowds(const BenchOptions& w) {
    Json rows = Json::array();
    for (const std::size_t robots : w.crowd)
        for (const std::size_t n : {std::size_t{12}, std::size_t{100}}) {
            const CrowdCosts c = measure_crowd(robots, n, 20);
            rows.push_back({{"robots", robots},
                            {"simulators", n},
                            {"window_us", c.window_us},
                            {"last_result_us", c.last_result_us},
                            {"bytes", c.bytes_to_controller / static_cast<double>(robots)}});
            std::printf(
                "made-up load, %zu robots, %zu Simulators: Controller %.0f us a window, %.3f a robot; %.1f "
                "bytes a robot to it\n",
                robots, n, c.window_us, c.window_us / static_cast<double>(robots),
                c.bytes_to_controller / static_cast<double>(robots));
            std::fflush(stdout);
        }
    return rows;
}

Json measure_detaching(const BenchOptions& w) {
    if (w.detach_s <= 0) return Json::array();
    const std::size_t n = w.simulators.back();
    const auto every = static_cast<Tick>(w.detach_s / kDt_s);
    const Work work =
        record("city", city_file(50), w.driver, 1, every * static_cast<Tick>(n), w.settings.lanes);
    return detach(work, n, every, w.settings);
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app(
        "The paper's experiment: one world on 1 to 12 Simulators, each with a computer of its own in virtual "
        "time.");
    BenchOptions w;
    add_options(app, w);
    CLI11_PARSE(app, argc, argv);
    if (w.send_us < 0 || w.way_us < 0) w.settings.network = measure_network(2000);
    if (w.send_us >= 0) w.settings.network.send_us = w.send_us;
    if (w.way_us >= 0) w.settings.network.way_us = w.way_us;
    std::printf("a message costs %.1f us of CPU time to send and is %.1f us on the way\n",
                w.settings.network.send_us, w.settings.network.way_us);
    Json rows = Json::array();
    measure_cities(w, rows);
    measure_pile(w, rows);
    const Json crowd = measure_crowds(w), detaching = measure_detaching(w);
    if (!w.json.empty())
        std::ofstream(w.json) << Json{
            {"send_us", w.settings.network.send_us},
            {"way_us", w.settings.network.way_us},
            {"lanes", w.settings.lanes},
            {"rows", rows},
            {"crowd", crowd},
            {"detach_s", w.detach_s},
            {"detach", detaching}}.dump(1);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "roboss-table1: %s\n", error.what());
    return 1;
}
