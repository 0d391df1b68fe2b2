// Keeps passive contact islands from gaining energy. Newton's law of restitution at several contacts at once,
// and contacts with limbs that turn far in a tick, can add some by themselves (Stronge, Rigid body collisions
// with friction, 1990).
#pragma once

#include <span>

#include "physics/kick_drift.h"
#include "physics/rows.h"

namespace roboss {

/// True if a rigid contact throws what hits it back, by the velocities that were solved for.
bool throws_back(const IslandRows& rows);

/// One contact island's tick. `members` index `robots`.
class IslandGuard {
  public:
    /// Before the states are moved: notes the energy, if the island is passive and at risk. False if it is
    /// not. `anchored`: something pushes it that does not move freely.
    bool start(const Model& model, std::span<RobotWork> robots, std::span<const std::uint32_t> members,
               bool anchored, bool bounces, const IslandRows& rows, RobotWork& buffer);
    /// After it: slows the motion of the members against each other (where anchored: all motion) as far as
    /// the energy grew.
    void finish(const Model& model, std::span<RobotWork> robots, std::span<const std::uint32_t> members,
                RobotWork& buffer) const;

  private:
    BodySums sums(const Model& model, std::span<RobotWork> robots, std::span<const std::uint32_t> members,
                  RobotWork& buffer) const;

    bool anchored_ = false;
    double energy_ = 0;
    Vec3 origin_;
};

}  // namespace roboss
