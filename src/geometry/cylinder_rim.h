// The four points that stand for a cylinder's end disc. Tilted, the first is the deepest point of the rim and
// the others follow in steps of 90 degrees. Upright the deepest point is noise, so there the four are fixed
// in the cylinder (its x and y axes); in between the first direction is blended, so points and gaps stay
// continuous as the cylinder tilts.
#pragma once

#include <array>

#include "geometry/narrow.h"

namespace roboss::narrow {

inline constexpr double kUpright = 1e-5;  // sine of the tilt below which the points are fixed in the cylinder
inline constexpr double kTilted = 1e-4;   // and above which the first is the deepest

/// Unit radial directions in W of the four rim points; `n` is the unit normal away from the supporting
/// surface.
inline std::array<Vec3, 4> rim_directions(const Posed& cylinder, const Vec3& n) {
    const Vec3 u = cylinder.axis(2);
    const Vec3 down = u * dot(n, u) - n;  // radial, as long as the sine of the tilt
    const double tilt = norm(down);
    Vec3 first = cylinder.axis(0);
    if (tilt >= kTilted) {
        first = down / tilt;
    } else if (tilt > kUpright) {
        const double w = (tilt - kUpright) / (kTilted - kUpright);
        const Vec3 mixed = first * (1.0 - w) + down * (w / tilt);
        const double length = norm(mixed);
        if (length > 1e-3) first = mixed / length;
    }
    const Vec3 second = cross(u, first);
    return {first, second, -first, -second};
}

}  // namespace roboss::narrow
