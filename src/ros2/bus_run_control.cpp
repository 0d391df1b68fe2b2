// See bus_run_control.h.
#include "ros2/bus_run_control.h"

#include <utility>

namespace roboss::ros2 {

void BusRunControl::use(BusClient& client) {
    client_ = &client;
    ++clients_;
    for (Pending& pending : std::exchange(pending_, {})) {
        if (only_asks(pending.action))
            request(std::move(pending.action), std::move(pending.done));
        else
            pending.done(ControlRefused(Error{"the world of the run changed before it answered",
                                              "look at the world, and repeat the request if need be",
                                              "changed-world"}));
    }
}

void BusRunControl::advance() {
    for (const ControlAnswer& answer : client_->take_control_answers()) {
        if (pending_.empty()) return;
        const Pending first = std::move(pending_.front());
        pending_.pop_front();
        first.done(answer.outcome);
    }
}

Result<> BusRunControl::order(RobotId robot, const Action& action) {
    Result<> given = client_->order(robot, action);
    ordered_ = ordered_ || given.ok();
    return given;
}

void BusRunControl::request(ControlAction action, Done done) {
    pending_.push_back({action, std::move(done)});
    client_->control(std::move(action));
}

}  // namespace roboss::ros2
