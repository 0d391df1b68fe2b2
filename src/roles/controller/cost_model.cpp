// Running means with a half-life in ticks.
#include "roles/controller/cost_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "schedule/assign.h"

namespace roboss {

namespace {

constexpr float kGuessed_ns = 400;  // per tick and degree of freedom, until it is measured
constexpr double kCostTicks = 64;   // half-life of a robot's running mean cost
constexpr double kNewRateShare = 0.03;
constexpr double kNewSpentShare = 0.1;
// What it costs a Simulator to get an island's states, and the ticks within which the move must pay off.
constexpr double kMove_ns = 100'000;
constexpr Tick kMovePays = 64;
constexpr double kSend_ns = 30'000;  // the Controller's cost of sending one assignment

}  // namespace

CostModel::CostModel(const Model& model) {
    for (std::size_t i = 0; i < model.robots.size(); ++i)
        costs_.push_back(kGuessed_ns * static_cast<float>(4 + model.type_of(RobotId(i)).nv));
}

/// assign() with seats instead of indices; only workers get islands.
std::vector<SeatId> CostModel::assign_islands(const Islands& islands, const Roster& roster,
                                              std::span<const SeatId> holders, Tick ticks) const {
    const std::vector<SeatId> workers = roster.workers();
    ROBOSS_CHECK(!workers.empty() && ticks > 0, "islands are assigned to " + std::to_string(workers.size()) +
                                                    " workers for " + std::to_string(ticks) + " ticks");
    std::vector<std::uint32_t> index_of(roster.size(), kNowhere),
        simulator_of_robot(holders.size(), kNowhere);
    for (std::uint32_t i = 0; i < workers.size(); ++i) index_of[workers[i]] = i;
    for (std::size_t r = 0; r < holders.size(); ++r)
        if (holders[r] < roster.size()) simulator_of_robot[r] = index_of[holders[r]];
    std::vector<double> speeds;
    speeds.reserve(workers.size());
    for (const SeatId worker : workers) speeds.push_back(roster.seat(worker).speed());
    std::vector<SeatId> seats = assign({islands, costs_, simulator_of_robot, speeds,
                                        kMove_ns / static_cast<double>(std::max(ticks, kMovePays)),
                                        kSend_ns / static_cast<double>(ticks)});
    for (SeatId& seat : seats) seat = workers[seat];
    return seats;
}

std::vector<SeatId> CostModel::assign_recovered(const Islands& islands, const Roster& roster) const {
    const std::vector<SeatId> workers = roster.workers();
    ROBOSS_CHECK(!workers.empty(), "islands are recovered without workers");
    const std::vector<std::uint32_t> nowhere(costs_.size(), kNowhere);
    std::vector<double> speeds;
    speeds.reserve(workers.size());
    for (const SeatId worker : workers) speeds.push_back(roster.seat(worker).threads);
    std::vector<SeatId> seats = assign({islands, costs_, nowhere, speeds, 0});
    for (SeatId& seat : seats) seat = workers[seat];
    return seats;
}

double CostModel::even_share_ns(const Roster& roster, Tick ticks) const {
    const std::vector<SeatId> workers = roster.workers();
    if (!measured_ || workers.size() < 2) return 0;
    double work = 0, speed = 0;
    for (const float cost : costs_) work += static_cast<double>(cost);
    for (const SeatId worker : workers) speed += roster.seat(worker).speed();
    return work * static_cast<double>(ticks) / speed;
}

void CostModel::learn(const Round& round, Roster& roster) {
    const auto ticks = static_cast<double>(round.span().until - round.span().from);
    const Work work = learn_costs(round, roster, ticks);
    if (std::exchange(measured_, true)) learn_rates(work, roster);
    for (SeatId seat_id = 0; seat_id < roster.size(); ++seat_id) {
        SimulatorSeat& seat = roster.seat(seat_id);
        seat.spent_ns += kNewSpentShare * (round.spent_ns(seat_id) / (ticks * seat.threads) - seat.spent_ns);
    }
}

/// A Simulator's rate is its speed relative to the mean: it grows if its islands together cost less than
/// their robots did recently on any Simulator.
CostModel::Work CostModel::learn_costs(const Round& round, const Roster& roster, double ticks) {
    const auto share = static_cast<float>(measured_ ? 1 - std::exp2(-ticks / kCostTicks) : 1.0);
    Work work{std::vector(roster.size(), 0.0), std::vector(roster.size(), 0.0)};
    for (std::size_t i = 0; i < round.islands.count(); ++i) {
        const auto robots = round.islands.of(i);
        const RobotId first = robots.front();
        const SeatId seat_id = round.seat_of(first), last = round.last_seats()[first.index()];
        const auto cost_ns = static_cast<double>(round.outcome[first.index()].cost_ns);
        double expected = 0;
        for (const RobotId robot : robots) expected += static_cast<double>(costs_[robot.index()]);
        const double rate = 0.5 * (roster.seat(seat_id).rate + roster.seat(last).rate);
        if (round.since(first) == round.span().from) {  // an island that two have stepped measures neither
            work.expected_ns[seat_id] += ticks * expected / rate;
            work.spent_ns[seat_id] += cost_ns;
        }
        const double each = rate * cost_ns / (ticks * static_cast<double>(robots.size()));
        for (const RobotId robot : robots) {
            float& cost = costs_[robot.index()];
            cost += share * (static_cast<float>(std::max(each, 1e-3)) - cost);
        }
    }
    return work;
}

/// Rates learn only differences between Simulators; a change that affects all of them belongs to the robots'
/// costs.
void CostModel::learn_rates(const Work& work, Roster& roster) {
    double expected = 0, spent = 0;
    for (std::size_t seat_id = 0; seat_id < work.spent_ns.size(); ++seat_id)
        if (work.spent_ns[seat_id] > 0)
            expected += work.expected_ns[seat_id], spent += work.spent_ns[seat_id];
    if (expected <= 0 || spent <= 0) return;
    for (SeatId seat_id = 0; seat_id < roster.size(); ++seat_id) {
        if (work.spent_ns[seat_id] <= 0 || work.expected_ns[seat_id] <= 0) continue;
        const double faster = work.expected_ns[seat_id] / work.spent_ns[seat_id] * spent / expected;
        double& rate = roster.seat(seat_id).rate;
        rate = std::clamp(rate * (1 + kNewRateShare * (std::clamp(faster, 0.5, 2.0) - 1)), 0.01, 100.0);
    }
    double sum = 0;
    const std::vector<SeatId> workers = roster.workers();
    for (const SeatId seat_id : workers) sum += roster.seat(seat_id).rate;
    for (const SeatId seat_id : workers)
        roster.seat(seat_id).rate *= static_cast<double>(workers.size()) / sum;
}

}  // namespace roboss
