// Energy and momentum of a robot in motion, for the step's guards: what passive rows do may never add to
// them.
#pragma once

#include <span>

#include "physics/robot_work.h"

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
};

/// Sums over the robot at coordinates q and velocities v about `origin` (world, m). Overwrites the poses,
/// velocities and inertias of `work`, whose type is set.
BodySums sum_bodies(const Model& model, std::span<const double> q, std::span<const double> v,
                    const Vec3& origin, RobotWork& work);

/// The same of a placed and moved robot, which keeps everything but its inertias.
BodySums sum_placed_bodies(const Model& model, std::span<const double> q, std::span<const double> v,
                           const Vec3& origin, RobotWork& work);

/// The motion about a point that lies `arm` from O, and back.
inline Spatial moved_motion(const Spatial& motion, const Vec3& arm) {
    return {motion.angular, motion.linear + cross(motion.angular, arm)};
}

}  // namespace roboss
