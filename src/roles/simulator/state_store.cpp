// Two states per robot, and copies that were kept.
#include "roles/simulator/state_store.h"

#include <algorithm>
#include <utility>

namespace roboss {

void StateStore::put(RobotId robot, Tick tick, RobotState&& state) {
    Slot& slot = slots_[robot.index()];
    slot.start = std::move(state);
    slot.start_tick = tick;
    slot.end_tick = slot.ahead_tick = kNone;
    forget_aside(robot, tick);  // it may stem from an attempt that was repeated
}

bool StateStore::start(RobotId robot, Tick tick) {
    Slot& slot = slots_[robot.index()];
    if (slot.end_tick == tick) {
        std::swap(slot.start, slot.end);
        slot.start_tick = tick;
        slot.end_tick = kNone;
    }
    if (slot.start_tick == tick) return true;
    const RobotState* aside = find_aside(robot, tick);
    if (aside == nullptr) return false;
    put(robot, tick, RobotState(*aside));
    return true;
}

RobotState& StateStore::begin_window(RobotId robot, Tick until) {
    Slot& slot = slots_[robot.index()];
    if (slot.ahead_tick == slot.start_tick)
        std::swap(slot.end, slot.ahead);
    else
        slot.end = slot.start;
    slot.ahead_tick = kNone;
    slot.end_tick = until;
    return slot.end;
}

void StateStore::cut_window(RobotId robot, Tick tick) {
    slots_[robot.index()].end_tick = tick;
}

void StateStore::abandon_window(RobotId robot) {
    slots_[robot.index()].end_tick = kNone;
}

void StateStore::set_aside(std::span<const RobotId> robots, Tick tick) {
    for (const RobotId robot : robots) {
        const RobotState* state = find_in_slot(robot, tick);
        if (state == nullptr) continue;
        forget_aside(robot, tick);
        aside_.push_back({robot, tick, *state});
    }
}

void StateStore::forget_aside(RobotId robot, Tick tick) {
    std::erase_if(aside_, [&](const Aside& a) { return a.robot == robot && a.tick == tick; });
}

void StateStore::forget_aside_before(Tick tick) {
    std::erase_if(aside_, [tick](const Aside& a) { return a.tick < tick; });
}

void StateStore::copy_ahead(RobotId robot) {
    Slot& slot = slots_[robot.index()];
    slot.ahead = slot.end;
    slot.ahead_tick = slot.end_tick;
}

const RobotState* StateStore::find(RobotId robot, Tick tick) const {
    const RobotState* state = find_in_slot(robot, tick);
    return state != nullptr ? state : find_aside(robot, tick);
}

const RobotState* StateStore::find_in_slot(RobotId robot, Tick tick) const {
    const Slot& slot = slots_[robot.index()];
    if (slot.start_tick == tick) return &slot.start;
    return slot.end_tick == tick ? &slot.end : nullptr;
}

const RobotState* StateStore::find_aside(RobotId robot, Tick tick) const {
    const auto here = std::find_if(aside_.begin(), aside_.end(),
                                   [&](const Aside& a) { return a.robot == robot && a.tick == tick; });
    return here == aside_.end() ? nullptr : &here->state;
}

void StateStore::keep(std::span<const RobotId> robots, Tick tick) {
    StateBlock block;
    block.tick = tick;
    for (const RobotId robot : robots)
        if (const RobotState* state = find(robot, tick)) append(block, robot, *state);
    if (!block.robots.empty()) kept_.emplace_back(std::move(block));
}

void StateStore::release_before(Tick tick) {
    std::erase_if(kept_, [tick](const StateShelf& shelf) { return shelf.tick() < tick; });
}

bool StateStore::copy_to(StateBlock& out, RobotId robot, Tick tick) const {
    if (robot.index() >= slots_.size()) return false;
    if (const RobotState* state = find(robot, tick)) {
        append(out, robot, *state);
        return true;
    }
    return std::any_of(kept_.begin(), kept_.end(), [&](const StateShelf& shelf) {
        return shelf.tick() == tick && shelf.copy_to(out, robot);
    });
}

void StateStore::clear() {
    std::fill(slots_.begin(), slots_.end(), Slot{});
    kept_.clear();
    aside_.clear();
}

}  // namespace roboss
