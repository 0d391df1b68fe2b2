// Property: the same state hash however the world is spread over threads, lanes, Simulators, windows and
// islands, with a control program that disturbs it. A run that must end does so at the same tick, with the
// same committed state.
#include <array>
#include <cstdio>
#include <string>
#include <utility>

#include "core/check.h"
#include "fuzz/property.h"
#include "fuzz/random_program.h"
#include "simulation/simulation.h"

namespace roboss::fuzz {
namespace {

struct Configuration {
    const char* name;
    std::size_t simulators;
    unsigned threads;
    std::size_t lanes;
    Tick window;  // 0: adaptive
    bool merge_all, blind;
};

constexpr std::array<Configuration, 5> kConfigurations{{
    {"one island, windows of 1 tick", 1, 1, kMostLanes, 1, true, false},
    {"one lane, windows of 16", 1, 1, 1, 16, false, false},
    {"three threads, adaptive windows", 1, 3, kMostLanes, 0, false, false},
    {"three Simulators, two threads, windows of 7", 3, 2, kMostLanes, 7, false, false},
    {"five Simulators, four lanes, no forecast", 5, 1, 4, 0, false, true},
}};

struct Outcome {
    bool ended_early = false;
    Tick tick = 0;
    std::uint64_t hash = 0;
    friend bool operator==(const Outcome&, const Outcome&) = default;
};

Outcome run(const Start& start, const Setting& setting, const Configuration& c, Tick ticks) {
    SimulationOptions options;
    options.simulators = c.simulators, options.threads = c.threads, options.lanes = c.lanes;
    options.controller.window = c.window;
    options.controller.forecast.merge_all = c.merge_all, options.controller.forecast.blind = c.blind;
    SavedRun from;
    from.seed = setting.seed, from.states = start.states;
    std::vector<NamedProgram> programs;
    programs.push_back({"random", std::make_unique<RandomProgram>(setting.seed)});
    auto made = Simulation::create(start.model, options, std::move(programs), &from);
    ROBOSS_CHECK(made.ok(), made.ok() ? "" : made.error().text());
    Simulation& simulation = *made.value();
    const bool whole = simulation.run_until(ticks).ok();
    return {!whole, simulation.tick(), simulation.hash()};
}

/// First tick at which the two differ; they do at `ticks`.
Tick first_difference(const Start& start, const Setting& setting, const Configuration& c, Tick ticks) {
    Tick same = 0, differ = ticks;
    while (differ - same > 1) {
        const Tick middle = same + (differ - same) / 2;
        const bool equal = run(start, setting, kConfigurations[0], middle) == run(start, setting, c, middle);
        (equal ? same : differ) = middle;
    }
    return differ;
}

std::string line(const Configuration& c, const Outcome& out) {
    char buffer[160];
    std::snprintf(buffer, sizeof buffer, "%-45s %s tick %lld hash %016llx", c.name,
                  out.ended_early ? "ENDED at" : "at", static_cast<long long>(out.tick),
                  static_cast<unsigned long long>(out.hash));
    return buffer;
}

}  // namespace

Finding run_hash(const Request& request) {
    const Setting& setting = request.setting;
    const Start start = make_start(setting, setting.seed % 3 == 2);
    const auto ticks = static_cast<Tick>(request.seconds / setting.dt_s + 0.5);
    Outcome expected;
    Finding finding;
    for (const Configuration& c : kConfigurations) {
        const Outcome out = run(start, setting, c, ticks);
        if (&c == &kConfigurations[0]) expected = out;
        if (request.print_line) request.print_line(line(c, out));
        if (out == expected) continue;
        if (!finding.failed) {
            finding.tick = request.print_line ? first_difference(start, setting, c, ticks) : out.tick;
            finding.text = std::string(out.ended_early ? "different last tick" : "different hash") +
                           " with " + c.name + "; configurations that differ:";
        }
        finding.failed = true, finding.figure += 1;
    }
    return finding;
}

}  // namespace roboss::fuzz
