// Keeps contact islands from gaining energy beyond what motors and springs of soft contacts can give.
// Newton's law of restitution at several contacts at once, and contacts with limbs that turn far in a tick,
// can add some by themselves (Stronge, Rigid body collisions with friction, 1990).
#pragma once

#include <span>

#include "physics/dynamics/kick_drift.h"
#include "physics/solver/rows.h"

namespace roboss {

/// rad in a tick: less turning of a free body adds nothing that counts.
inline constexpr double kSlowTurn = 0.005;

/// True if a rigid contact throws what hits it back, by the velocities that were solved for.
bool throws_back(const IslandRows& rows);
template <class T>
MaskOf<T> throws_back(const ContactRowT<T>& row) {
    constexpr double kRebound = 1e-3;  // m/s
    if (row.soft) return false;
    return (row.normal.impulse > T(0)) &
           (row.normal.target - row.normal.compliance * row.normal.impulse > T(kRebound));
}

/// Whether one side of the contact does not move freely: scenery, or a robot on a fixed base.
bool touches_fixed(std::span<const RobotWork> robots, const Contact& contact);

/// Sums over some robots about `origin`; `members` index `robots`. Overwrites `buffer`.
BodySums sum_robots(const Model& model, std::span<RobotWork> robots, std::span<const std::uint32_t> members,
                    const Vec3& origin, RobotWork& buffer);

/// Adds momentum about `origin` to robots with free bases, whose sums these are: they move as one rigid body.
void add_momentum(std::span<RobotWork> robots, std::span<const std::uint32_t> members, BodySums sums,
                  const Spatial& momentum, const Vec3& origin);

/// Adds angular momentum, N m s, to an island of robots with free bases: it turns about its centre of mass as
/// if it were one rigid body.
void turn_island(const Model& model, std::span<RobotWork> robots, std::span<const std::uint32_t> members,
                 const Vec3& moment, RobotWork& buffer);

/// Guards one contact island in one tick. `members` index `robots`.
class IslandGuard {
  public:
    /// What is known of the island besides its robots.
    struct Island {
        std::span<const std::uint32_t> members;
        std::span<const int> offsets;           // by member: its first degree of freedom in the island
        std::span<const double> v_before;       // by degree of freedom
        std::span<const SurfacePair> surfaces;  // by contact row
        std::span<const Contact* const> contacts;
        const IslandRows& rows;
        bool touched = false;   // a robot touches another or scenery
        bool bonded = false;    // bonds join its robots
        bool anchored = false;  // something pushes it that does not move freely
        bool bounces = false;   // throws_back
        bool drifts = false;    // a member takes the kick-drift step
        bool blown = false;     // a fluid pushes a member so hard that it takes the explicit step
    };

    /// Before the states are moved: notes the energy that the island may have after the tick. False where it
    /// is not at risk, or where more than motors and contact springs can give it energy.
    bool start(const Model& model, std::span<RobotWork> robots, const Island& island, RobotWork& buffer);
    /// After it: slows the motion of the members against each other (where anchored: all motion) as far as
    /// the energy grew.
    void finish(const Model& model, std::span<RobotWork> robots, std::span<const std::uint32_t> members,
                RobotWork& buffer) const;

  private:
    bool anchored_ = false;
    double energy_ = 0;  // J, at most
    Vec3 origin_;
};

}  // namespace roboss
