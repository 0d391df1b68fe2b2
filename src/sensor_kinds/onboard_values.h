// What on-board controllers publish: the odometry of drives, the state of batteries, energy that a link lost,
// the progress of a trajectory. A Client reads it from the robot's state.
#pragma once

#include <vector>

#include "core/types.h"
#include "sensor_kinds/kind.h"

namespace roboss {

/// Where a drive takes the robot to be: integrated from its wheels, from zero at the start.
struct WheelOdometryReading {
    double x = 0,       ///< m, in the frame of the start
        y = 0,          ///< m, in the frame of the start
        heading = 0;    ///< rad
    double linear = 0,  ///< m/s, ahead
        angular = 0;    ///< rad/s, about z
    Tick tick = 0;      ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"x", "m"}, r.x);
        visit({"y", "m"}, r.y);
        visit({"heading", "rad"}, r.heading);
        visit({"linear", "m/s"}, r.linear);
        visit({"angular", "rad/s"}, r.angular);
    }
};

/// The odometry of a drive whose OnboardKind says where in its memory it is.
struct WheelOdometrySpec {
    using Reading = WheelOdometryReading;  ///< what it measures

    int controller_kind = -1,  ///< OnboardKind::number of the drive
        controller = 0;        ///< which of the model's controllers of that kind, from 0

    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 23,
                                      .name = "wheel odometry",
                                      .phrase = "a drive's odometry",
                                      .sdf_types = "",
                                      .ours = true,
                                      .plugin = {.topic = "odom_topic|odometry_topic|odometryTopic",
                                                 .usual_topic = "odometry",
                                                 .rate = "odom_publish_frequency|odometry_publish_frequency",
                                                 .usual_rate_hz = 50}};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"controller_kind", ""}, s.controller_kind);
        visit({"controller", ""}, s.controller);
    }
    /// Compares all members.
    friend bool operator==(const WheelOdometrySpec&, const WheelOdometrySpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>&) const {}
};

/// The state of a battery.
struct BatteryReading {
    double voltage = 0,     ///< V, between its poles
        current = 0,        ///< A, out of it
        charge = 0,         ///< A h
        capacity = 0,       ///< A h
        percentage = 0;     ///< of the capacity
    bool charging = false;  ///< whether it is being recharged
    Tick tick = 0;          ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"voltage", "V"}, r.voltage);
        visit({"current", "A"}, r.current);
        visit({"charge", "A h"}, r.charge);
        visit({"capacity", "A h"}, r.capacity);
        visit({"percentage", "%"}, r.percentage);
        visit({"charging"}, r.charging);
    }
};

/// The battery of LinearBatteryPlugin.
struct BatterySensorSpec {
    using Reading = BatteryReading;  ///< what it measures

    int controller = 0;  ///< which of the model's batteries, from 0

    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 24,
                                      .name = "battery",
                                      .phrase = "a battery's state",
                                      .sdf_types = "",
                                      .ours = true,
                                      .plugin = {.classes = "LinearBatteryPlugin",
                                                 .files = "linearbatteryplugin-system",
                                                 .topic = "battery_name",
                                                 .usual_topic = "battery"}};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"controller", ""}, s.controller);
    }
    /// Compares all members.
    friend bool operator==(const BatterySensorSpec&, const BatterySensorSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>&) const {}
};

/// The kinetic energy of a link, and what it lost in one tick.
struct KineticEnergyReading {
    double energy = 0,  ///< J
        lost = 0,       ///< J, in the last tick that lost more than the threshold
        lost_at = -1,   ///< that tick; -1: there was none
        losses = 0;     ///< how many ticks lost more than the threshold
    Tick tick = 0;      ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"energy", "J"}, r.energy);
        visit({"lost", "J"}, r.lost);
        visit({"lost_at", "ticks"}, r.lost_at);
        visit({"losses"}, r.losses);
    }
};

/// What KineticEnergyMonitor observes.
struct KineticEnergySpec {
    using Reading = KineticEnergyReading;  ///< what it measures

    int controller = 0;  ///< which of the model's monitors, from 0

    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 25,
                                      .name = "kinetic energy",
                                      .phrase = "a kinetic energy monitor",
                                      .sdf_types = "",
                                      .ours = true,
                                      .plugin = {.classes = "KineticEnergyMonitor",
                                                 .files = "kinetic-energy-monitor-system",
                                                 .usual_topic = "kinetic_energy"}};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"controller", ""}, s.controller);
    }
    /// Compares all members.
    friend bool operator==(const KineticEnergySpec&, const KineticEnergySpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>&) const {}
};

/// How far a trajectory has come.
struct TrajectoryProgressReading {
    double progress = 0;     ///< points that were reached or are next, as a share of all; 0 before the first
    bool is_active = false;  ///< whether points are still to come
    Tick tick = 0;           ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"progress"}, r.progress);
        visit({"active"}, r.is_active);
    }
};

/// The progress of JointTrajectoryController.
struct TrajectoryProgressSpec {
    using Reading = TrajectoryProgressReading;  ///< what it measures

    int controller = 0;  ///< which of the model's trajectory controllers, from 0

    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 26,
                                      .name = "trajectory progress",
                                      .phrase = "a trajectory's progress",
                                      .sdf_types = "",
                                      .ours = true,
                                      .plugin = {.classes = "JointTrajectoryController",
                                                 .files = "joint-trajectory-controller-system",
                                                 .usual_topic = "joint_trajectory_progress"}};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"controller", ""}, s.controller);
    }
    /// Compares all members.
    friend bool operator==(const TrajectoryProgressSpec&, const TrajectoryProgressSpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>&) const {}
};

/// How far a track has run, and how fast.
struct TrackOdometryReading {
    double position = 0,  ///< m, that the belt has run since the start
        velocity = 0;     ///< m/s, of the belt
    Tick tick = 0;        ///< of the measurement

    /// Calls visit(ReadingField, value) for each value, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& r) {
        visit({"position", "m"}, r.position);
        visit({"velocity", "m/s"}, r.velocity);
    }
};

/// The odometry of TrackController.
struct TrackOdometrySpec {
    using Reading = TrackOdometryReading;  ///< what it measures

    int controller = 0;  ///< which of the model's track controllers, from 0

    /// What this kind states about itself.
    static constexpr SensorKind kKind{.number = 27,
                                      .name = "track odometry",
                                      .phrase = "a track's odometry",
                                      .sdf_types = "",
                                      .ours = true,
                                      .plugin = {.classes = "TrackController",
                                                 .files = "track-controller-system",
                                                 .topic = "odometry_topic",
                                                 .usual_topic = "track_odometry",
                                                 .rate = "odometry_publish_frequency",
                                                 .usual_rate_hz = 50}};

    /// Calls visit(Parameter, value) for each parameter, always in the same order.
    template <class Visitor, class Self>
    static void parameters(Visitor&& visit, Self& s) {
        visit({"controller", ""}, s.controller);
    }
    /// Compares all members.
    friend bool operator==(const TrackOdometrySpec&, const TrackOdometrySpec&) = default;
    /// Adds why it cannot measure, if it cannot.
    void check(std::vector<SensorProblem>&) const {}
};

}  // namespace roboss
