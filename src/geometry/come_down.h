// Where a shape that comes down along z first touches what lies below: for standing robots on the ground.
#pragma once

#include <optional>

#include "geometry/shape.h"

namespace roboss {

/// How far `a` has to move along z from X_WA (m, negative: down) until it touches `b` from above. It comes
/// down from `from` m above X_WA; what it overlaps there is not below it. Planes and height fields are
/// ground: it comes down onto them from wherever it is. nullopt: there is nothing of `b` below it. `a`: a
/// bounded convex shape. To 1e-7 m.
std::optional<double> come_down(const Shape& a, const Transform& X_WA, double from, const Shape& b,
                                const Transform& X_WB);

/// How far a point that lies in `b` has to move up along z until it is out of it (m, at least 0). nullopt: it
/// does not lie in it. Nothing lies in planes, height fields and open sheets. To 1e-7 m.
std::optional<double> rise_out(const Vec3& p_W, const Shape& b, const Transform& X_WB);

}  // namespace roboss
