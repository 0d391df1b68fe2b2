// Sends view states of some robots and exact states of others to a viewer.
#pragma once

#include "bus/bus.h"
#include "wire/state_block.h"
#include "wire/view_state.h"

namespace roboss {

/// state_of(robot): its state at the tick that is due, or nullptr; then it is left out.
template <class StateOf>
void send_views(const Model& model, const ViewLayout& layout, const ViewDue& due, StateOf&& state_of,
                const Address& self, Bus& bus) {
    ViewStates views{model.hash, due.epoch, due.serial, due.tick, {}, {}};
    std::size_t bytes = 0;
    for (const RobotId robot : due.robots)
        bytes += robot.index() < layout.robots() ? layout.bytes_of(robot) : 0;
    views.entries.reserve(bytes);
    for (const RobotId robot : due.robots)
        if (const RobotState* state = robot.index() < layout.robots() ? state_of(robot) : nullptr) {
            layout.append(model, robot, *state, views.entries);
            append(model, robot, *state, views.extras);
        }
    if (!views.entries.empty()) bus.send(self, due.viewer, std::move(views));
    StateReply exact;
    exact.states.tick = due.tick;
    for (const RobotId robot : due.exact)
        if (const RobotState* state = robot.index() < layout.robots() ? state_of(robot) : nullptr)
            append(exact.states, robot, *state);
    if (!exact.states.robots.empty()) bus.send(self, due.viewer, std::move(exact));
}

}  // namespace roboss
