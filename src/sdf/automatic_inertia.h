// Automatic inertia (<inertial auto="true">, SDFormat 1.11): mass properties from the volumes of a link's
// collisions.
#pragma once

#include <optional>

#include "sdf/conversion.h"

namespace roboss::sdf_import {

struct MassProperties {
    double mass = 0;
    Vec3 centre;   // in the link frame
    Mat3 inertia;  // about the centre, link axes
};

/// nullopt if no collision of the link has a known volume. Collisions without one (open meshes) are reported
/// and left out.
std::optional<MassProperties> automatic_inertia(const Element& link, const PoseInLink& pose_of,
                                                const Import& import);

}  // namespace roboss::sdf_import
