// The stepping of a window: batches of islands, tick by tick, with their actual bounds.
#include "roles/simulator/window_stepper.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "roles/simulator/window_job.h"

namespace roboss {

namespace {

constexpr std::size_t kRobotsPerBatch = 8;  // reading the clock costs about a tenth of a robot's step

bool teleports(const Order& order) {
    return std::holds_alternative<SetPose>(order.action);
}

}  // namespace

WindowStepper::WindowStepper(std::shared_ptr<const Model> model, ThreadPool& pool, SteppingOptions options)
    : model_(std::move(model)),
      pool_(pool),
      options_(std::move(options)),
      scratch_(pool.threads()),
      profiles_(pool.threads()),
      lane_groups_(pool.threads()) {
    for (StepScratch& scratch : scratch_) scratch.use_lanes(options_.lanes);
}

WindowStepper::~WindowStepper() = default;

void WindowStepper::sort_orders(const Assignment& assignment) {
    const std::size_t islands = assignment.island_offsets.size() - 1;
    island_of_.assign(model_->robots.size(), RobotId::kNone);
    for (std::uint32_t i = 0; i < islands; ++i)
        for (std::size_t k = assignment.island_offsets[i]; k < assignment.island_offsets[i + 1]; ++k)
            island_of_[assignment.robots[k].index()] = i;
    order_offsets_.assign(islands + 1, 0);
    const auto concerns = [&](const Order& order) {
        return island_of_[order.robot.index()] != RobotId::kNone;
    };
    for (const Order& order : assignment.orders)
        if (concerns(order)) ++order_offsets_[island_of_[order.robot.index()] + 1];
    std::partial_sum(order_offsets_.begin(), order_offsets_.end(), order_offsets_.begin());
    std::vector<std::size_t> next(order_offsets_.begin(), order_offsets_.end() - 1);
    orders_.resize(order_offsets_.back());
    for (const Order& order : assignment.orders)
        if (concerns(order)) orders_[next[island_of_[order.robot.index()]]++] = order;
}

/// Large islands first; before them, each for itself, those with robots that are as much work as many.
void WindowStepper::cut_batches(const Assignment& assignment) {
    const std::size_t robots_most = in_lockstep(assignment) ? kLockstepMost + 1 : kRobotsPerBatch;
    const auto size = [&](std::uint32_t i) {
        return assignment.island_offsets[i + 1] - assignment.island_offsets[i];
    };
    sequence_.resize(assignment.island_offsets.size() - 1);
    std::iota(sequence_.begin(), sequence_.end(), 0u);
    weights_.clear();
    const std::span<const RobotId> robots_of_all = assignment.robots;
    for (std::uint32_t i = 0; i < sequence_.size(); ++i)
        weights_.push_back(weight_of(*model_, robots_of_all.subspan(assignment.island_offsets[i], size(i))));
    const auto is_apart = [&](std::uint32_t i) {
        return !in_lockstep(assignment) && weights_[i] > size(i) && weights_[i] >= kTeamFrom;
    };
    const auto key = [&](std::uint32_t i) {
        return std::pair(is_apart(i) ? weights_[i] : std::size_t{0}, std::size_t{size(i)});
    };
    std::stable_sort(sequence_.begin(), sequence_.end(), [&](auto a, auto b) { return key(a) > key(b); });
    batch_offsets_.assign(1, 0);
    std::size_t robots = 0;
    for (std::size_t k = 0; k < sequence_.size(); ++k) {
        robots += size(sequence_[k]);
        if (robots < robots_most && k + 1 < sequence_.size() && !is_apart(sequence_[k])) continue;
        batch_offsets_.push_back(k + 1);
        robots = 0;
    }
}

std::optional<WindowResult> WindowStepper::step(const Assignment& assignment, StateStore& store,
                                                const Between& between) {
    abandoned_ = false;
    const std::size_t n = assignment.robots.size();
    if (assignment.measured != measured_) measure(assignment.measured);
    sort_orders(assignment);
    cut_batches(assignment);
    states_.resize(n);
    bounds_.resize(n);
    swept_before_.assign(n, Aabb{});
    earlier_.resize(assignment.island_offsets.size() - 1);
    efforts_.assign(assignment.island_offsets.size() - 1, 0.0);
    for (std::size_t k = 0; k < n; ++k)
        states_[k] = &store.begin_window(assignment.robots[k], assignment.until);

    Job job{assignment, store, between,
            WindowResult{assignment.epoch, assignment.window, assignment.attempt, 0, {}, {}, {}}};
    resume_after_cut(job);
    swept_ = swept_before_;
    job.result.robots.resize(n);
    job.result.islands.resize(assignment.island_offsets.size() - 1);
    const std::size_t large = step_large_batches(job);
    pool_.run(
        batch_offsets_.size() - 1 - large,
        [&](std::size_t b, std::size_t worker) { step_batch(job, large + b, worker); }, [&] { between({}); });
    report_profile(job.result);
    if (abandoned_) return forget(job), std::nullopt;
    if (job.result.left > 0) return std::move(job.result);
    for (auto& boxes : earlier_) {
        job.result.earlier.insert(job.result.earlier.end(), boxes.begin(), boxes.end());
        boxes.clear();
    }
    return std::move(job.result);
}

/// Once a thread has seen that the assignment is abandoned, all others leave it, too: whether it has a result
/// does not depend on who asks when.
bool WindowStepper::is_abandoned() {
    if (!abandoned_ && options_.abandons && options_.abandons()) abandoned_ = true;
    return abandoned_;
}

void WindowStepper::forget(const Job& job) {
    for (const RobotId robot : job.assignment.robots) job.store.abandon_window(robot);
    for (auto& boxes : earlier_) boxes.clear();
}

/// All threads step an island together if it is more than their share of the work. Such islands are the
/// first; returns how many.
std::size_t WindowStepper::step_large_batches(Job& job) {
    const std::size_t all = std::accumulate(weights_.begin(), weights_.end(), std::size_t{0});
    if (in_lockstep(job.assignment)) return 0;
    scratch_[0].use_team(Team(pool_));
    std::size_t large = 0;
    for (; large + 1 < batch_offsets_.size(); ++large) {
        const std::size_t own = weights_[sequence_[batch_offsets_[large]]];
        if (own < kTeamFrom || own * threads() <= all) break;
        step_batch(job, large, 0);
    }
    scratch_[0].use_team({});
    return large;
}

void WindowStepper::measure(bool wanted) {
    measured_ = wanted && options_.now != nullptr;
    for (StepScratch& scratch : scratch_) scratch.measure_stages(measured_ ? options_.now : nullptr);
}

void WindowStepper::report_profile(WindowResult& result) {
    if (!measured_) return;
    StepProfile& all = result.profile.emplace();
    for (StepProfile& profile : profiles_) all += std::exchange(profile, {});
}

void WindowStepper::step_batch(Job& job, std::size_t batch, std::size_t worker) {
    const auto islands = std::span(sequence_).subspan(batch_offsets_[batch],
                                                      batch_offsets_[batch + 1] - batch_offsets_[batch]);
    const std::uint64_t start_ns = options_.clock ? options_.clock() : 0;
    const auto first_single = std::find_if(islands.begin(), islands.end(),
                                           [&](std::uint32_t i) { return job.robots(i).size() == 1; });
    if (in_lockstep(job.assignment)) {
        step_lockstep(job, islands, static_cast<std::size_t>(islands.end() - first_single), start_ns);
    } else {
        for (auto island = islands.begin(); island != first_single; ++island)
            step_island_through(job, *island, worker);
        if (first_single != islands.end())
            step_lane_group_through(job, {first_single, islands.end()}, worker);
    }
    double effort = 0;  // the measured time is split in proportion to it
    for (const std::uint32_t island : islands) effort += efforts_[island];
    const double spent =
        options_.clock ? static_cast<double>(options_.clock() - start_ns) : kCounted_ns * effort;
    for (const std::uint32_t island : islands)
        job.result.islands[island].cost_ns =
            static_cast<std::uint64_t>(spent * efforts_[island] / std::max(effort, 1.0));
    if (worker == 0) job.between({});
}

std::span<const Order> WindowStepper::take_orders(std::size_t island, Tick tick, std::size_t& next) const {
    const std::size_t first = next, end = order_offsets_[island + 1];
    while (next < end && orders_[next].apply_at == tick) ++next;
    return std::span(orders_).subspan(first, next - first);
}

void WindowStepper::step_island_through(Job& job, std::size_t island, std::size_t worker) {
    std::size_t next = order_offsets_[island];
    for (Tick tick = job.assignment.from; tick < job.assignment.until; ++tick) {
        if (is_abandoned()) return;
        if (!step_tick(job, island, tick, take_orders(island, tick, next), worker)) return;
        if (worker == 0 && is_due(weights_[island], tick + 1 - job.assignment.from)) job.between({});
    }
    report_robots(job, island);
}

bool WindowStepper::step_tick(Job& job, std::size_t island, Tick tick, std::span<const Order> orders,
                              std::size_t worker) {
    const std::size_t first = job.assignment.island_offsets[island];
    const std::span<const RobotId> robots = job.robots(island);
    const StepReport report =
        step_island(*model_, tick, robots, std::span(states_).subspan(first, robots.size()), orders,
                    std::span(bounds_).subspan(first, robots.size()), scratch_[worker]);
    profiles_[worker] += report.profile;
    sweep(job, island, orders);
    for (const float effort : read_efforts(scratch_[worker])) count(island, effort);
    IslandResult& outcome = job.result.islands[island];
    outcome.contacts += static_cast<std::uint64_t>(report.contacts);
    outcome.static_contacts += static_cast<std::uint64_t>(report.static_contacts);
    if (report.not_finite.valid()) give_up(job, island, report, tick);
    return !report.not_finite.valid();
}

void WindowStepper::count(std::size_t island, float effort) {
    efforts_[island] += static_cast<double>(effort);
    if (options_.counted) options_.counted(kCounted_ns * static_cast<double>(effort));
}

/// Adds the bounds of a tick to those of the window.
void WindowStepper::sweep(const Job& job, std::size_t island, std::span<const Order> orders) {
    const std::size_t first = job.assignment.island_offsets[island];
    const std::span<const RobotId> robots = job.robots(island);
    for (const Order& order : orders) {
        if (!teleports(order)) continue;
        const auto found = std::lower_bound(robots.begin(), robots.end(), order.robot);
        if (found == robots.end() || *found != order.robot) continue;
        const std::size_t k = first + static_cast<std::size_t>(found - robots.begin());
        if (!swept_[k].empty()) earlier_[island].push_back({order.robot, outward(swept_[k])});
        swept_[k] = Aabb{};
    }
    for (std::size_t k = first; k < first + robots.size(); ++k)
        swept_[k].include(valid_or_everywhere(bounds_[k]));
}

/// The bounds so far must still be compared with others'.
void WindowStepper::give_up(Job& job, std::size_t island, const StepReport& report, Tick tick) {
    IslandResult& outcome = job.result.islands[island];
    outcome.failed = report.not_finite;
    outcome.failed_at = tick;
    outcome.failed_joint = report.not_finite_joint;
    outcome.beyond_numbers = report.beyond_numbers;
    for (std::size_t k = job.assignment.island_offsets[island]; k < job.assignment.island_offsets[island + 1];
         ++k) {
        job.result.robots[k].robot = job.assignment.robots[k];
        job.result.robots[k].swept = outward(swept_[k]);
    }
}

/// Islands of one robot, all of them tick by tick: the step finds that they do not meet, and its result does
/// not depend on who shares the call. Their contacts are counted for the first.
void WindowStepper::step_lane_group_through(Job& job, std::span<const std::uint32_t> islands,
                                            std::size_t worker) {
    load_lane_group(job, islands, worker);
    const LaneGroup& c = lane_groups_[worker];
    for (Tick tick = job.assignment.from; tick < job.assignment.until; ++tick) {
        if (is_abandoned()) return;
        if (!step_lane_group(job, tick, worker)) return step_apart(job, c.islands, worker);
        if (worker == 0 && is_due(c.islands.size(), tick + 1 - job.assignment.from)) job.between({});
    }
    for (const std::uint32_t i : c.islands) report_robots(job, i);
}

void WindowStepper::load_lane_group(const Job& job, std::span<const std::uint32_t> islands,
                                    std::size_t worker) {
    LaneGroup& c = lane_groups_[worker];
    c.islands.assign(islands.begin(), islands.end());
    std::sort(c.islands.begin(), c.islands.end());
    c.robots.clear(), c.states.clear(), c.next.clear();
    for (const std::uint32_t i : c.islands) {
        const std::size_t k = job.assignment.island_offsets[i];
        c.robots.push_back(job.assignment.robots[k]), c.states.push_back(states_[k]);
        c.next.push_back(order_offsets_[i]);
    }
    c.bounds.resize(c.robots.size());
}

bool WindowStepper::step_lane_group(Job& job, Tick tick, std::size_t worker) {
    LaneGroup& c = lane_groups_[worker];
    c.orders.clear();
    for (std::size_t i = 0; i < c.islands.size(); ++i) {
        const std::span<const Order> due = take_orders(c.islands[i], tick, c.next[i]);
        c.orders.insert(c.orders.end(), due.begin(), due.end());
    }
    const StepReport report =
        step_island(*model_, tick, c.robots, c.states, c.orders, c.bounds, scratch_[worker]);
    profiles_[worker] += report.profile;
    for (std::size_t i = 0; i < c.islands.size(); ++i)
        bounds_[job.assignment.island_offsets[c.islands[i]]] = c.bounds[i];
    for (const std::uint32_t i : c.islands) sweep(job, i, c.orders);
    const std::span<const float> efforts = read_efforts(scratch_[worker]);
    for (std::size_t i = 0; i < c.islands.size(); ++i) count(c.islands[i], efforts[i]);
    IslandResult& outcome = job.result.islands[c.islands[0]];
    outcome.contacts += static_cast<std::uint64_t>(report.contacts);
    outcome.static_contacts += static_cast<std::uint64_t>(report.static_contacts);
    return !report.not_finite.valid();
}

/// One of them failed at a tick, and it is not known which of the others were stepped in it: all are stepped
/// again from the assignment's start, each by itself.
void WindowStepper::step_apart(Job& job, std::span<const std::uint32_t> islands, std::size_t worker) {
    for (const std::uint32_t i : islands) {
        job.result.islands[i] = {};
        earlier_[i].clear();
        for (std::size_t k = job.assignment.island_offsets[i]; k < job.assignment.island_offsets[i + 1];
             ++k) {
            swept_[k] = swept_before_[k];
            states_[k] = &job.store.begin_window(job.assignment.robots[k], job.assignment.until);
        }
        step_island_through(job, i, worker);
    }
}

void WindowStepper::report_robots(Job& job, std::size_t island) {
    for (std::size_t k = job.assignment.island_offsets[island]; k < job.assignment.island_offsets[island + 1];
         ++k) {
        RobotResult& out = job.result.robots[k];
        const RobotState& state = *states_[k];
        out.robot = job.assignment.robots[k];
        out.swept = outward(swept_[k]);
        const Vec3 centre = bounds_[k].centre();
        out.position = pack_position({centre.x, centre.y, centre.z}, out.swept);
        if (model_->type_of(out.robot).free_base)
            out.velocity = pack_velocity({state.v[3], state.v[4], state.v[5]});
        out.hash = state_hash(out.robot, job.assignment.until, state);
    }
}

}  // namespace roboss
