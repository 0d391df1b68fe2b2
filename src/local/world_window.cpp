// WorldStepper: windows of several ticks on several threads.
#include <algorithm>
#include <numeric>
#include <utility>

#include "local/world_stepper.h"

namespace roboss {

namespace {

constexpr Tick kWindowLeast = 4, kWindowMost = 64;
constexpr std::size_t kBatchesPerThread = 4, kRobotsPerBatch = 8;  // enough to balance, and to fill lanes

}  // namespace

WorldStepper::Batch& WorldStepper::add_batch() {
    if (batch_count_ == batches_.size()) batches_.emplace_back();
    Batch& batch = batches_[batch_count_++];
    batch.robots.clear();
    batch.effort = batch.heaviest = 0;
    return batch;
}

/// Work of the last window; iterations of robots with many loops take as long as their bodies are many.
double WorldStepper::effort_of(RobotId robot) const {
    return static_cast<double>(efforts_[robot.index()]) *
           static_cast<double>(weight_of(model_->type_of(robot)));
}

void WorldStepper::enlist(Batch& batch, std::span<const RobotId> robots) {
    batch.robots.insert(batch.robots.end(), robots.begin(), robots.end());
    double effort = 0;
    for (const RobotId robot : robots) effort += effort_of(robot);
    batch.effort += effort;
    batch.heaviest = std::max(batch.heaviest, effort);
}

/// Prepares what step_island() takes of a batch whose robots are known.
void WorldStepper::finish(Batch& batch, std::vector<RobotState>& states) {
    std::ranges::sort(batch.robots);
    batch.states.clear();
    for (const RobotId robot : batch.robots) batch.states.push_back(&states[robot.index()]);
    batch.bounds.resize(batch.robots.size());
}

/// Islands by descending effort, each to the batch that has least to do.
void WorldStepper::plan(Tick ticks, std::span<const Order> orders, std::vector<RobotState>& states) {
    if (motions_.empty())
        for (std::size_t r = 0; r < states.size(); ++r)
            motions_.push_back(motion_of(*model_, RobotId(r), states[r]));
    forecast_.islands(motions_, orders, ticks, {}, islands_);
    const std::size_t wanted = std::clamp<std::size_t>(states.size() / kRobotsPerBatch, pool_.threads(),
                                                       kBatchesPerThread * pool_.threads());
    batch_count_ = 0;
    for (std::size_t b = 0; b < std::min(wanted, islands_.count()); ++b) add_batch();
    island_efforts_.assign(islands_.count(), 0.0);
    for (std::size_t i = 0; i < islands_.count(); ++i)
        for (const RobotId robot : islands_.of(i)) island_efforts_[i] += effort_of(robot);
    sequence_.resize(islands_.count());
    std::iota(sequence_.begin(), sequence_.end(), 0U);
    std::ranges::stable_sort(sequence_, std::greater<>(),
                             [&](std::uint32_t island) { return island_efforts_[island]; });
    for (const std::uint32_t island : sequence_) {
        const auto end = batches_.begin() + static_cast<std::ptrdiff_t>(batch_count_);
        enlist(*std::min_element(batches_.begin(), end,
                                 [](const Batch& a, const Batch& b) { return a.effort < b.effort; }),
               islands_.of(island));
    }
    for (std::uint32_t b = 0; b < batch_count_; ++b) {
        finish(batches_[b], states);
        for (const RobotId robot : batches_[b].robots) batch_of_[robot.index()] = b;
    }
}

/// All threads step a batch together if one of its islands is more than their share of the work. Such batches
/// are the first; returns how many.
std::size_t WorldStepper::step_large_batches(Tick from, Tick until, std::span<const Order> orders) {
    const std::span<Batch> batches = std::span(batches_).first(batch_count_);
    double all = 0;
    for (const Batch& batch : batches) all += batch.effort;
    const auto is_large = [&](const Batch& batch) {
        return weight_of(*model_, batch.robots) >= kTeamFrom &&
               batch.heaviest * static_cast<double>(pool_.threads()) > all;
    };
    std::size_t large = 0;
    scratch_[0].use_team(Team(pool_));
    while (large < batches.size() && is_large(batches[large]))
        step_batch(batches[large++], from, until, orders, scratch_[0]);
    scratch_[0].use_team({});
    return large;
}

/// False: a state of some batch is not finite.
bool WorldStepper::run_batches(Tick from, Tick until, std::span<const Order> orders) {
    const std::size_t large = step_large_batches(from, until, orders);
    pool_.run(batch_count_ - large, [&](std::size_t b, std::size_t worker) {
        step_batch(batches_[large + b], from, until, orders, scratch_[worker]);
    });
    return std::none_of(batches_.begin(), batches_.begin() + static_cast<std::ptrdiff_t>(batch_count_),
                        [](const Batch& batch) { return batch.outcome.not_finite.valid(); });
}

/// Puts robots that touched in different batches into batches of their own, at the window's start again;
/// false: there are none. Robots of one batch need not, for a step finds itself who meets whom.
bool WorldStepper::plan_repeats(std::vector<RobotState>& states) {
    sets_.reset(states.size());
    boxes_.clear();
    for (std::uint32_t r = 0; r < states.size(); ++r) boxes_.push_back({outward(swept_[r]), r});
    if (sweep_.unite_overlapping(boxes_, sets_) == 0) return false;
    // who was stepped as one island stays together: the set of another member may have grown
    for (std::size_t i = 0; i < merged_.count(); ++i)
        for (const RobotId robot : merged_.of(i)) sets_.unite(merged_.of(i).front().value, robot.value);
    collect_islands(sets_, merged_);
    batch_count_ = 0;
    for (std::size_t i = 0; i < merged_.count(); ++i) {
        const std::span<const RobotId> robots = merged_.of(i);
        const std::uint32_t batch = batch_of_[robots.front().index()];
        const auto is_elsewhere = [&](RobotId robot) { return batch_of_[robot.index()] != batch; };
        if (std::ranges::none_of(robots, is_elsewhere)) continue;
        enlist(add_batch(), robots);
        ++repeats_;
    }
    for (std::uint32_t b = 0; b < batch_count_; ++b) {
        for (const RobotId robot : batches_[b].robots) {
            states[robot.index()] = backup_.states[robot.index()];
            batch_of_[robot.index()] = static_cast<std::uint32_t>(states.size() + repeats_ - b);
        }
        finish(batches_[b], states);
    }
    return batch_count_ > 0;
}

void WorldStepper::note_motions(Tick ticks, const std::vector<RobotState>& states) {
    for (std::size_t r = 0; r < states.size(); ++r) {
        RobotMotion& motion = motions_[r];
        motion = motion_of(*model_, RobotId(r), states[r], bounds_[r]);
        motion.swept = outward(swept_[r]);
        motion.span_s = static_cast<float>(static_cast<double>(ticks) * model_->dt_s);
    }
}

StepOutcome WorldStepper::step_window(Tick from, Tick until, std::span<const Order> orders,
                                      std::vector<RobotState>& states) {
    const std::size_t repeats_before = repeats_;
    plan(until - from, orders, states);
    merged_ = {};
    bool finite = run_batches(from, until, orders);
    while (finite && plan_repeats(states)) finite = run_batches(from, until, orders);
    if (!finite) {  // perhaps only because robots that meet were stepped apart
        states = backup_.states;
        return step_all(from, until, orders, states);
    }
    note_motions(until - from, states);
    window_ =
        repeats_ > repeats_before ? std::max(window_ / 2, kWindowLeast) : std::min(window_ * 2, kWindowMost);
    return {.tick = until, .not_finite = {}, .not_finite_joint = {}};
}

}  // namespace roboss
