// RunControl: a run as the services of ROS 2 need it: its Model and observed states, orders to robots, and
// requests to the run with answers that come later. A Face has one over its Client (bus_run_control.h); tests
// have their own.
#pragma once

#include <functional>
#include <span>

#include "core/result.h"
#include "model/model.h"
#include "model/order.h"
#include "wire/control.h"

namespace roboss::ros2 {

/// See the top of the file.
class RunControl {
  public:
    /// Takes the answer to a request.
    using Done = std::function<void(const ControlOutcome&)>;

    virtual ~RunControl() = default;
    /// The world of the run.
    virtual const Model& model() const = 0;
    /// The tick of states(); negative: nothing was observed yet, and there are no states.
    virtual Tick tick() const = 0;
    /// Another number after each reset, rewind and change of the run: states before and after do not follow
    /// from each other.
    virtual std::uint64_t era() const = 0;
    /// States of all robots by RobotId.
    virtual std::span<const RobotState> states() const = 0;
    /// Gives an order to a robot; an Error says why it cannot be given.
    virtual Result<> order(RobotId robot, const Action& action) = 0;
    /// Sends a request to the run. `done` is called once, later, from a turn of the caller; never if the run
    /// is lost. Code "changed-world": the run has another world now, and what became of this is not known.
    virtual void request(ControlAction action, Done done) = 0;
};

}  // namespace roboss::ros2
