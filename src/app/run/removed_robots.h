// RemovedRobots: the robots that were removed in a run, so that `restore` can bring them back. It keeps a
// bounded number of them, the last ones.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "app/viewer/model_visuals.h"
#include "core/result.h"
#include "model/robot_state.h"

namespace roboss {

/// A robot as it was when it was removed.
struct RemovedRobot {
    std::shared_ptr<const Model> model;  ///< before the removal
    RobotId robot;                       ///< of that Model
    RobotState state;                    ///< without contacts, bonds and sleep, which concern others
    ModelVisuals::Worlds worlds;         ///< that it looks like
};

class RemovedRobots {
  public:
    static constexpr std::size_t kRobotsMost = 10'000;
    static constexpr std::size_t kRemovalsMost = 100;  // each keeps a Model

    /// A request that removed robots.
    struct Removal {
        std::shared_ptr<const Model> model;  ///< before
        std::vector<RobotId> now;            ///< by RobotId; not valid: it is gone
        std::vector<RobotState> states;      ///< by RobotId, before
        ModelVisuals::Worlds worlds;         ///< of `model`
    };
    void keep(const Removal& removal);
    /// The last removed one of each name. Error code: no-robot.
    Result<std::vector<RemovedRobot>> find(const std::vector<std::string>& names) const;
    /// The last removed one of each name is back.
    void forget(const std::vector<std::string>& names);
    std::size_t size() const { return robots_.size(); }

  private:
    std::size_t place_of(const std::string& name) const;

    std::deque<RemovedRobot> robots_;  // the oldest first
};

}  // namespace roboss
