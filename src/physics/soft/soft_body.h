// A free body as the soft solver sees it: its centre of mass, and its turning in coordinates in which the
// inertia is one.
#pragma once

#include <span>

#include "physics/dynamics/robot_work.h"
#include "physics/soft/soft_rows.h"

namespace roboss::soft {

struct Body {
    RobotWork* robot = nullptr;
    Vec3 centre;           // of mass, m, world axes
    Vec3 linear, angular;  // its velocity and that of turning, m/s and rad/s
    double mass = 0, inverse_mass = 0;
    // A, lower triangle, with A A^T the inertia about the centre, world axes; and 1 / its diagonal.
    Vec3 a_1, a_2, a_3, inverse;
    bool touched = false;  // a contact pushed it in this tick

    /// A^T w
    Vec3 whitened(const Vec3& w) const {
        return {(a_1.x * w.x + a_2.x * w.y) + a_3.x * w.z, a_2.y * w.y + a_3.y * w.z, a_3.z * w.z};
    }
    /// A^-1 torque
    Vec3 turned_by(const Vec3& torque) const {
        const double x = torque.x * inverse.x, y = (torque.y - a_2.x * x) * inverse.y;
        return {x, y, ((torque.z - a_3.x * x) - a_3.y * y) * inverse.z};
    }
    /// A^-T y
    Vec3 turning(const Vec3& y) const {
        const double w_z = y.z * inverse.z, w_y = (y.y - a_3.y * w_z) * inverse.y;
        return {((y.x - a_2.x * w_y) - a_3.x * w_z) * inverse.x, w_y, w_z};
    }
    /// A y
    Vec3 angular_momentum(const Vec3& y) const {
        return {a_1.x * y.x, a_2.x * y.x + a_2.y * y.y, (a_3.x * y.x + a_3.y * y.y) + a_3.z * y.z};
    }
};

/// True for robots that the soft solver moves, or that do not move by themselves.
bool may_be_soft(const RobotType& type);
/// The placed robot's body. False if its inertia has no root: it is no rigid body of finite size.
bool take_body(RobotWork& robot, Body& body);
/// The change by gravity and wrenches in a time `h`, s.
Motion kick_of(const Model& model, const Body& body, double h);
Motion velocity_of(const Body& body);
/// `factor` times a motion as the robot's degrees of freedom have it at the beginning of the tick: turning,
/// and the velocity of its origin.
void put_motion(const Motion& motion, const Body& body, double factor, std::span<double> to);
/// Moves the robot: `velocity` at the end of the tick, `moved` in it. Angular momentum stays while it turns.
void move_body(const Motion& velocity, const Motion& moved, double dt, const Body& body);

}  // namespace roboss::soft
