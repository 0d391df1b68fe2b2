// WGS84 against published numbers and against itself there and back.
#include "sensors/geodesy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/fixed_math.h"

namespace roboss {
namespace {

constexpr double kDegree = kPi / 180.0;

/// Length of the meridian between two latitudes (degrees) in small straight steps.
double meridian_length(double from, double to) {
    double length = 0;
    const int steps = 20000;
    for (int i = 0; i < steps; ++i) {
        const double a = (from + (to - from) * i / steps) * kDegree,
                     b = (from + (to - from) * (i + 1) / steps) * kDegree;
        length += norm(to_earth({b, 0, 0}) - to_earth({a, 0, 0}));
    }
    return length;
}

TEST(Geodesy, ADegreeOfLatitudeHasItsPublishedLength) {
    EXPECT_NEAR(meridian_length(0, 1), 110574.4, 0.2);     // at the equator
    EXPECT_NEAR(meridian_length(89, 90), 111693.9, 0.2);   // at the pole
    EXPECT_NEAR(meridian_length(0, 90), 10001965.7, 1.0);  // quarter of a meridian
}

TEST(Geodesy, ADegreeOfLongitudeAtTheEquatorIsAnArcOfItsCircle) {
    EXPECT_NEAR(2 * norm(to_earth({0, 0.5 * kDegree, 0}) - to_earth({0, 0, 0})), 111319.49, 1.5);
}

TEST(Geodesy, PolesAndEquatorHaveTheEllipsoidsRadii) {
    EXPECT_NEAR(to_earth({0, 0, 0}).x, 6378137.0, 1e-9);
    EXPECT_NEAR(to_earth({0.5 * kPi, 0, 0}).z, 6356752.314245, 1e-6);
    EXPECT_NEAR(norm(to_earth({0.5 * kPi, 0, 0})), 6356752.314245, 1e-6);
    EXPECT_NEAR(to_earth({0, 0.5 * kPi, 50}).y, 6378187.0, 1e-8);
}

TEST(Geodesy, ThereAndBackIsTheSamePlace) {
    for (double latitude = -90; latitude <= 90; latitude += 2.5) {
        for (double longitude : {-180.0, -120.0, -0.001, 0.0, 45.0, 179.0}) {
            for (double altitude : {-10000.0, 0.0, 123.0, 9000.0, 100000.0}) {
                const Vec3 p = to_earth({latitude * kDegree, longitude * kDegree, altitude});
                const Geodetic back = from_earth(p);
                EXPECT_NEAR(norm(to_earth(back) - p), 0, 1e-8)
                    << latitude << " " << longitude << " " << altitude;
                EXPECT_NEAR(back.altitude_m, altitude, 1e-8);
                EXPECT_NEAR(back.latitude_rad, latitude * kDegree,
                            2e-15 + 1e-14 * (std::fabs(latitude) > 89));
            }
        }
    }
}

TEST(Geodesy, TheWorldsOriginIsWhereTheFileSaysIt) {
    const SphericalCoordinates origin{52.25 * kDegree, 21 * kDegree, 100, 0.3};
    const Geodetic place = world_to_geodetic(origin, {0, 0, 0});
    EXPECT_NEAR(place.latitude_rad, origin.latitude_rad, 1e-15);
    EXPECT_NEAR(place.longitude_rad, origin.longitude_rad, 1e-15);
    EXPECT_NEAR(place.altitude_m, 100, 1e-8);
    EXPECT_NEAR(world_to_geodetic(origin, {0, 0, 7}).altitude_m, 107, 1e-8);
}

TEST(Geodesy, EastNorthUpAreRightHandedAndUnit) {
    const Mat3 R = east_north_up(0.7, -2.1);
    EXPECT_NEAR(norm(cross(R.col(0), R.col(1)) - R.col(2)), 0, 1e-15);
    EXPECT_NEAR(norm(R.col(0)), 1, 1e-15);
    const Vec3 up = to_earth({0.7, -2.1, 1}) - to_earth({0.7, -2.1, 0});
    EXPECT_NEAR(norm(up - R.col(2)), 0, 2e-9);
}

}  // namespace
}  // namespace roboss
