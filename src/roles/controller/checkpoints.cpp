// Two checkpoints at most: the complete one and the next.
#include "roles/controller/checkpoints.h"

#include <algorithm>
#include <utility>

#include "core/check.h"
#include "wire/state_block.h"

namespace roboss {

namespace {

std::vector<Holding> holdings_of(std::span<const SeatId> holders, const Roster& roster) {
    std::vector<Holding> holdings;
    std::vector<SeatId> seats;
    for (std::size_t r = 0; r < holders.size(); ++r) {
        auto seat_id = std::find(seats.begin(), seats.end(), holders[r]);
        if (seat_id == seats.end()) {
            seat_id = seats.insert(seats.end(), holders[r]);
            holdings.push_back({roster.address_of(holders[r]), {}});
        }
        holdings[static_cast<std::size_t>(seat_id - seats.begin())].robots.emplace_back(r);
    }
    return holdings;
}

}  // namespace

Checkpoints::Checkpoints(std::shared_ptr<const Model> model, Tick tick, std::vector<RobotState> states)
    : model_(std::move(model)) {
    ROBOSS_CHECK(
        states.size() == model_->robots.size(),
        std::to_string(states.size()) + " states for " + std::to_string(model_->robots.size()) + " robots");
    base_.tick = tick;
    base_.touched.reset(states.size());
    base_.states = std::make_shared<std::vector<RobotState>>(std::move(states));
}

void Checkpoints::serve(Bus& bus, const Address& from, const StateRequest& request) const {
    if (request.tick != base_.tick || request.window != 0) return;
    StateReply reply;
    reply.states.tick = request.tick;
    for (const RobotId robot : request.robots)
        if (robot.index() < base_.states->size()) append(reply.states, robot, (*base_.states)[robot.index()]);
    bus.send(kControllerAddress, from, std::move(reply));
}

std::vector<RobotId> Checkpoints::closure(const std::vector<bool>& wanted) {
    const auto n = static_cast<std::uint32_t>(wanted.size());
    std::vector<bool> root_wanted(n, false);
    for (std::uint32_t r = 0; r < n; ++r)
        if (wanted[r]) root_wanted[base_.touched.find(r)] = true;
    std::vector<RobotId> closure;
    for (std::uint32_t r = 0; r < n; ++r)
        if (root_wanted[base_.touched.find(r)]) closure.emplace_back(r);
    return closure;
}

void Checkpoints::committed(const Islands& islands, double busiest_s) {
    for (std::size_t i = 0; i < islands.count(); ++i) {
        const auto robots = islands.of(i);
        for (const RobotId robot : robots) {
            base_.touched.unite(robots.front().value, robot.value);
            if (next_) next_->touched.unite(robots.front().value, robot.value);
        }
    }
    work_s_ += busiest_s;
}

void Checkpoints::begin(StateDirectory& directory, const Roster& roster) {
    const bool here = base_.tick == directory.tick();
    if (next_ || (!here && directory.anything_lost(roster))) return;
    const bool requested = std::exchange(requested_, false);
    if (here) return;
    next_ = Checkpoint{directory.tick(), nullptr, {}, requested};
    next_->touched.reset(model_->robots.size());
    directory.want_checkpoint();
    work_s_ = 0;
}

void Checkpoints::advance(Bus& bus, const StateDirectory& directory, const Roster& roster,
                          std::int64_t resend_ms) {
    if (next_ && !next_->states) {
        ROBOSS_CHECK(next_->tick == directory.tick(),
                     "the holders at tick " + std::to_string(directory.tick()) +
                         " do not have the states of the checkpoint at " + std::to_string(next_->tick));
        next_->states = std::make_shared<std::vector<RobotState>>(model_->robots.size());
        pull_.begin(*model_, next_->tick, holdings_of(directory.holders(), roster));
    }
    pull_.advance(bus, kControllerAddress, resend_ms);
}

void Checkpoints::accept(const StateReply& reply) {
    if (!next_) return;
    pull_.accept(*model_, reply, [this](RobotId robot, RobotState&& state) {
        (*next_->states)[robot.index()] = std::move(state);
    });
}

bool Checkpoints::replace(StateDirectory& directory) {
    ROBOSS_CHECK(next_ && pull_.complete(), "a checkpoint is completed that is not fetched");
    directory.forget_checkpoint();
    if (directory.oldest_wanted(next_->tick) < next_->tick) return false;
    ROBOSS_CHECK(next_->tick > base_.tick, "the checkpoint at tick " + std::to_string(next_->tick) +
                                               " follows that of " + std::to_string(base_.tick));
    base_ = std::move(*next_);
    next_.reset();
    pull_.cancel();
    return true;
}

std::optional<Tick> Checkpoints::abandon(StateDirectory& directory) {
    if (!next_ || pull_.complete()) return std::nullopt;
    const Tick tick = next_->tick;
    requested_ = requested_ || next_->requested;
    pull_.cancel();
    next_.reset();
    directory.forget_checkpoint();
    return tick;
}

const std::vector<RobotState>* Checkpoints::states_at(Tick tick) const {
    if (base_.tick == tick) return base_.states.get();
    return next_ && next_->tick == tick && pull_.complete() ? next_->states.get() : nullptr;
}

}  // namespace roboss
