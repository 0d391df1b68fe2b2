// The gyrocompass (<roboss:sensor type="gyrocompass">): orientation, heading against true north, turning
// rate.
#pragma once

#include <vector>

#include "core/types.h"
#include "math/quat.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// What a gyrocompass measures.
struct CompassReading {
    Quat q_WS;                ///< orientation of the sensor frame in the world
    Vec3 angular_velocity_S;  ///< rad/s, sensor axes
    Vec3 magnetic_field_S;    ///< T, sensor axes: the world's field, without noise
    double heading_rad = 0;   ///< of the sensor's x axis, clockwise from north, 0 .. 2 pi
    Tick tick = 0;            ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"orientation"}, r.q_WS);
        visit({"angular_velocity", "rad/s"}, r.angular_velocity_S);
        visit({"magnetic_field", "T"}, r.magnetic_field_S);
        visit({"heading", "rad"}, r.heading_rad);
    }
};

/// North is true north at the sensor's own position; without `<spherical_coordinates>` it is world y. `noise`
/// turns heading and orientation together, about the vertical; `gyro_noise` is drawn for each axis.
struct CompassSpec {
    using Reading = CompassReading;  ///< what it measures

    NoiseSpec noise;       ///< rad
    NoiseSpec gyro_noise;  ///< rad/s

    /// What this kind states about itself.
    static constexpr SensorKind kKind{
        .number = 2, .name = "compass", .phrase = "a compass", .sdf_types = "gyrocompass", .ours = true};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"noise", "noise", "rad"}, s.noise);
        visit({"gyro_noise", "gyro/noise", "rad/s"}, s.gyro_noise);
    }

    /// Compares all members.
    friend bool operator==(const CompassSpec&, const CompassSpec&) = default;

    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>&) const {}
};

}  // namespace roboss
