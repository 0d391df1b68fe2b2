// SimulationContext: what the services of a simulation share.
#pragma once

#include <string>
#include <vector>

#include "ros2/entities.h"
#include "ros2/model_folders.h"
#include "ros2/run_waits.h"
#include "ros2/service_table.h"
#include "ros2_types/messages/simulation_world_services.h"

namespace roboss::ros2 {

/// A place of the world that others may ask for.
struct NamedPlace {
    simulation_interfaces::NamedPose pose;  ///< name, tags, pose
    simulation_interfaces::Bounds bounds;   ///< around it; empty: none are known
};

/// Names, versions and sources of the services of a simulation.
struct SimulationOptions {
    std::string prefix;                      ///< of their names: "", "/gzserver"
    int version = 2;                         ///< of simulation_interfaces where layouts differ: 1 or 2
    std::vector<std::string> model_folders;  ///< whose files may be spawned by name
    std::vector<NamedPlace> places;          ///< of the world
};

/// The things that the parts of SimulationServices work on; all outlive them.
struct SimulationContext {
    RunControl& run;                   ///< the run
    RunWaits& waits;                   ///< what is waited for
    Entities& entities;                ///< of the run
    ServiceTable& table;               ///< of the node
    const SimulationOptions& options;  ///< how services are offered

    /// The name of a service.
    std::string name(const char* service) const { return options.prefix + "/" + service; }
    /// Its type, where the layouts of 1.x and 2.x differ.
    template <Service One, Service Two>
    const ServiceType& type() const {
        return options.version == 1 ? type_of_service<One>() : type_of_service<Two>();
    }
};

}  // namespace roboss::ros2
