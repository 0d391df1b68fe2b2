// Requests states until all have arrived.
#include "bus/state_pull.h"

#include "wire/state_block.h"

namespace roboss {

void StatePull::begin(const Model& model, Tick tick, std::vector<Holding> holders,
                      std::optional<std::int64_t> unasked_ms, std::uint64_t window) {
    active_ = true;
    tick_ = tick;
    window_ = window;
    wanted_.assign(model.robots.size(), false);
    missing_ = 0;
    holders_.clear();
    for (const Holding& holding : holders)
        for (const RobotId robot : holding.robots) {
            if (robot.index() >= wanted_.size() || wanted_[robot.index()]) continue;
            wanted_[robot.index()] = true;
            ++missing_;
        }
    redirect(std::move(holders));
    if (!unasked_ms) return;
    ask_now_ = false;
    asked_ms_ = *unasked_ms;
}

void StatePull::begin_all(const Model& model, Tick tick) {
    active_ = true;
    tick_ = tick;
    window_ = 0;
    wanted_.assign(model.robots.size(), true);
    missing_ = model.robots.size();
    holders_.clear();
}

void StatePull::redirect(std::vector<Holding> holders) {
    if (holders == holders_) return;
    holders_ = std::move(holders);
    ask_now_ = true;
}

void StatePull::cancel() {
    active_ = false;
}

void StatePull::advance(Bus& bus, const Address& self, std::int64_t resend_ms) {
    if (!active_ || missing_ == 0) return;
    const std::int64_t now = bus.now_ms();
    if (!ask_now_ && now - asked_ms_ < resend_ms) return;
    ask_now_ = false;
    asked_ms_ = now;
    for (const Holding& holding : holders_) {
        StateRequest request{tick_, {}, window_};
        for (const RobotId robot : holding.robots)
            if (robot.index() < wanted_.size() && wanted_[robot.index()]) request.robots.push_back(robot);
        if (!request.robots.empty()) bus.send(self, holding.source, std::move(request));
    }
}

std::optional<RobotState> StatePull::take(const Model& model, const StateBlock& block, std::size_t i,
                                          std::size_t offset) {
    const RobotId robot = block.robots[i];
    if (robot.index() >= wanted_.size() || !wanted_[robot.index()]) return std::nullopt;
    Result<RobotState> state =
        decode_state(state_bytes(block, i, offset), model.type_of(robot), model.robots.size());
    if (!state) return std::nullopt;
    wanted_[robot.index()] = false;
    --missing_;
    return std::move(state).value();
}

}  // namespace roboss
