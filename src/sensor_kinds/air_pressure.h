// The barometer (SDF: air_pressure): pressure of the standard atmosphere at its height.
#pragma once

#include <vector>

#include "core/types.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// What a barometer measures.
struct AirPressureReading {
    double pressure = 0;  ///< Pa
    Tick tick = 0;        ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"pressure", "Pa"}, r.pressure);
    }
};

/// The height above the sea is the reference plus world z. The atmosphere is the U.S. Standard Atmosphere of
/// 1976 below 11 km, whatever the world's `<atmosphere>`, as in gz-sensors.
struct AirPressureSpec {
    using Reading = AirPressureReading;  ///< what it measures

    double reference_altitude = 0;  ///< m above the sea, of world z = 0
    NoiseSpec noise;                ///< Pa

    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 31,
                                      .name = "air pressure",
                                      .phrase = "a barometer",
                                      .sdf_types = "air_pressure",
                                      .block = "air_pressure"};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"reference_altitude", "reference_altitude", "m"}, s.reference_altitude);
        visit({"noise", "pressure/noise", "Pa"}, s.noise);
    }
    /// Compares all members.
    friend bool operator==(const AirPressureSpec&, const AirPressureSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>&) const {}
};

}  // namespace roboss
