// Helping out within a window: what islands will cost is known to a tenth at best, so of many Simulators one
// is always late. It says so; when another has nothing to do, it is told to stop, and what it has left is
// shared out between it and them, from the tick to which it came.
#include <algorithm>
#include <numeric>

#include "plan/assign.h"
#include "roles/controller.h"

namespace roboss {

namespace {

constexpr double kHandOver_ns = 30'000;  // until a helper has a state and can begin

/// At least 1: 0 would mean that nothing is due. Simulators say what they like of costs.
std::uint64_t whole_ns(double ns) {
    return static_cast<std::uint64_t>(std::clamp(ns, 1.0, 1e18));
}

/// By RobotId, in ns a tick where they were stepped: what islands cost in the ticks before.
std::vector<float> cost_of_rest(const Islands& part, std::span<const IslandFrame> stepped, Tick ticks,
                                std::size_t robots) {
    std::vector<float> cost(robots, 0.0F);
    for (std::size_t i = 0; i < part.count(); ++i) {
        const double each = static_cast<double>(stepped[i].cost_ns) /
                            (static_cast<double>(ticks) * static_cast<double>(part.size_of(i)));
        for (const RobotId robot : part.of(i)) cost[robot.index()] = static_cast<float>(std::max(each, 1e-3));
    }
    return cost;
}

}  // namespace

/// Tells what is due: then who will need longer says so.
void Controller::expect_work() {
    if (!costs_known_ || roster_.workers().size() < 2) return;
    double work = 0, speed = 0;
    for (const float cost : cost_) work += static_cast<double>(cost);
    for (const std::uint32_t place : roster_.workers()) speed += roster_.seat(place).speed();
    const RoundSpan& span = round_->span();
    const double due_ns = work * static_cast<double>(span.until - span.from) / speed;
    if (due_ns >= options_.help_least_ns) round_->expect(whole_ns(due_ns));
}

void Controller::relieve(Bus& bus) {
    if (!round_ || round_->span().recovery || round_->repeats() > 0) return;
    const std::vector<Round::LateSeat> late = round_->late();
    if (late.empty()) return;
    std::vector<std::uint32_t> idle = round_->idle(roster_);
    const std::size_t each = std::max<std::size_t>(idle.size() / late.size(), 1);
    for (const Round::LateSeat& seat : late) {
        if (idle.empty()) return;
        const std::size_t n = std::min({each, idle.size(), seat.islands - 1});
        round_->cut(bus, roster_, seat.place, {idle.end() - static_cast<std::ptrdiff_t>(n), idle.end()});
        idle.resize(idle.size() - n);
    }
}

void Controller::share_out_rest(const Round::Answered& cut_short, std::span<const IslandFrame> stepped,
                                Tick at) {
    const Plan& plan = cut_short.plan;
    const Islands part{plan.island_offsets, plan.robots};
    std::vector<std::uint32_t> seats = cut_short.helpers;
    seats.push_back(cut_short.place);
    std::vector<double> speeds;
    for (const std::uint32_t seat : seats)
        speeds.push_back(roster_.seat(seat).speed() / roster_.seat(cut_short.place).rate);
    const std::vector<float> cost = cost_of_rest(part, stepped, at - plan.from, model_->robots.size());
    const std::vector<std::uint32_t> stays(cost.size(), static_cast<std::uint32_t>(seats.size() - 1));
    const auto left = static_cast<double>(plan.until - at);
    std::vector<std::uint32_t> place = assign({part, cost, stays, speeds, kHandOver_ns / left});
    for (std::uint32_t& seat : place) seat = seats[seat];
    const double due_ns = left * std::accumulate(cost.begin(), cost.end(), 0.0) /
                          std::accumulate(speeds.begin(), speeds.end(), 0.0);
    round_->plan_rest(cut_short, at, place, whole_ns(due_ns), roster_,
                      [this](Plan& rest) { give_all(book_, rest); });
    ++counters_.cuts;
}

}  // namespace roboss
