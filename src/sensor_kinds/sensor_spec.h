// SensorSpec: a sensor of a link with the parameters of its kind. Here a kind of sensor is registered; hash,
// wire, SDF, viewer, checks and Clients reach all kinds through the list below (ARCHITECTURE.md, "A new
// sensor").
#pragma once

#include <concepts>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/diagnostics.h"
#include "math/pose.h"
#include "sensor_kinds/air_pressure.h"
#include "sensor_kinds/air_speed.h"
#include "sensor_kinds/altimeter.h"
#include "sensor_kinds/camera.h"
#include "sensor_kinds/compass.h"
#include "sensor_kinds/contact.h"
#include "sensor_kinds/depth_camera.h"
#include "sensor_kinds/environmental.h"
#include "sensor_kinds/force_torque.h"
#include "sensor_kinds/gps.h"
#include "sensor_kinds/imu.h"
#include "sensor_kinds/infrared.h"
#include "sensor_kinds/joint_effort.h"
#include "sensor_kinds/joint_states.h"
#include "sensor_kinds/kind.h"
#include "sensor_kinds/label_cameras.h"
#include "sensor_kinds/laser.h"
#include "sensor_kinds/link_poses.h"
#include "sensor_kinds/logical_camera.h"
#include "sensor_kinds/magnetometer.h"
#include "sensor_kinds/microphone.h"
#include "sensor_kinds/odometer.h"
#include "sensor_kinds/odometry.h"
#include "sensor_kinds/onboard_values.h"
#include "sensor_kinds/radio.h"
#include "sensor_kinds/sonar.h"
#include "sensor_kinds/thermal_camera.h"

namespace roboss {

/// A sensor of a type that is not simulated. It is kept, and measures nothing.
struct UnsupportedSensor {
    /// What this kind states about itself.
    static constexpr SensorKind kKind{
        .number = 4, .name = "unsupported", .phrase = "a sensor that measures nothing", .sdf_types = ""};
    /// It has none.
    template <class Visitor, class Self>
    static void parameters(Visitor&&, Self&) {}
    /// There is nothing to check.
    void check(std::vector<SensorProblem>&) const {}
    /// Compares all members.
    friend bool operator==(const UnsupportedSensor&, const UnsupportedSensor&) = default;
};

/// A list of kinds, and what follows from it.
template <class... Specs>
struct SensorKindList {
    using Parameters = std::variant<UnsupportedSensor, Specs...>;  ///< of any kind
    using Sample = std::variant<typename Specs::Reading...>;       ///< a reading of any kind
};

/// All kinds of sensors that are simulated.
using SensorKinds =
    SensorKindList<LaserSpec, GpsSpec, CompassSpec, OdometerSpec, ImuSpec, AltimeterSpec, MagnetometerSpec,
                   ContactSpec, ForceTorqueSpec, OdometrySpec, JointStatesSpec, LinkPosesSpec,
                   WheelOdometrySpec, BatterySensorSpec, KineticEnergySpec, TrajectoryProgressSpec,
                   LogicalCameraSpec, MicrophoneSpec, AirPressureSpec, AirSpeedSpec, EnvironmentalSpec,
                   TrackOdometrySpec, SonarSpec, ColorCameraSpec, DepthCameraSpec, RgbdCameraSpec,
                   SegmentationCameraSpec, BoxCameraSpec, ThermalCameraSpec, RadioSpec, JointEffortSpec,
                   InfraredSpec>;

/// Parameters of any kind.
using SensorParameters = SensorKinds::Parameters;
/// A reading of any kind.
using Sample = SensorKinds::Sample;

/// A sensor of a link.
struct SensorSpec {
    std::string name;             ///< unique in its link
    std::string sdf_type;         ///< as written, e.g. "gpu_lidar"
    Pose X_LS;                    ///< sensor in link
    double update_rate_hz = 0;    ///< samples a second; 0: one whenever it is asked
    SensorParameters parameters;  ///< of its kind
    SourceLocation where;         ///< in the file
    std::string topic{};          ///< of Gazebo, also the usual one; a Model does not keep it
    std::string ros_topic{},      ///< that the file gives, for ROS 2; empty: none; in no hash
        ros_frame{};              ///< the same, name of its frame

    /// The kind that it is of.
    const SensorKind& kind() const {
        return std::visit([](const auto& p) -> const SensorKind& { return p.kKind; }, parameters);
    }
    /// Whether its kind is simulated.
    bool measures() const { return !std::holds_alternative<UnsupportedSensor>(parameters); }
    /// The parameters if it is of this kind, else nullptr: `spec.as<LaserSpec>()`.
    template <class Kind>
    const Kind* as() const {
        return std::get_if<Kind>(&parameters);
    }
    /// The same, to be changed.
    template <class Kind>
    Kind* as() {
        return std::get_if<Kind>(&parameters);
    }
};

/// Calls visitor(Parameter, value) for each parameter, always in the same order.
template <class Visitor>
void visit_parameters(const SensorParameters& parameters, Visitor&& visitor) {
    std::visit([&](const auto& p) { p.parameters(visitor, p); }, parameters);
}
/// The same with values that may be changed.
template <class Visitor>
void visit_parameters(SensorParameters& parameters, Visitor&& visitor) {
    std::visit([&](auto& p) { p.parameters(visitor, p); }, parameters);
}

/// Calls visitor(ReadingField, value) for each value of a reading, always in the same order.
template <class Visitor>
void visit_fields(const Sample& sample, Visitor&& visitor) {
    std::visit([&](const auto& reading) { reading.fields(visitor, reading); }, sample);
}
/// The same with values that may be changed.
template <class Visitor>
void visit_fields(Sample& sample, Visitor&& visitor) {
    std::visit([&](auto& reading) { reading.fields(visitor, reading); }, sample);
}

/// Parameters of the kind that `matches(const SensorKind&)`, with their defaults; UnsupportedSensor if none
/// does.
template <class Predicate>
SensorParameters parameters_of_kind(Predicate&& matches) {
    SensorParameters found;
    const auto offer = [&]<class Kind>(std::in_place_type_t<Kind>) {
        if (matches(Kind::kKind)) found.template emplace<Kind>();
    };
    [&]<class... Kinds>(std::in_place_type_t<std::variant<Kinds...>>) {
        (offer(std::in_place_type<Kinds>), ...);
    }(std::in_place_type<SensorParameters>);
    return found;
}

/// The kind whose readings are of this type: `kind_of_reading<LaserReading>()`.
template <class Reading>
const SensorKind& kind_of_reading() {
    const SensorKind* found = nullptr;
    const auto offer = [&]<class Kind>(std::in_place_type_t<Kind>) {
        if constexpr (requires { requires std::same_as<typename Kind::Reading, Reading>; })
            found = &Kind::kKind;
    };
    [&]<class... Kinds>(std::in_place_type_t<std::variant<Kinds...>>) {
        (offer(std::in_place_type<Kinds>), ...);
    }(std::in_place_type<SensorParameters>);
    return *found;
}

/// An empty reading of the kind with this number; false: there is none, or it measures nothing.
bool make_sample(std::uint32_t number, Sample& sample);
/// The number of the kind that this reading is of.
std::uint32_t number_of(const Sample& sample);
/// The tick of the measurement.
Tick taken_at(const Sample& sample);

/// The joints that it reads, by name.
std::vector<std::string> joints_read(const SensorSpec& sensor);

/// Why it cannot measure; empty: it can.
std::vector<SensorProblem> problems_of(const SensorSpec& sensor);

}  // namespace roboss
