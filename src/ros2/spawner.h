// Spawner: adds robots to a run and removes them, one request after the other, and waits until the world that
// is observed has changed.
#pragma once

#include <functional>
#include <set>
#include <string>

#include "ros2/entities.h"
#include "ros2/model_folders.h"
#include "ros2/run_waits.h"

namespace roboss::ros2 {

/// A robot that is to come.
struct Spawn {
    std::string name;         ///< in the world; empty: as in the description
    bool may_rename = false;  ///< a name that is taken, or none, is replaced
    std::string space;        ///< namespace in front of the name; empty: none
    std::string uri;          ///< of the description; empty: `text` counts
    std::string text;         ///< the description
    std::string frame;        ///< of the pose; Entities::frame()
    PoseMessage pose;         ///< m
};

/// See the top of the file.
class Spawner {
  public:
    /// Gets the result, with a code of SpawnEntity::Response, and the name of the robot.
    using Spawned = std::function<void(const simulation_interfaces::Result&, const std::string& name)>;
    /// Gets the result.
    using Removed = std::function<void(const simulation_interfaces::Result&)>;

    /// All outlive it.
    Spawner(RunControl& run, RunWaits& waits, Entities& entities, const ModelFolders& folders)
        : run_(run), waits_(waits), entities_(entities), folders_(folders) {}

    /// Adds a robot. Refused at once if too much waits already.
    void spawn(const Spawn& wanted, const Spawned& then);
    /// Removes robots by name; those that are gone already do not matter.
    void remove(std::vector<std::string> names, const Removed& then);
    /// Robots that were spawned here and are there still.
    std::vector<std::string> spawned() const;

  private:
    struct Addition;

    simulation_interfaces::Result prepare(const Spawn& wanted, Addition& addition) const;
    simulation_interfaces::Result choose_name(const Spawn& wanted, const std::string& in_file,
                                              std::string& name) const;
    void add(const std::shared_ptr<Addition>& addition);
    void await(const std::shared_ptr<Addition>& addition);

    RunControl& run_;
    RunWaits& waits_;
    Entities& entities_;
    const ModelFolders& folders_;
    std::set<std::string> spawned_;
    std::size_t waiting_bytes_ = 0;
};

}  // namespace roboss::ros2
