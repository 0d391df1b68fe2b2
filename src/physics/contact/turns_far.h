// Which contacts need a second look (second_look.h) because a body turns far in the tick. Over T: one robot,
// or a few in lanes.
#pragma once

#include "geometry/turning_speed.h"

namespace roboss {

/// Whether a contact of a turning shape may sink deeper in a tick than its row says: its points move on arcs.
template <class T>
MaskOf<T> turns_far(const Shape& shape, const Mat3T<T>& R, const Vec3T<T>& angular, double dt) {
    constexpr double kArc = 2.5e-4;  // m: between the arc and its tangent
    return T(0.5 * dt * dt) * norm(angular) * turning_speed<T>(shape, R, angular) > T(kArc);
}

}  // namespace roboss
