// BusRunControl: the RunControl of a BusClient. Where the world of the run changes, its owner makes another
// BusClient and says so: questions are then asked again, other requests end with "changed-world".
#pragma once

#include <deque>

#include "client/bus_client.h"
#include "ros2/run_control.h"

namespace roboss::ros2 {

/// See the top of the file. All requests of its BusClient must go through it.
class BusRunControl final : public RunControl {
  public:
    /// From now on this is the Client. It outlives this object, or the next call.
    void use(BusClient& client);
    /// Hands over the answers that have arrived. Called in each turn of the Client.
    void advance();
    /// True if orders were given since the last call: a free-running Client has to send() them.
    bool take_ordered() { return std::exchange(ordered_, false); }

    const Model& model() const override { return client_->model(); }
    Tick tick() const override { return client_ != nullptr ? client_->tick() : -1; }
    std::uint64_t era() const override { return clients_ << 32 | client_->welcomes(); }
    std::span<const RobotState> states() const override { return client_->states(); }
    Result<> order(RobotId robot, const Action& action) override;
    void request(ControlAction action, Done done) override;

  private:
    struct Pending {
        ControlAction action;
        Done done;
    };

    BusClient* client_ = nullptr;
    std::uint64_t clients_ = 0;    // that there were
    std::deque<Pending> pending_;  // in the order in which the Client sends them
    bool ordered_ = false;
};

}  // namespace roboss::ros2
