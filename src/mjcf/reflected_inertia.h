// The inertia that a joint moves where the file places the bodies: the joint's diagonal entry of the mass
// matrix.
#pragma once

#include "mjcf/robots.h"

namespace roboss::mjcf {

/// Of a hinge (kg m^2) or slide (kg), rotor included, with all joints at `ref`.
double reflected_inertia(Robots& robots, const Tree::JointPlace& joint);

}  // namespace roboss::mjcf
