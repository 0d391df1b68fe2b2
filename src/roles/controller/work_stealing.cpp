// Costs of the rest are those of the ticks before the Cut.
#include "roles/controller/work_stealing.h"

#include <algorithm>
#include <numeric>

#include "roles/controller/order_feed.h"
#include "schedule/assign.h"

namespace roboss {

namespace {

constexpr double kHandOver_ns = 30'000;  // until an idle Simulator has a state and can begin

/// At least 1, since 0 means no limit. Clamped, since reported costs may be anything.
std::uint64_t whole_ns(double ns) {
    return static_cast<std::uint64_t>(std::clamp(ns, 1.0, 1e18));
}

/// By RobotId, in ns per tick: the cost of islands in the ticks before the Cut.
std::vector<float> cost_of_rest(const Islands& part, std::span<const IslandResult> stepped, Tick ticks,
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

void announce_expected_work(Round& round, const CostModel& costs, const Roster& roster, double least_ns) {
    const double due_ns = costs.even_share_ns(roster, round.span().until - round.span().from);
    if (due_ns > 0 && due_ns >= least_ns) round.expect(whole_ns(due_ns));
}

void steal_work(Bus& bus, Round& round, const Roster& roster) {
    if (round.span().recovery || round.repeats() > 0) return;
    const std::vector<Round::LateSeat> late = round.late();
    if (late.empty()) return;
    std::vector<SeatId> idle = round.idle(roster);
    const std::size_t each = std::max<std::size_t>(idle.size() / late.size(), 1);
    for (const Round::LateSeat& seat : late) {
        if (idle.empty()) return;
        const std::size_t n = std::min({each, idle.size(), seat.islands - 1});
        round.cut(bus, roster, seat.seat_id, {idle.end() - static_cast<std::ptrdiff_t>(n), idle.end()});
        idle.resize(idle.size() - n);
    }
}

void share_out_rest(Round& round, const Round::Answered& cut_short, std::span<const IslandResult> stepped,
                    Tick at, const Roster& roster, OrderLog& order_log) {
    const Assignment& assignment = cut_short.assignment;
    const Islands part{assignment.island_offsets, assignment.robots};
    std::vector<SeatId> seats = cut_short.helpers;
    seats.push_back(cut_short.seat_id);
    std::vector<double> speeds;
    for (const SeatId seat : seats)
        speeds.push_back(roster.seat(seat).speed() / roster.seat(cut_short.seat_id).rate);
    const std::vector<float> cost = cost_of_rest(part, stepped, at - assignment.from, round.seats().size());
    const std::vector<std::uint32_t> stays(cost.size(), static_cast<std::uint32_t>(seats.size() - 1));
    const auto left = static_cast<double>(assignment.until - at);
    std::vector<SeatId> seat_of_island = assign({part, cost, stays, speeds, kHandOver_ns / left});
    for (SeatId& seat : seat_of_island) seat = seats[seat];
    const double due_ns = left * std::accumulate(cost.begin(), cost.end(), 0.0) /
                          std::accumulate(speeds.begin(), speeds.end(), 0.0);
    round.assign_rest(cut_short, at, seat_of_island, whole_ns(due_ns), roster,
                      [&order_log](Assignment& rest) { give_all(order_log, rest); });
}

}  // namespace roboss
