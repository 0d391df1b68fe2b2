// The odometer (<roboss:sensor type="odometer">): joint encoders, and with a wheel radius distance and speed.
#pragma once

#include <string>
#include <vector>

#include "core/types.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// What an odometer measures.
struct OdometerReading {
    std::vector<double> joint_positions;   ///< rad (m of prismatic joints), one per joint of the sensor
    std::vector<double> joint_velocities;  ///< rad/s (m/s)
    double distance = 0;  ///< m, mean over the wheels since the start; 0 without a wheel radius
    double speed = 0;     ///< m/s
    Tick tick = 0;        ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"joints", "rad"}, r.joint_positions);
        visit({"joint_velocities", "rad/s"}, r.joint_velocities);
        visit({"distance", "m"}, r.distance);
        visit({"speed", "m/s"}, r.speed);
    }
};

/// Noise is a fraction. Distance has its mean and bias (an error of the wheel's radius), speed also the draw
/// of the tick. Draws do not add up in the distance: it follows from the wheels' angles, which an encoder
/// does not lose. SDFormat has no odometer to follow.
struct OdometerSpec {
    using Reading = OdometerReading;  ///< what it measures

    JointNames joints;        ///< each has one axis
    double wheel_radius = 0;  ///< m; 0: angles only
    NoiseSpec noise;          ///< fraction of distance and speed

    /// What this kind states about itself.
    static constexpr SensorKind kKind{
        .number = 3, .name = "odometer", .phrase = "an odometer", .sdf_types = "odometer", .ours = true};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"joints", "joint"}, s.joints);
        visit({"wheel_radius", "wheel_radius", "m"}, s.wheel_radius);
        visit({"noise", "noise"}, s.noise);
    }

    /// Compares all members.
    friend bool operator==(const OdometerSpec&, const OdometerSpec&) = default;

    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>& problems) const {
        if (joints.empty())
            problems.push_back({"names no joint", "Add <joint>NAME</joint> for every wheel it counts."});
    }
};

}  // namespace roboss
