// Stepping a journal again.
#include "simulation/replay.h"

#include <algorithm>

namespace roboss {

Result<std::unique_ptr<Simulation>> replay_from(const Journal& journal, const Branch& branch,
                                                const CheckpointEntry& entry,
                                                const std::shared_ptr<const Model>& model, Tick until,
                                                const ReplayOptions& options) {
    Result<SavedRun> run = journal.run_from(branch, entry, *model, until);
    if (!run) return run.error();
    SimulationOptions simulation;
    simulation.threads = options.threads;
    simulation.world_file = branch.world_file;
    simulation.controller.seed = branch.seed;
    simulation.controller.window = options.window;
    return Simulation::create(model, simulation, {}, &run.value());
}

Result<std::unique_ptr<Simulation>> replay_at(const Journal& journal, const Branch& branch,
                                              const std::shared_ptr<const Model>& model, Tick tick,
                                              Tick until, const ReplayOptions& options) {
    const std::vector<CheckpointEntry> entries = journal.checkpoints(branch);
    const auto above = std::upper_bound(entries.begin(), entries.end(), tick,
                                        [](Tick t, const CheckpointEntry& p) { return t < p.tick; });
    if (above == entries.begin())
        return Error{journal.path() + " has no checkpoint before tick " + std::to_string(tick) +
                         " of branch " + std::to_string(branch.id),
                     "give a later time"};
    auto simulation = replay_from(journal, branch, *std::prev(above), model, until, options);
    if (!simulation) return simulation;
    if (Result<> done = simulation.value()->run_until(tick); !done) return done.error();
    return simulation;
}

Result<std::vector<Stretch>> verify(const Journal& journal, const Branch& branch,
                                    const ReplayOptions& options,
                                    const std::function<void(const Stretch&)>& tell) {
    Result<std::shared_ptr<const Model>> model = journal.model(branch);
    if (!model) return model.error();
    const std::vector<CheckpointEntry> entries = journal.checkpoints(branch);
    std::vector<Stretch> stretches;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const bool last = i + 1 == entries.size();
        Stretch s{branch.id, entries[i].tick, last ? branch.committed : entries[i + 1].tick,
                  last ? branch.hash : entries[i + 1].hash, 0};
        if (s.until <= s.from) break;
        auto simulation = replay_from(journal, branch, entries[i], model.value(), s.until, options);
        if (!simulation) return simulation.error();
        if (Result<> done = simulation.value()->run_until(s.until); !done) return done.error();
        s.found = simulation.value()->hash();
        stretches.push_back(s);
        if (tell) tell(s);
    }
    return stretches;
}

}  // namespace roboss
