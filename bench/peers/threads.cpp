// The cars in a Simulation, the same roles as `roboss run`: islands of a window are shared out to the
// threads. Wall time, Controller included.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <stdexcept>

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

struct Run {
    std::unique_ptr<Simulation> simulation;
    std::vector<double> us;
};

Run start(const std::shared_ptr<const Model>& model, unsigned threads) {
    SimulationOptions options;
    options.threads = threads;
    Run run{take(Simulation::create(model, options)), {}};
    std::uint64_t sequence = 0;
    for (std::size_t r = 0; r < model->robots.size(); ++r)
        for (std::size_t wheel = 0; wheel < 4; ++wheel) {
            const SetJoint drive{JointId(wheel), 0, MotorMode::kVelocity, kWheelSpeed, kWheelEffort};
            take(run.simulation->submit({0, ClientId(std::size_t{0}), sequence++, RobotId(r), drive}));
        }
    return run;
}

}  // namespace

std::vector<Row> compare_threads(std::size_t cars, const ContestOptions& options) {
    const Scene scene = cars_scene(cars);
    CompileOptions compiling;
    compiling.dt_s = kSceneDt;
    Diagnostics diagnostics;
    const auto model = compile(scene.world, compiling, diagnostics);
    std::vector<Run> runs;
    for (unsigned threads : {1u, 2u}) {
        std::fprintf(stderr, "  roboss run, %u thread%s: settling\n", threads, threads > 1 ? "s" : "");
        runs.push_back(start(model, threads));
        take(runs.back().simulation->run_until(options.settle));
    }
    const int ticks = options.block_of(options.steps_of(cars));
    for (int block = 0; block < options.blocks; ++block) {
        std::fprintf(stderr, "  block %d of %d\n", block + 1, options.blocks);
        for (Run& run : runs) {
            const double before = wall_s();
            take(run.simulation->run_until(run.simulation->tick() + ticks));
            run.us.push_back(1e6 * (wall_s() - before) / ticks / static_cast<double>(cars));
        }
    }
    std::vector<Row> rows;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        std::sort(runs[i].us.begin(), runs[i].us.end());
        Row row;
        row.scene = "threads", row.robots = cars;
        row.engine = i == 0 ? "RoBOSS run, 1 thread" : "RoBOSS run, 2 threads";
        row.settings = "Controller, windows, islands; wall time";
        row.steps = ticks * options.blocks;
        row.us_least = runs[i].us.front(), row.us_most = runs[i].us.back();
        row.us_median = runs[i].us[runs[i].us.size() / 2];
        row.right = runs[i].simulation->hash() == runs[0].simulation->hash();
        row.verdict = row.right ? "the same state hash" : "another state hash";
        rows.push_back(row);
    }
    for (Row& row : rows) row.ratio = row.us_median / rows[0].us_median;
    return rows;
}

}  // namespace roboss::bench
