// The cars in a Simulation, the same roles as `roboss run`: islands of a window are shared out to the
// threads. Wall time, Controller included. A machine's two cores may be halves of one, or be slowed by
// others: what they give two runs that share nothing is measured beside it, by turns.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <stdexcept>
#include <thread>

#include "median.h"
#include "peers/contest.h"
#include "scenes/car_drive.h"
#include "simulation/simulation.h"
#include "take.h"

namespace roboss::bench {
namespace {

double wall_s() {
    timespec t{};
    clock_gettime(CLOCK_MONOTONIC, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// More turns than a contest has: whether cores disturb each other comes and goes.
constexpr int kRoundsPerBlock = 4;

using Run = std::unique_ptr<Simulation>;

Run start(const std::shared_ptr<const Model>& model, unsigned threads) {
    SimulationOptions options;
    options.threads = threads;
    Run run = take(Simulation::create(model, options));
    std::uint64_t sequence = 0;
    for (std::size_t r = 0; r < model->robots.size(); ++r)
        for (std::size_t wheel = 0; wheel < 4; ++wheel) {
            const SetJoint drive{JointId(wheel), 0, MotorMode::kVelocity, kWheelSpeed, kWheelEffort};
            take(run->submit({0, ClientId(std::size_t{0}), sequence++, RobotId(r), drive}));
        }
    return run;
}

void go_on(Run& run, Tick ticks) {
    take(run->run_until(run->tick() + ticks));
}

double wall_s_of(const std::function<void()>& work) {
    const double before = wall_s();
    work();
    return wall_s() - before;
}

/// Who is compared: what it does in a round, and how often it steps every car of a world meanwhile.
struct Contender {
    std::string name, settings;
    double worlds;
    std::function<void(Tick)> go_on;
    std::vector<double> us;  // by round, for a step of a car
};

Row row_of(const Contender& who, const Contender& first, std::size_t cars) {
    Row row;
    row.scene = "threads", row.robots = cars;
    row.engine = who.name, row.settings = who.settings;
    row.set_times(who.us);
    std::vector<double> ratios;
    for (std::size_t i = 0; i < who.us.size(); ++i) ratios.push_back(who.us[i] / first.us[i]);
    row.ratio = median(ratios);
    return row;
}

}  // namespace

std::vector<Row> compare_threads(std::size_t cars, const ContestOptions& options) {
    const Scene scene = cars_scene(cars);
    CompileOptions compiling;
    compiling.dt_s = kSceneDt;
    Diagnostics diagnostics;
    const auto model = compile(scene.world, compiling, diagnostics);
    std::vector<Run> runs;  // of one thread, of two, and two more of one
    for (unsigned threads : {1u, 2u, 1u, 1u}) {
        std::fprintf(stderr, "  roboss run, %u thread%s: settling\n", threads, threads > 1 ? "s" : "");
        runs.push_back(start(model, threads));
        go_on(runs.back(), options.settle);
    }
    const char* const settings = "Controller, windows, islands; wall time";
    Contender contenders[] = {
        {"RoBOSS run, 1 thread", settings, 1, [&](Tick ticks) { go_on(runs[0], ticks); }, {}},
        {"RoBOSS run, 2 threads", settings, 1, [&](Tick ticks) { go_on(runs[1], ticks); }, {}},
        {"two runs of 1 thread",
         settings,
         2,
         [&](Tick ticks) {
             std::thread other([&] { go_on(runs[3], ticks); });
             go_on(runs[2], ticks);
             other.join();
         },
         {}}};
    const int ticks = options.block_of(options.steps_of(cars));
    const int rounds = kRoundsPerBlock * options.blocks;
    for (int round = 0; round < rounds; ++round) {
        if (round % kRoundsPerBlock == 0)
            std::fprintf(stderr, "  block %d of %d\n", round / kRoundsPerBlock + 1, options.blocks);
        for (Contender& who : contenders)
            who.us.push_back(1e6 * wall_s_of([&] { who.go_on(ticks); }) / ticks / who.worlds /
                             static_cast<double>(cars));
    }
    const bool same =
        std::all_of(runs.begin(), runs.end(), [&](const Run& run) { return run->hash() == runs[0]->hash(); });
    std::vector<Row> rows;
    for (const Contender& who : contenders) {
        rows.push_back(row_of(who, contenders[0], cars));
        rows.back().steps = ticks * rounds;
        rows.back().right = same;
        rows.back().verdict = same ? "the same state hash" : "another state hash";
    }
    rows[2].verdict += "; what two cores give runs that share nothing";
    return rows;
}

}  // namespace roboss::bench
