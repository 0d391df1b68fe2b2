// From the world's flat frame to the Earth's ellipsoid (WGS84) and back, exactly: the world is the plane that
// touches the ellipsoid (raised by the elevation) at the world's origin. With fixed functions only, so every
// machine gets the same bits.
#pragma once

#include "math/vec3.h"
#include "world/world.h"

namespace roboss {

struct Geodetic {
    double latitude_rad = 0, longitude_rad = 0;
    double altitude_m = 0;  // above the ellipsoid
};

/// Earth-centred, Earth-fixed coordinates in m: x to (0, 0), z to the north pole.
Vec3 to_earth(const Geodetic& point);
/// The inverse, within 1e-8 m up to 100 km above and 10 km below the ellipsoid (Bowring 1985, two rounds).
Geodetic from_earth(const Vec3& p_E);

/// Rotation from world axes to Earth axes at the world's origin.
Mat3 world_to_earth(const SphericalCoordinates& origin);
/// Rotation from east-north-up at a point to Earth axes.
Mat3 east_north_up(double latitude_rad, double longitude_rad);
/// Geodetic coordinates of a point of the world (m, world frame).
Geodetic world_to_geodetic(const SphericalCoordinates& origin, const Vec3& p_W);

}  // namespace roboss
