// The altimeter (SDF: altimeter): height above where the robot started, and climb rate.
#pragma once

#include <vector>

#include "core/types.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// What an altimeter measures.
struct AltimeterReading {
    double vertical_position = 0;  ///< m, of the sensor's origin above its height at the start of the world
    double vertical_velocity = 0;  ///< m/s, upwards
    double reference = 0;          ///< m, world z of that start, without noise
    Tick tick = 0;                 ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"vertical_position", "m"}, r.vertical_position);
        visit({"vertical_velocity", "m/s"}, r.vertical_velocity);
        visit({"reference", "m"}, r.reference);
    }
};

/// Up is world z.
struct AltimeterSpec {
    using Reading = AltimeterReading;  ///< what it measures

    NoiseSpec position_noise,  ///< m
        velocity_noise;        ///< m/s

    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 30,
                                      .name = "altimeter",
                                      .phrase = "an altimeter",
                                      .sdf_types = "altimeter",
                                      .block = "altimeter"};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"position_noise", "vertical_position/noise", "m"}, s.position_noise);
        visit({"velocity_noise", "vertical_velocity/noise", "m/s"}, s.velocity_noise);
    }
    /// Compares all members.
    friend bool operator==(const AltimeterSpec&, const AltimeterSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>&) const {}
};

}  // namespace roboss
