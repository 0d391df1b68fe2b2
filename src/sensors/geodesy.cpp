#include "sensors/geodesy.h"

#include <cmath>

#include "core/fixed_math.h"

namespace roboss {
namespace {

constexpr double kEquatorRadius = 6378137.0;         // m, WGS84
constexpr double kFlattening = 1.0 / 298.257223563;  // WGS84
constexpr double kPolarRadius = kEquatorRadius * (1.0 - kFlattening);
constexpr double kEccentricitySquared = kFlattening * (2.0 - kFlattening);
constexpr double kSecondEccentricitySquared =
    kEccentricitySquared / ((1.0 - kFlattening) * (1.0 - kFlattening));

/// Sine and cosine of the angle whose tangent is y / x.
SinCos direction(double y, double x) {
    const double length = std::sqrt(x * x + y * y);
    return {y / length, x / length};
}

}  // namespace

Vec3 to_earth(const Geodetic& point) {
    const SinCos lat = fixed_sincos(point.latitude_rad), lon = fixed_sincos(point.longitude_rad);
    const double prime_vertical = kEquatorRadius / std::sqrt(1.0 - kEccentricitySquared * lat.sin * lat.sin);
    const double r = (prime_vertical + point.altitude_m) * lat.cos;
    return {r * lon.cos, r * lon.sin,
            (prime_vertical * (1.0 - kEccentricitySquared) + point.altitude_m) * lat.sin};
}

Geodetic from_earth(const Vec3& p_E) {
    const double r = std::sqrt(p_E.x * p_E.x + p_E.y * p_E.y);
    SinCos lat;
    SinCos reduced = direction(p_E.z * kEquatorRadius, r * kPolarRadius);
    for (int round = 0; round < 2; ++round) {
        const double s = reduced.sin, c = reduced.cos;
        lat = direction(p_E.z + kSecondEccentricitySquared * kPolarRadius * s * s * s,
                        r - kEccentricitySquared * kEquatorRadius * c * c * c);
        reduced = direction((1.0 - kFlattening) * lat.sin, lat.cos);
    }
    const double to_surface = kEquatorRadius * std::sqrt(1.0 - kEccentricitySquared * lat.sin * lat.sin);
    return {fixed_atan2(lat.sin, lat.cos), fixed_atan2(p_E.y, p_E.x),
            r * lat.cos + p_E.z * lat.sin - to_surface};
}

Mat3 east_north_up(double latitude_rad, double longitude_rad) {
    const SinCos lat = fixed_sincos(latitude_rad), lon = fixed_sincos(longitude_rad);
    return {{-lon.sin, -lat.sin * lon.cos, lat.cos * lon.cos},
            {lon.cos, -lat.sin * lon.sin, lat.cos * lon.sin},
            {0.0, lat.cos, lat.sin}};
}

Mat3 world_to_earth(const SphericalCoordinates& origin) {
    const SinCos turn = fixed_sincos(origin.heading_rad);
    const Mat3 world_to_local{{turn.cos, -turn.sin, 0}, {turn.sin, turn.cos, 0}, {0, 0, 1}};
    return east_north_up(origin.latitude_rad, origin.longitude_rad) * world_to_local;
}

Geodetic world_to_geodetic(const SphericalCoordinates& origin, const Vec3& p_W) {
    const Vec3 p_E = to_earth({origin.latitude_rad, origin.longitude_rad, origin.elevation_m});
    return from_earth(p_E + world_to_earth(origin) * p_W);
}

}  // namespace roboss
