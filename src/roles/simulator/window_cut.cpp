// Work stealing in a Simulator: an assignment of few robots is stepped in lockstep, so that a Cut can end it
// at any tick and the rest can be stepped here or elsewhere.
#include <algorithm>
#include <numeric>
#include <utility>

#include "roles/simulator/window_job.h"

namespace roboss {

namespace {

constexpr std::size_t kAlert = 4;  // a late Simulator polls for messages so many times as often

}  // namespace

/// Few robots on one thread, of which others could take some: one batch, in lockstep.
bool WindowStepper::in_lockstep(const Assignment& assignment) const {
    return assignment.due_ns > 0 && threads() == 1 && assignment.island_offsets.size() > 2 &&
           assignment.robots.size() <= kLockstepMost;
}

/// For an assignment that is stepped in lockstep, as one batch.
double WindowStepper::spent_ns(std::uint64_t start_ns) const {
    if (options_.clock) return static_cast<double>(options_.clock() - start_ns);
    return kCounted_ns * std::accumulate(efforts_.begin(), efforts_.end(), 0.0);
}

/// All islands tick by tick, so that the rest can be left to others at any tick, unless an island failed.
/// `singles`: so many islands at the end have one robot.
void WindowStepper::step_lockstep(Job& job, std::span<const std::uint32_t> islands, std::size_t singles,
                                  std::uint64_t start_ns) {
    const std::function<double()> clock = [this, start_ns] { return spent_ns(start_ns); };
    const Tick from = job.assignment.from, until = job.assignment.until;
    Lockstep a{islands.first(islands.size() - singles), singles > 0, true};
    next_order_.assign(order_offsets_.begin(), order_offsets_.end() - 1);
    if (a.lane_group_goes) load_lane_group(job, islands.last(singles), 0);
    std::size_t look_up = options_.look_up;
    for (Tick tick = from; tick < until; ++tick) {
        if (is_abandoned()) return;
        step_all(job, a, tick);
        if (!is_due(job.assignment.robots.size(), tick + 1 - from, look_up)) continue;
        const double done = static_cast<double>(tick + 1 - from) / static_cast<double>(until - from);
        const Next go = job.between(a.intact ? StepProgress{done, &clock} : StepProgress{});
        if (go == Next::kStop && a.intact && tick + 1 < until) return cut_short(job, tick + 1);
        look_up = options_.look_up / (go == Next::kContinueAlert ? kAlert : 1);
    }
    for (const std::uint32_t i : a.larger)
        if (!job.result.islands[i].failed.valid()) report_robots(job, i);
    if (!a.lane_group_goes) return;
    for (const std::uint32_t i : lane_groups_[0].islands) report_robots(job, i);
}

void WindowStepper::step_all(Job& job, Lockstep& a, Tick tick) {
    for (const std::uint32_t i : a.larger) {
        if (job.result.islands[i].failed.valid()) continue;
        if (!step_tick(job, i, tick, take_orders(i, tick, next_order_[i]), 0)) a.intact = false;
    }
    if (!a.lane_group_goes || step_lane_group(job, tick, 0)) return;
    a.lane_group_goes = a.intact = false;
    step_apart(job, lane_groups_[0].islands, 0);
}

void WindowStepper::cut_short(Job& job, Tick tick) {
    job.result.left = static_cast<std::uint64_t>(job.assignment.until - tick);
    job.result.robots.clear();
    cut_rest_ = {job.assignment.epoch,
                 job.assignment.window,
                 tick,
                 job.assignment.robots,
                 swept_,
                 std::exchange(job.result.earlier, {})};
    for (auto& boxes : earlier_) {
        cut_rest_.earlier.insert(cut_rest_.earlier.end(), boxes.begin(), boxes.end());
        boxes.clear();
    }
    for (const RobotId robot : job.assignment.robots) job.store.cut_window(robot, tick);
}

/// Reports what robots swept before a Cut: as part of their bounds if they are still stepped here, else as
/// EarlierBox.
void WindowStepper::resume_after_cut(Job& job) {
    const Assignment& assignment = job.assignment;
    const CutRest rest = std::exchange(cut_rest_, {});
    if (rest.tick != assignment.from || rest.window != assignment.window || rest.epoch != assignment.epoch)
        return;
    job.result.earlier = rest.earlier;
    for (std::size_t i = 0; i < rest.robots.size(); ++i) {
        const auto here = std::find(assignment.robots.begin(), assignment.robots.end(), rest.robots[i]);
        if (here != assignment.robots.end())
            swept_before_[static_cast<std::size_t>(here - assignment.robots.begin())] = rest.swept[i];
        else if (!rest.swept[i].empty())
            job.result.earlier.push_back({rest.robots[i], outward(rest.swept[i])});
    }
}

}  // namespace roboss
