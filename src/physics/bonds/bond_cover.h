// Where bonds are, and what the holder's interaction bound covers for them. A holder's bound holds a point
// that the held robot's bound holds too, as long as the bond is not torn. So bonded robots meet in forecast,
// validation, grouping and step as robots in contact do, and no message tells of bonds (ARCHITECTURE.md,
// "Many Simulators").
#pragma once

#include "physics/dynamics/robot_work.h"

namespace roboss {

inline constexpr double kTear = 0.01;  // m: a bond of which the links are further from their place is torn
inline constexpr double kTwist = 0.1;  // rad: likewise

/// Pose of a link of a placed robot.
Transform pose_of(const RobotWork& work, LinkId link);

/// A point of the link, m, link axes: one of a collision shape on its body, if there is one, so that the
/// robot's interaction bound holds it in every pose. `spread`, m: how far the bound may be from it.
struct LinkPoint {
    Vec3 p_L;
    double spread = 0;
};
LinkPoint point_of(const RobotType& type, LinkId link);

/// Adds to the box of a placed robot what its bonds need.
void cover_bonds(const Model& model, RobotWork& work);

}  // namespace roboss
