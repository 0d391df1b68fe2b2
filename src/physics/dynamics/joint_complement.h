// The wrenches that a joint bears: all that do no work on its free motions.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "math/spatial.h"

namespace roboss {

struct JointComplement {
    std::array<Spatial, 6> wrenches;
    std::size_t count = 0;
};

/// An orthonormal basis of the wrenches whose power on each of `axes` (at most 6, independent) is zero; both
/// about one point, which should be near the joint.
JointComplement joint_complement(std::span<const Spatial> axes);

}  // namespace roboss
