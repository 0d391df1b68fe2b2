// The GPS receiver (SDF: gps, navsat): position and velocity of the antenna, each with its own horizontal and
// vertical noise.
#pragma once

#include <vector>

#include "core/types.h"
#include "math/vec3.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// What a GPS receiver measures.
struct GpsReading {
    Vec3 p_W;                 ///< m, world frame
    Vec3 v_W;                 ///< m/s, world axes
    bool geodetic = false;    ///< the world has spherical coordinates: the next three are set (WGS84)
    double latitude_rad = 0,  ///< rad, north
        longitude_rad = 0,    ///< rad, east
        altitude_m = 0;       ///< m above the ellipsoid
    Tick tick = 0;            ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"world", "m"}, r.p_W);
        visit({"velocity", "m/s"}, r.v_W);
        visit({"geodetic"}, r.geodetic);
        visit({"latitude", "rad"}, r.latitude_rad);
        visit({"longitude", "rad"}, r.longitude_rad);
        visit({"altitude", "m"}, r.altitude_m);
    }
};

/// The world is the plane that touches the WGS84 ellipsoid at the world's origin. Noise is added in world
/// axes (horizontal: x and y, vertical: z), before the conversion to latitude and longitude.
struct GpsSpec {
    using Reading = GpsReading;  ///< what it measures

    NoiseSpec position_horizontal_noise,  ///< m
        position_vertical_noise;          ///< m
    NoiseSpec velocity_horizontal_noise,  ///< m/s
        velocity_vertical_noise;          ///< m/s

    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 1,
                                      .name = "gps",
                                      .phrase = "a GPS receiver",
                                      .sdf_types = "gps|navsat",
                                      .block = "navsat|gps"};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"position_horizontal_noise", "position_sensing/horizontal/noise", "m"},
              s.position_horizontal_noise);
        visit({"position_vertical_noise", "position_sensing/vertical/noise", "m"}, s.position_vertical_noise);
        visit({"velocity_horizontal_noise", "velocity_sensing/horizontal/noise", "m/s"},
              s.velocity_horizontal_noise);
        visit({"velocity_vertical_noise", "velocity_sensing/vertical/noise", "m/s"},
              s.velocity_vertical_noise);
    }

    /// Compares all members.
    friend bool operator==(const GpsSpec&, const GpsSpec&) = default;

    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>&) const {}
};

}  // namespace roboss
