// The inertial measurement unit (SDF: imu): specific force, angular rate and orientation.
#pragma once

#include <string>
#include <vector>

#include "core/types.h"
#include "math/quat.h"
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
    /// Orientation of the sensor frame in the reference frame (ImuSpec::localization), at `tick`; all four
    /// numbers are 0 where `<enable_orientation>` is false.
    Quat orientation;
    Tick tick = 0;  ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"specific_force", "m/s²"}, r.specific_force_S);
        visit({"angular_velocity", "rad/s"}, r.angular_velocity_S);
        visit({"orientation"}, r.orientation);
    }
};

/// Noise is drawn for each axis of the sensor frame; orientation has none.
///
/// Reference frames, by `localization`: ENU (x east, y north, z up), NED, NWU, as at the world's origin.
/// CUSTOM: `custom_rpy_frame` turned by `custom_rpy`. GRAV_UP, GRAV_DOWN: z against or along gravity, x along
/// the level part of `gravity_x`. A frame is "world", a link of the robot as it stands at the start of the
/// world, or "": the sensor itself at the start.
struct ImuSpec {
    using Reading = ImuReading;  ///< what it measures

    NoiseSpec angular_velocity_x,         ///< rad/s
        angular_velocity_y,               ///< rad/s
        angular_velocity_z;               ///< rad/s
    NoiseSpec linear_acceleration_x,      ///< m/s^2
        linear_acceleration_y,            ///< m/s^2
        linear_acceleration_z;            ///< m/s^2
    bool enable_orientation = true;       ///< whether it measures its orientation
    std::string localization = "CUSTOM";  ///< which reference frame
    Vec3 custom_rpy;                      ///< rad, roll, pitch and yaw about fixed axes
    std::string custom_rpy_frame;         ///< that custom_rpy turns
    Vec3 gravity_x{1, 0, 0};              ///< along x of the reference frame, in gravity_x_frame
    std::string gravity_x_frame;          ///< that gravity_x is given in

    /// Its elements of SDF that have no effect.
    static constexpr IgnoredElement kIgnored[] = {
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
        visit({.name = "enable_orientation", .element = "enable_orientation", .later = true},
              s.enable_orientation);
        visit({.name = "localization", .element = "orientation_reference_frame/localization", .later = true},
              s.localization);
        // without a unit: <custom_rpy> has no attribute `degrees`
        visit({.name = "custom_rpy", .element = "orientation_reference_frame/custom_rpy", .later = true},
              s.custom_rpy);
        visit({.name = "custom_rpy_frame",
               .element = "orientation_reference_frame/custom_rpy/@parent_frame",
               .later = true},
              s.custom_rpy_frame);
        visit({.name = "gravity_x", .element = "orientation_reference_frame/grav_dir_x", .later = true},
              s.gravity_x);
        visit({.name = "gravity_x_frame",
               .element = "orientation_reference_frame/grav_dir_x/@parent_frame",
               .later = true},
              s.gravity_x_frame);
    }

    /// Compares all members.
    friend bool operator==(const ImuSpec&, const ImuSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>& problems) const {
        for (const char* known : {"ENU", "NED", "NWU", "CUSTOM", "GRAV_UP", "GRAV_DOWN"})
            if (localization == known) return;
        problems.push_back({"has the <localization> '" + localization + "'",
                            "Write ENU, NED, NWU, CUSTOM, GRAV_UP or GRAV_DOWN."});
    }
};

}  // namespace roboss
