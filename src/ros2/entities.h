// Entities: the robots of a world as simulation_interfaces sees them: names, states, boxes, and the notes
// that others keep about them. Message boards are none. The pose of an entity is that of its SDF model frame.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "math/aabb.h"
#include "physics/dynamics/kinematics.h"
#include "ros2/run_control.h"
#include "ros2_types/messages/simulation_entity_services.h"
#include "ros2_types/messages/simulation_spawn_services.h"

namespace roboss::ros2 {

/// A result as a message: the code and the text.
simulation_interfaces::Result result_of(std::uint8_t code, std::string text);
/// It went well.
simulation_interfaces::Result fine();

/// See the top of the file.
class Entities {
  public:
    /// `run` outlives it.
    explicit Entities(RunControl& run) : run_(run) {}

    /// All of them, by RobotId.
    std::vector<RobotId> all() const;
    /// The one of this name.
    std::optional<RobotId> find(const std::string& name) const;
    /// Those that all filters fit; or why the filters cannot be used.
    simulation_interfaces::Result matching(const simulation_interfaces::EntityFilters& filters,
                                           std::vector<RobotId>& found) const;

    /// The name in the world.
    const std::string& name(RobotId robot) const { return run_.model().robots[robot.index()].name; }
    /// Pose of its SDF model frame in the world, m.
    Pose pose(RobotId robot) const;
    /// Velocity of the same frame, world axes.
    Twist twist(RobotId robot) const;
    /// Both, as a message, with the time.
    simulation_interfaces::EntityState state(RobotId robot) const;
    /// The box about its collision shapes, in these axes; empty: it has none, or one without end.
    Aabb box(RobotId robot, const Transform& X_FW) const;
    /// The box along the axes of its canonical link.
    simulation_interfaces::Bounds bounds(RobotId robot) const;

    /// The notes about it: those that were set, else its category as its parts suggest.
    simulation_interfaces::EntityInfo info(RobotId robot) const;
    /// Replaces them. Notes about robots that are gone are forgotten.
    void set_info(RobotId robot, const simulation_interfaces::EntityInfo& info);

    /// A pose in a frame of the world: "", "world", the name of an entity, "ENTITY/LINK"; in the world, m.
    /// An Error, "bad-pose", if there is no such frame or it is no pose.
    Result<Pose> pose_in_world(const std::string& frame, const PoseMessage& pose) const;
    /// The pose of a frame, as above; an Error: there is none.
    Result<Pose> frame(const std::string& name) const;

  private:
    RunControl& run_;
    std::map<std::string, simulation_interfaces::EntityInfo> infos_;  // by name; of those that were set
};

/// True of a filter with more tags than are looked at.
bool is_too_long(const simulation_interfaces::TagsFilter& filter);
/// True if tags fit a filter.
bool fits(const std::vector<std::string>& tags, const simulation_interfaces::TagsFilter& filter);

}  // namespace roboss::ros2
