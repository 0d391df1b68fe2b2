// Wheels that slip (onboard_kinds/wheel_slip.h): what they make of the friction at a contact.
#pragma once

#include <span>

#include "physics/contact/contact.h"

namespace roboss {

/// Sets what of `pair` comes from wheels that slip: their compliances, as of the velocities of `robots`, and
/// coefficients of friction that were commanded. Where no wheel slips, nothing changes.
void add_slip(std::span<const RobotWork> robots, const Contact& contact, SurfacePair& pair);

}  // namespace roboss
