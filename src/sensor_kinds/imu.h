// The inertial measurement unit (SDF: imu): specific force and angular rate.
#pragma once

#include <vector>

#include "core/types.h"
#include "math/vec3.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// What an IMU measures.
struct ImuReading {
    /// m/s^2, sensor axes: acceleration of the sensor's origin minus gravity. At rest it points up with 9.8
    /// m/s^2; in free fall it is zero. It is the mean over the tick that begins at `tick`, in the axes of the
    /// middle of that tick, as long as no order takes effect at it. An impact shows as its impulse over one
    /// tick.
    Vec3 specific_force_S;
    Vec3 angular_velocity_S;  ///< rad/s, sensor axes, at `tick`
    Tick tick = 0;            ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"specific_force", "m/s²"}, r.specific_force_S);
        visit({"angular_velocity", "rad/s"}, r.angular_velocity_S);
    }
};

/// Noise is drawn for each axis of the sensor frame.
struct ImuSpec {
    using Reading = ImuReading;  ///< what it measures

    NoiseSpec angular_velocity_x,     ///< rad/s
        angular_velocity_y,           ///< rad/s
        angular_velocity_z;           ///< rad/s
    NoiseSpec linear_acceleration_x,  ///< m/s^2
        linear_acceleration_y,        ///< m/s^2
        linear_acceleration_z;        ///< m/s^2

    /// Its elements of SDF that have no effect.
    static constexpr IgnoredElement kIgnored[] = {
        {"enable_orientation", "false|0", "an IMU measures no orientation",
         "Add <roboss:sensor type=\"gyrocompass\">."},
        {"orientation_reference_frame", "", "an IMU measures no orientation",
         "Add <roboss:sensor type=\"gyrocompass\">."},
        {"topic", "", "readings go to Clients, not to topics"},
        {"noise", "", "noise is given for each axis",
         "Write <angular_velocity> and <linear_acceleration> with <x>, <y> and <z>."},
    };
    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 5,
                                      .name = "imu",
                                      .phrase = "an IMU",
                                      .sdf_types = "imu",
                                      .block = "imu",
                                      .needs_all_states = true,
                                      .ignored = kIgnored};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"angular_velocity_x", "angular_velocity/x/noise", "rad/s"}, s.angular_velocity_x);
        visit({"angular_velocity_y", "angular_velocity/y/noise", "rad/s"}, s.angular_velocity_y);
        visit({"angular_velocity_z", "angular_velocity/z/noise", "rad/s"}, s.angular_velocity_z);
        visit({"linear_acceleration_x", "linear_acceleration/x/noise", "m/s²"}, s.linear_acceleration_x);
        visit({"linear_acceleration_y", "linear_acceleration/y/noise", "m/s²"}, s.linear_acceleration_y);
        visit({"linear_acceleration_z", "linear_acceleration/z/noise", "m/s²"}, s.linear_acceleration_z);
    }

    /// Compares all members.
    friend bool operator==(const ImuSpec&, const ImuSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>&) const {}
};

}  // namespace roboss
