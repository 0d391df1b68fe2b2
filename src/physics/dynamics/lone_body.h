// The tick of a free rigid body on which nothing but its weight acts. Its centre of mass follows a parabola
// and its angular momentum stays, both exactly; only its orientation is integrated.
#pragma once

#include "physics/dynamics/robot_work.h"

namespace roboss {

/// A robot of one link that no joint holds.
inline bool is_free_body(const RobotType& type) {
    return type.free_base && type.nv == 6;
}

/// True for a robot of one body, neither rod nor needle, that no joint, drag, fluid or wrench acts on and
/// that gravity pulls at its centre of mass.
bool is_lone_body(const Model& model, const RobotWork& work);

/// Moves a placed robot that is_lone_body() by one tick, by a Runge-Kutta method of fourth order. A tick in
/// which it turns far is cut into several steps. `fastest`: the square of its angular velocity, (rad/s)^2.
/// False, and nothing has moved, if it would gain energy.
bool advance_lone_body(const Model& model, double fastest, RobotWork& work);

}  // namespace roboss
