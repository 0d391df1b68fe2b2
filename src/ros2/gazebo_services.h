// GazeboServices: the services of ros_gz_interfaces under the names that a bridge to Gazebo has, for scripts
// that are there already: /world/NAME/create, remove, set_pose, control.
#pragma once

#include <string>

#include "ros2/simulation_services.h"

namespace roboss::ros2 {

/// See the top of the file.
class GazeboServices {
  public:
    /// Beside these services, whose advance() also completes calls of these ones. `world`: the name of the
    /// world. All outlive it.
    GazeboServices(Transport& transport, EntityId node, const std::string& world,
                   SimulationServices& services);

    /// Serves a call. False: it is of none of these services.
    bool take(const Incoming& call) { return table_.take(call); }
    /// As of ServiceTable.
    std::vector<std::string> take_notices() { return table_.take_notices(); }

  private:
    void add_entity_services(const std::string& world);
    void add_control_service(const std::string& world);

    SimulationServices& services_;
    ServiceTable table_;
};

}  // namespace roboss::ros2
