// SimulationServices: simulation_interfaces on a run: all services, and the action SimulateSteps. Its answers
// come when the run has done what was asked for; each says what went wrong otherwise. docs/ros2-services.md
// says what each of them does here.
//
// Its owner hands it all calls that arrive, and calls advance() in each turn.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ros2/run_control.h"
#include "ros2/simulation_context.h"
#include "ros2/spawner.h"
#include "ros2_types/transport.h"

namespace roboss::ros2 {

/// See the top of the file.
class SimulationServices {
  public:
    /// Serves this node. `transport` and `run` outlive it.
    SimulationServices(Transport& transport, EntityId node, RunControl& run, SimulationOptions options);
    ~SimulationServices();
    SimulationServices(const SimulationServices&) = delete;
    SimulationServices& operator=(const SimulationServices&) = delete;

    /// Serves a call. False: it is of none of these services.
    bool take(const Incoming& call);
    /// Replies to what can be replied to now.
    void advance(std::int64_t now_ms);
    /// Calls that could not be read, and services that could not be added, since the last call.
    std::vector<std::string> take_notices();

    /// Adds and removes robots; for other services of the same run (GazeboServices).
    Spawner& spawner();
    /// The things that these services share with others.
    const SimulationContext& context() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace roboss::ros2
