// FaceServices: the services, actions and parameters of a Face.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ros2/bus_run_control.h"
#include "ros2/gazebo_services.h"
#include "ros2/node_parameters.h"
#include "ros2/robot_action.h"
#include "ros2/robot_controllers.h"
#include "ros2/simulation_services.h"

namespace roboss::ros2 {

/// Which services there are.
struct FaceServiceOptions {
    SimulationOptions simulation;
    bool older_feedback = true;  ///< of FollowJointTrajectory: as of control_msgs before 6.3
};

/// See the top of the file.
class FaceServices {
  public:
    /// Serves the node of the world. `transport` outlives it.
    FaceServices(Transport& transport, EntityId world_node, FaceServiceOptions options);

    /// The run is seen by this Client from now on. `nodes`, `names`: of its robots, by RobotId, as
    /// robot_names() has them. `controllers`: of a file; null: the usual ones. The Client outlives this
    /// object, or the next call.
    void use(BusClient& client, const std::vector<EntityId>& nodes, std::vector<std::string> names,
             std::shared_ptr<const Controllers> controllers);
    /// Shows a number among the parameters of the node.
    void put(const std::string& parameter, double value, const std::string& description);
    /// Serves a call. False: it is of none of these services.
    bool take(const Incoming& call);
    /// A turn. True: orders were given.
    bool advance(std::int64_t now_ms);
    /// Problems since the last call, one line each.
    std::vector<std::string> take_notices();

  private:
    void add_actions();
    std::size_t add_actions(RobotId robot);

    Transport& transport_;
    EntityId world_node_;
    FaceServiceOptions options_;
    BusRunControl run_;
    SimulationServices simulation_;
    std::optional<GazeboServices> gazebo_;
    NodeParameters parameters_;
    std::string world_;
    std::vector<std::string> names_;  // of robots
    std::vector<EntityId> nodes_;
    std::size_t next_ = 0;  // robot whose actions are added next
    std::shared_ptr<const Controllers> controllers_;
    std::vector<std::unique_ptr<RobotAction>> actions_;
};

}  // namespace roboss::ros2
