// The air speed sensor (SDF: air_speed): a Pitot tube along the sensor's x axis.
#pragma once

#include <vector>

#include "core/types.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// What an air speed sensor measures.
struct AirSpeedReading {
    double diff_pressure = 0;  ///< Pa, of the air that the sensor moves into along its x axis; else below 0
    double temperature = 0;    ///< K
    Tick tick = 0;             ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"diff_pressure", "Pa"}, r.diff_pressure);
        visit({"temperature", "K"}, r.temperature);
    }
};

/// Density and temperature are those of the standard atmosphere at world z above the sea, whatever the
/// world's `<atmosphere>`, as in gz-sensors. The wind is the one that blows at the robot.
struct AirSpeedSpec {
    using Reading = AirSpeedReading;  ///< what it measures

    NoiseSpec noise;  ///< hPa, as gz-sensors takes it

    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 33,
                                      .name = "air speed",
                                      .phrase = "an air speed sensor",
                                      .sdf_types = "air_speed",
                                      .block = "air_speed"};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"noise", "pressure/noise", "hPa"}, s.noise);
    }
    /// Compares all members.
    friend bool operator==(const AirSpeedSpec&, const AirSpeedSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>&) const {}
};

}  // namespace roboss
