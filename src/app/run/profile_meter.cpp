// A second after the other.
#include "app/run/profile_meter.h"

namespace roboss {
namespace {

RunProfile to_run_profile(const StepProfile& sum, Tick ticks, double friction_tolerance) {
    RunProfile p;
    p.ticks = ticks;
    for (std::size_t i = 0; i < kStages; ++i)
        p.stages.push_back({stage_name(Stage(i)), 1e-9 * static_cast<double>(sum.stages.ns[i])});
    const SolverProfile& s = sum.solver;
    p.islands = s.islands, p.largest_island = s.largest_island, p.most_contacts = s.most_contacts;
    p.largest_part = s.largest_part;
    p.iterations = s.iterations, p.iterations_most = s.iterations_most, p.residual = s.residual;
    p.friction_solves = s.friction_solves, p.friction_misses = s.friction_misses;
    p.friction_error = s.friction_error, p.friction_tolerance = friction_tolerance;
    return p;
}

}  // namespace

const RunProfile& ProfileMeter::asked(std::int64_t now_ms, Tick tick, double friction_tolerance) {
    const bool fresh = !wanted(now_ms);
    asked_ms_ = now_ms;
    if (fresh) shown_ = {};
    if (fresh || tick < from_) {  // the first request after a pause, or the run was rewound
        begin(now_ms, tick);
    } else if (now_ms - since_ms_ >= kEvery_ms && tick > from_) {  // a paused run shows what was last
        shown_ = to_run_profile(sum_, tick - from_, friction_tolerance);
        begin(now_ms, tick);
    }
    return shown_;
}

}  // namespace roboss
