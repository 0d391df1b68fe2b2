// The magnetometer (SDF: magnetometer): the world's magnetic field in the sensor's axes.
#pragma once

#include <vector>

#include "core/types.h"
#include "math/vec3.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// What a magnetometer measures.
struct MagnetometerReading {
    Vec3 field_S;   ///< T, sensor axes
    Tick tick = 0;  ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"field", "T"}, r.field_S);
    }
};

/// The field is the world's `<magnetic_field>`, the same everywhere.
struct MagnetometerSpec {
    using Reading = MagnetometerReading;  ///< what it measures

    NoiseSpec noise_x,  ///< T, sensor axes
        noise_y,        ///< T
        noise_z;        ///< T

    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 32,
                                      .name = "magnetometer",
                                      .phrase = "a magnetometer",
                                      .sdf_types = "magnetometer",
                                      .block = "magnetometer"};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"noise_x", "x/noise", "T"}, s.noise_x);
        visit({"noise_y", "y/noise", "T"}, s.noise_y);
        visit({"noise_z", "z/noise", "T"}, s.noise_z);
    }
    /// Compares all members.
    friend bool operator==(const MagnetometerSpec&, const MagnetometerSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>&) const {}
};

}  // namespace roboss
