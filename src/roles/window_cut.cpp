// A plan of few robots is stepped tick by tick in all its islands, so that it can be cut short at any tick
// and what is left be stepped on here or elsewhere.
#include <algorithm>
#include <numeric>
#include <utility>

#include "roles/window_job.h"

namespace roboss {

namespace {

constexpr std::size_t kAlert = 4;  // times as often does it look for messages who may be cut short

}  // namespace

/// Few robots on one thread, which others may help out with: in one batch, all tick by tick.
bool WindowStepper::abreast(const Plan& plan) const {
    return plan.due_ns > 0 && threads() == 1 && plan.island_offsets.size() > 2 &&
           plan.robots.size() <= kAbreastMost;
}

/// In the one batch of a plan that is stepped abreast.
double WindowStepper::spent_ns(std::uint64_t start_ns) const {
    if (options_.clock) return static_cast<double>(options_.clock() - start_ns);
    return kCounted_ns * std::accumulate(efforts_.begin(), efforts_.end(), 0.0);
}

/// All islands tick by tick, so that at any of them the rest may be left to others; not any more where
/// something failed. `singles`: the last so many have one robot.
void WindowStepper::step_abreast(Job& job, std::span<const std::uint32_t> islands, std::size_t singles,
                                 std::uint64_t start_ns) {
    const std::function<double()> clock = [this, start_ns] { return spent_ns(start_ns); };
    const Tick from = job.plan.from, until = job.plan.until;
    Abreast a{islands.first(islands.size() - singles), singles > 0, true};
    next_order_.assign(order_offsets_.begin(), order_offsets_.end() - 1);
    if (a.convoy_goes) load_convoy(job, islands.last(singles), 0);
    std::size_t look_up = options_.look_up;
    for (Tick tick = from; tick < until; ++tick) {
        step_all(job, a, tick);
        if (!is_due(job.plan.robots.size(), tick + 1 - from, look_up)) continue;
        const double done = static_cast<double>(tick + 1 - from) / static_cast<double>(until - from);
        const Next go = job.between(a.intact ? StepProgress{done, &clock} : StepProgress{});
        if (go == Next::kStop && a.intact && tick + 1 < until) return cut_short(job, tick + 1);
        look_up = options_.look_up / (go == Next::kGoOnAlert ? kAlert : 1);
    }
    for (const std::uint32_t i : a.larger)
        if (!job.frame.islands[i].failed.valid()) report_robots(job, i);
    if (!a.convoy_goes) return;
    for (const std::uint32_t i : convoys_[0].islands) report_robots(job, i);
}

void WindowStepper::step_all(Job& job, Abreast& a, Tick tick) {
    for (const std::uint32_t i : a.larger) {
        if (job.frame.islands[i].failed.valid()) continue;
        if (!step_tick(job, i, tick, take_orders(i, tick, next_order_[i]), 0)) a.intact = false;
    }
    if (!a.convoy_goes || step_convoy(job, tick, 0)) return;
    a.convoy_goes = a.intact = false;
    step_apart(job, convoys_[0].islands, 0);
}

void WindowStepper::cut_short(Job& job, Tick tick) {
    job.frame.left = static_cast<std::uint64_t>(job.plan.until - tick);
    job.frame.robots.clear();
    stub_ = {job.plan.epoch,  job.plan.window, tick,
             job.plan.robots, swept_,          std::exchange(job.frame.earlier, {})};
    for (auto& boxes : earlier_) {
        stub_.earlier.insert(stub_.earlier.end(), boxes.begin(), boxes.end());
        boxes.clear();
    }
    for (const RobotId robot : job.plan.robots) job.store.cut_window(robot, tick);
}

/// Whoever steps robots on after a Cut, what they swept before it is told here: in their bounds where they
/// stayed, else beside them.
void WindowStepper::take_up(Job& job) {
    const Plan& plan = job.plan;
    const Stub stub = std::exchange(stub_, {});
    if (stub.tick != plan.from || stub.window != plan.window || stub.epoch != plan.epoch) return;
    job.frame.earlier = stub.earlier;
    for (std::size_t i = 0; i < stub.robots.size(); ++i) {
        const auto here = std::find(plan.robots.begin(), plan.robots.end(), stub.robots[i]);
        if (here != plan.robots.end())
            swept_before_[static_cast<std::size_t>(here - plan.robots.begin())] = stub.swept[i];
        else if (!stub.swept[i].empty())
            job.frame.earlier.push_back({stub.robots[i], outward(stub.swept[i])});
    }
}

}  // namespace roboss
