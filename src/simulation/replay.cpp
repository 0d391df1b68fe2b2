// Stepping a journal again.
#include "simulation/replay.h"

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
    const CheckpointEntry* before = journal.checkpoint_before(branch, tick);
    if (before == nullptr)
        return Error{journal.path() + " has no checkpoint before tick " + std::to_string(tick) +
                         " of branch " + std::to_string(branch.id),
                     "give a later time", "no-such-time"};
    auto simulation = replay_from(journal, branch, *before, model, until, options);
    if (!simulation) return simulation;
    if (Result<> done = simulation.value()->run_until(tick); !done) return done.error();
    return simulation;
}

std::vector<Stretch> stretches_of(const Journal& journal, const Branch& branch) {
    std::vector<Stretch> stretches;
    const std::vector<CheckpointEntry> entries = journal.checkpoints(branch);
    const std::vector<Lineage::Part> parts = journal.lineage(branch).parts();
    if (parts.size() > 1 && parts.back().from == branch.tick) {
        const Branch left = *journal.find(parts[parts.size() - 2].branch);
        if (const CheckpointEntry* before = journal.checkpoint_before(left, branch.tick);
            before != nullptr && left.model_hash == branch.model_hash)
            stretches.push_back({left.id, before->tick, branch.tick, entries.front().hash, 0, branch.id});
    }
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const bool last = i + 1 == entries.size();
        const Stretch s{branch.id,
                        entries[i].tick,
                        last ? branch.committed : entries[i + 1].tick,
                        last ? branch.hash : entries[i + 1].hash,
                        0,
                        0};
        if (s.until > s.from) stretches.push_back(s);
    }
    return stretches;
}

Result<std::vector<Stretch>> verify(const Journal& journal, const Branch& branch,
                                    const ReplayOptions& options,
                                    const std::function<void(const Stretch&)>& tell,
                                    const VerifyWatch& watch) {
    Result<std::shared_ptr<const Model>> model = journal.model(branch);
    if (!model) return model.error();
    std::vector<Stretch> stretches = stretches_of(journal, branch);
    for (Stretch& s : stretches) {
        const Branch in = *journal.find(s.branch);
        auto simulation =
            replay_from(journal, in, *journal.checkpoint_before(in, s.from), model.value(), s.until, options);
        if (!simulation) return simulation.error();
        const auto goes_on = [&] { return !watch || watch(s, simulation.value()->tick()); };
        if (Result<> done = simulation.value()->run_until(s.until, goes_on); !done) return done.error();
        if (simulation.value()->tick() < s.until)
            return Error{"the verification was interrupted", "start it again", "interrupted"};
        s.found = simulation.value()->hash();
        if (tell) tell(s);
    }
    return stretches;
}

}  // namespace roboss
