// Property: a cluster with a bad network, whose Simulators are killed, hang, are cut off, leave and join at
// random moments, ends with the state hash of the undisturbed run.
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include "faulty_cluster.h"
#include "fuzz/property.h"
#include "fuzz/random_program.h"
#include "physics/invariants.h"
#include "simulation/simulation.h"

namespace roboss::fuzz {
namespace {

constexpr int kTurnsMost = 400'000;
constexpr test::Trouble kTrouble{150, 60, 50, 250, 2000, 0, 60};

struct Outcome {
    Tick tick = 0;
    std::uint64_t hash = 0;
    bool ended_early = false;  // a state was not finite
};

/// One Simulator, in windows of one tick; with the states at the end.
Outcome undisturbed(const Start& start, const Setting& setting, Tick ticks, std::string& broken) {
    SimulationOptions options;
    options.controller.window = 1;
    SavedRun from;
    from.seed = setting.seed, from.states = start.states;
    std::vector<NamedProgram> programs;
    programs.push_back({"random", std::make_unique<RandomProgram>(setting.seed)});
    auto made = Simulation::create(start.model, options, std::move(programs), &from);
    ROBOSS_CHECK(made.ok(), made.ok() ? "" : made.error().text());
    Simulation& simulation = *made.value();
    const bool whole = simulation.run_until(ticks).ok();
    broken = check_invariants(*start.model, simulation.states());
    return {simulation.tick(), simulation.hash(), !whole};
}

FaultOptions faults_of(std::uint64_t seed) {
    FaultOptions faults;
    faults.seed = seed;
    faults.drop = 0.02 * static_cast<double>(seed % 6);
    faults.duplicate = 0.02 * static_cast<double>(seed % 5);
    faults.delay_ms_max = static_cast<std::int64_t>(seed % 10);
    return faults;
}

ControllerOptions options_of(std::uint64_t seed) {
    ControllerOptions options;
    options.seed = seed;
    options.checkpoint_ticks = 10 + static_cast<Tick>(seed % 5) * 12;
    options.window = seed % 3 == 0 ? 0 : static_cast<Tick>(seed % 7 + 1);
    return options;
}

std::string line(const Controller& controller) {
    const Counters& c = controller.counters();
    char buffer[160];
    std::snprintf(
        buffer, sizeof buffer,
        "tick %6lld hash %016llx  Simulators %zu losses %llu recoveries %llu migrations %llu cuts %llu",
        static_cast<long long>(controller.tick()), static_cast<unsigned long long>(controller.hash()),
        c.simulators, static_cast<unsigned long long>(c.losses),
        static_cast<unsigned long long>(c.recoveries), static_cast<unsigned long long>(c.migrations),
        static_cast<unsigned long long>(c.cuts));
    return buffer;
}

}  // namespace

Finding run_cluster(const Request& request) {
    const Setting& setting = request.setting;
    const Start start = make_start(setting);
    const auto ticks = static_cast<Tick>(request.seconds / setting.dt_s + 0.5);
    Finding finding;
    std::string broken;
    const Outcome expected = undisturbed(start, setting, ticks, broken);
    if (!broken.empty() && !expected.ended_early) {
        finding.failed = true, finding.tick = expected.tick, finding.text = broken;
        return finding;
    }
    test::FaultyCluster cluster(start.model, options_of(setting.seed), faults_of(setting.seed), kTrouble,
                                1 + setting.seed % 4);
    cluster.add_program("random", std::make_unique<RandomProgram>(setting.seed));
    StartingPoint from = beginning_of(*start.model);
    from.states = start.states;
    cluster.restart_controller(std::move(from));
    const Controller& controller = cluster.controller();
    cluster.controller().run_until(ticks);
    Tick printed = -1;
    int turns = 0;
    for (; turns < kTurnsMost && !controller.resting() && !controller.stopped(); ++turns) {
        cluster.turn();
        if (request.print_line && controller.tick() != printed)
            printed = controller.tick(), request.print_line(line(controller));
    }
    finding.figure = static_cast<double>(controller.counters().losses);
    finding.tick = controller.tick();
    if (turns == kTurnsMost)
        finding.text = "the run is stuck";
    else if (controller.stopped() != expected.ended_early || controller.tick() != expected.tick)
        finding.text = "the run ended at another tick than the undisturbed one";
    else if (controller.hash() != expected.hash)
        finding.text = "the state hash differs from that of the undisturbed run; losses:";
    finding.failed = !finding.text.empty();
    return finding;
}

}  // namespace roboss::fuzz
