// Energy and momentum of a robot in motion, for the step's guards: what passive rows do may never add to
// them.
#pragma once

#include <span>

#include "physics/dynamics/robot_work.h"

namespace roboss {

/// Kinetic energy T, momentum and inertia of some bodies about one point O.
struct BodySums {
    double kinetic = 0;      // J, rotors (armature) included
    double potential = 0;    // J: weight relative to O, springs and soft limits of the tree's joints
    Spatial momentum;        // kg m^2/s about O, kg m/s
    SpatialInertia inertia;  // about O, all joints locked

    /// The rigid motion that has this momentum (angular, linear velocity of the point at O). False if the
    /// inertia is singular.
    bool rigid_motion(Spatial& motion) const;
    Vec3 centre() const { return inertia.moment * (1.0 / inertia.mass); }
    double energy() const { return kinetic + potential; }
    /// J: of the motion about the centre of mass.
    double inner_kinetic() const { return kinetic - 0.5 * norm_squared(momentum.linear) / inertia.mass; }
    BodySums& operator+=(const BodySums& b) {
        kinetic += b.kinetic, potential += b.potential, momentum += b.momentum, inertia += b.inertia;
        return *this;
    }
};

/// Sums over the robot at coordinates q and velocities v about `origin` (world, m). Overwrites the poses,
/// velocities and inertias of `work`, whose type is set. `walk`: by its threads.
BodySums sum_bodies(const Model& model, std::span<const double> q, std::span<const double> v,
                    const Vec3& origin, RobotWork& work, BodyWalk* walk = nullptr);

/// The same of a placed and moved robot, which keeps everything but its inertias.
BodySums sum_placed_bodies(const Model& model, std::span<const double> q, std::span<const double> v,
                           const Vec3& origin, RobotWork& work, BodyWalk* walk = nullptr);

/// Moves the bodies of `sums` as a whole: by `displacement`, then by adding the rigid motion `change` (about
/// the origin).
void translate(const Vec3& displacement, const Vec3& gravity, BodySums& sums);
void add_motion(const Spatial& change, BodySums& sums);

/// Adds `share` of a rigid motion about `origin` to the velocities of a robot with a free base.
void add_rigid_motion(const Spatial& motion, const Vec3& origin, double share, RobotState& state);

/// How to take kinetic energy out of a motion and leave its momentum: v := rigid + share * (v - rigid), where
/// `rigid` is the rigid motion of the same momentum, or rest for what is anchored.
struct Slowdown {
    double share = 1;
    Spatial rigid;  // about the origin of the sums
    void apply(const RobotType& type, const Vec3& origin, RobotState& state) const;
};

/// The slowdown after which at most `kinetic` J remain. With a share of 0, more may remain: that of the rigid
/// motion.
Slowdown slowdown_to(double kinetic, const BodySums& sums, bool anchored);

}  // namespace roboss
