// What two materials make of a contact between them.
//
// - Friction: mu and mu2 are each the smaller of the two. The direction is that of the shape that has one; of
//   the one with the smaller mu if both have (the rule of Gazebo). It is laid into the tangent plane; where
//   it stands on that plane, every tangent is across it and mu2 counts.
// - Restitution and its threshold: the larger.
// - Softness: two springs in series; their damping such that slow motion loses what both lose. A rigid
//   surface changes nothing in a soft one. A soft contact does not use restitution: its spring gives back
//   what its damper leaves.
// - Torsional friction: the smaller coefficient, the larger radius. Rolling friction: the larger.
// - Penetration left alone: the larger. Speed of correction, points of contact: the smaller.
#pragma once

#include "model/may_collide.h"
#include "model/model.h"

namespace roboss {

/// Friction directions at a contact point: the greater coefficient counts along `axis`, `across` times as
/// much at right angles to it.
struct FrictionEllipse {
    double mu = 0;
    Vec3 axis;          // unit, in the tangent plane; zero: the same in all directions
    double across = 1;  // from 0 to 1
};

struct Softness {
    double stiffness = 0, damping = 0;  // N/m, N s/m; stiffness 0: rigid
};

/// All of it, for one point.
struct SurfacePair {
    FrictionEllipse friction;
    double torsional = 0, rolling = 0;  // m: levers of the largest torques over the normal force
    double restitution = 0, bounce_threshold = 0;
    Softness softness;
    double slop = 0, correction_speed = 0;  // of a rigid contact, m and m/s
    // Of A's surface against B's, on top of what the bodies move: m/s and rad/s, world axes
    // (surface_motion.h).
    Vec3 velocity, turning;
    // Slip below the friction bound, m/s per N, by tangents of the contact's frame (wheel_slip.h).
    double slip_11 = 0, slip_12 = 0, slip_22 = 0;

    bool moves() const { return velocity != Vec3{} || turning != Vec3{}; }
};

FrictionEllipse friction_of(const Material& a, const Mat3& R_WA, const Material& b, const Mat3& R_WB,
                            const Vec3& normal);
Softness softness_of(const Material& a, const Material& b);
/// Radius of the patch that turns against torsional friction, times its coefficient and 3 pi / 16: the lever
/// of the largest torque over the normal force (pressure as Hertz says; SDFormat's <torsional>).
double torsional_lever(const Material& a, const Material& b, double depth);
/// `depth` of the point, m; `normal` in world axes, as R_WA and R_WB have them.
SurfacePair surface_pair(const Material& a, const Mat3& R_WA, const Material& b, const Mat3& R_WB,
                         const Vec3& normal, double depth);

}  // namespace roboss
