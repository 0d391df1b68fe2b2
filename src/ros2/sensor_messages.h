// Messages of ROS 2 made from the readings of sensors, one function for each kind of sensor that has
// messages: publish(spec, reading, place, out) calls out(suffix, message) for each topic, always in the same
// order. The topics of a sensor are known from an empty reading.
#pragma once

#include "model/model.h"
#include "ros2/drive_controller.h"
#include "ros2_types/messages/gazebo_messages.h"
#include "ros2_types/messages/sensor_messages.h"
#include "sensor_kinds/sensor_spec.h"

namespace roboss::ros2 {

/// Whose messages they are.
struct SensorPlace {
    const Model& model;
    const SensorInfo& info;                  ///< the sensor
    std::string frame,                       ///< of the sensor
        link_frame,                          ///< of the link that carries it
        optical_frame,                       ///< of a camera: z ahead, x right, y down
        base_frame,                          ///< of the robot's base link
        odometry_frame;                      ///< of the poses of an odometry
    Time stamp;                              ///< of the measurement
    const DriveController* drive = nullptr;  ///< whose odometry it is, with its covariances; null: of none
};

namespace sensor_messages {

inline Header header(const SensorPlace& place, const std::string& frame) {
    return {place.stamp, frame};
}
inline Vector3 vector(const Vec3& v) {
    return {v.x, v.y, v.z};
}
inline Quaternion quaternion(const Quat& q) {
    return {q.x, q.y, q.z, q.w};
}
/// The variances of three independent values, as a matrix by rows.
inline std::array<double, 9> diagonal(double x, double y, double z) {
    return {x * x, 0, 0, 0, y * y, 0, 0, 0, z * z};
}

/// The beams of a laser's row: the middle one, as ros_gz_bridge takes it. Only of lasers with even angles.
LaserScan scan(const LaserSpec& laser, const LaserReading& reading, const SensorPlace& place);
/// The points that the beams of a laser meet, in the sensor's frame.
PointCloud2 cloud(const LaserSpec& laser, const LaserReading& reading, const SensorPlace& place);
/// The calibration of a camera whose image has this size.
CameraInfo camera_info(const CameraOptics& optics, const std::vector<double>& intrinsics,
                       const std::vector<double>& distortion, const SensorPlace& place);
/// The things that touch the link, one contact for each robot; normals and forces in the axes of the world.
Contacts contacts(const ContactReading& reading, const SensorPlace& place);
/// True if a laser is a single level row of beams at even angles, as LaserScan demands.
bool is_level_scan(const LaserSpec& laser);

/// An image; `encoding`: of its pixels.
template <class T>
ImageMessage image(const Image<T>& from, const char* encoding, const SensorPlace& place) {
    ImageMessage to;
    to.header = header(place, place.optical_frame), to.encoding = encoding;
    to.height = static_cast<std::uint32_t>(from.rows), to.width = static_cast<std::uint32_t>(from.columns);
    to.step =
        static_cast<std::uint32_t>(sizeof(T)) * static_cast<std::uint32_t>(from.columns * from.channels);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(from.samples.data());
    to.data.assign(bytes, bytes + from.samples.size() * sizeof(T));
    return to;
}
inline ImageMessage color_image(const Image<std::uint8_t>& from, const SensorPlace& place) {
    return image(from, from.channels == 1 && !from.empty() ? "mono8" : "rgb8", place);
}
inline Range range(std::uint8_t radiation, double field_of_view, double min, double max, double value,
                   const SensorPlace& place) {
    return {header(place, place.frame),
            radiation,
            static_cast<float>(field_of_view),
            static_cast<float>(min),
            static_cast<float>(max),
            static_cast<float>(value),
            0};
}
inline PoseMessage pose(const Vec3& p, const Quat& q) {
    return {{p.x, p.y, p.z}, quaternion(q)};
}
double cone_angle(const SonarSpec& sonar);
/// True if the sensor is an odometry, of wheels or of a publisher.
bool is_odometry(const SensorSpec& sensor);
/// Where an odometry sees the base, m.
Pose odometry_pose(const Sample& sample);
/// The optics of a camera; null: it is none.
const CameraOptics* optics_of(const SensorSpec& sensor);
/// A camera's optical frame in the frame of the sensor: z ahead, x right, y down.
Transform X_optical(const CameraOptics& optics);

}  // namespace sensor_messages

/// Kinds without messages.
template <class Spec, class Reading, class Out>
void publish(const Spec&, const Reading&, const SensorPlace&, Out&&) {}

template <class Out>
void publish(const LaserSpec& laser, const LaserReading& reading, const SensorPlace& place, Out&& out) {
    if (!sensor_messages::is_level_scan(laser)) {
        out("points", sensor_messages::cloud(laser, reading, place));
        return;
    }
    out("scan", sensor_messages::scan(laser, reading, place));
}

template <class Out>
void publish(const ImuSpec& spec, const ImuReading& reading, const SensorPlace& place, Out&& out) {
    using namespace sensor_messages;
    Imu imu;
    imu.header = header(place, place.frame);
    if (spec.enable_orientation)
        imu.orientation = quaternion(reading.orientation);
    else
        imu.orientation_covariance[0] = -1;
    imu.angular_velocity = vector(reading.angular_velocity_S);
    imu.angular_velocity_covariance = diagonal(spec.angular_velocity_x.stddev, spec.angular_velocity_y.stddev,
                                               spec.angular_velocity_z.stddev);
    imu.linear_acceleration = vector(reading.specific_force_S);
    imu.linear_acceleration_covariance =
        diagonal(spec.linear_acceleration_x.stddev, spec.linear_acceleration_y.stddev,
                 spec.linear_acceleration_z.stddev);
    out("imu", imu);
}

template <class Out>
void publish(const GpsSpec& gps, const GpsReading& reading, const SensorPlace& place, Out&& out) {
    using namespace sensor_messages;
    if (!place.model.spherical) {  // the world lies nowhere on Earth
        out("gps_pose", PoseStamped{header(place, "world"), pose(reading.p_W, {})});
        return;
    }
    constexpr double kDegrees = 180 / kPi;
    NavSatFix fix;
    fix.header = header(place, place.frame);
    fix.latitude = reading.latitude_rad * kDegrees, fix.longitude = reading.longitude_rad * kDegrees;
    fix.altitude = reading.altitude_m;
    const double across = gps.position_horizontal_noise.stddev, up = gps.position_vertical_noise.stddev;
    fix.position_covariance = diagonal(across, across, up);
    fix.position_covariance_type = across == 0 && up == 0 ? 0 : 2;
    out("navsat", fix);
}

template <class Out>
void publish(const MagnetometerSpec& spec, const MagnetometerReading& reading, const SensorPlace& place,
             Out&& out) {
    using namespace sensor_messages;
    out("magnetic_field",
        MagneticField{header(place, place.frame), vector(reading.field_S),
                      diagonal(spec.noise_x.stddev, spec.noise_y.stddev, spec.noise_z.stddev)});
}

template <class Out>
void publish(const AirPressureSpec& spec, const AirPressureReading& reading, const SensorPlace& place,
             Out&& out) {
    out("air_pressure", FluidPressure{sensor_messages::header(place, place.frame), reading.pressure,
                                      spec.noise.stddev * spec.noise.stddev});
}

template <class Out>
void publish(const OdometrySpec& spec, const OdometryReading& reading, const SensorPlace& place, Out&& out) {
    using namespace sensor_messages;
    Odometry odometry;
    odometry.header = header(place, place.odometry_frame), odometry.child_frame_id = place.base_frame;
    odometry.pose.pose = pose(reading.position_W, reading.orientation_W);
    odometry.twist.twist = {vector(reading.linear_velocity), vector(reading.angular_velocity)};
    for (std::size_t i = 0; i < 6; ++i)
        odometry.twist.covariance[7 * i] = spec.gaussian_noise * spec.gaussian_noise;
    out("odom", odometry);
}

template <class Out>
void publish(const WheelOdometrySpec&, const WheelOdometryReading& reading, const SensorPlace& place,
             Out&& out) {
    Odometry odometry;
    odometry.header = sensor_messages::header(place, place.odometry_frame);
    odometry.child_frame_id = place.base_frame;
    const Pose seen = sensor_messages::odometry_pose(reading);
    odometry.pose.pose = sensor_messages::pose(seen.p, seen.q);
    odometry.twist.twist.linear.x = reading.linear, odometry.twist.twist.angular.z = reading.angular;
    for (std::size_t i = 0; place.drive != nullptr && i < 6; ++i) {
        odometry.pose.covariance[7 * i] = place.drive->pose_covariance[i];
        odometry.twist.covariance[7 * i] = place.drive->twist_covariance[i];
    }
    out("odom", odometry);
}

template <class Out>
void publish(const BatterySensorSpec&, const BatteryReading& reading, const SensorPlace& place, Out&& out) {
    BatteryState battery;
    battery.header = sensor_messages::header(place, "");
    battery.voltage = static_cast<float>(reading.voltage),
    battery.current = static_cast<float>(-reading.current);
    battery.charge = static_cast<float>(reading.charge);
    battery.capacity = battery.design_capacity = static_cast<float>(reading.capacity);
    battery.percentage = static_cast<float>(reading.percentage / 100);
    battery.temperature = std::numeric_limits<float>::quiet_NaN();
    if (reading.charging) battery.power_supply_status = BatteryState::kCharging;
    out("battery_state", battery);
}

template <class Out>
void publish(const ForceTorqueSpec&, const ForceTorqueReading& reading, const SensorPlace& place, Out&& out) {
    using namespace sensor_messages;
    out("wrench", WrenchStamped{header(place, place.frame), {vector(reading.force), vector(reading.torque)}});
}

template <class Out>
void publish(const SonarSpec& sonar, const SonarReading& reading, const SensorPlace& place, Out&& out) {
    out("range", sensor_messages::range(Range::kUltrasound, sensor_messages::cone_angle(sonar),
                                        sonar.range_min, sonar.range_max, reading.range, place));
}

template <class Out>
void publish(const InfraredSpec& spec, const InfraredReading& reading, const SensorPlace& place, Out&& out) {
    out("range", sensor_messages::range(Range::kInfrared, spec.opening_angle, 0, spec.range_max,
                                        reading.range, place));
}

template <class Out>
void publish(const ColorCameraSpec& camera, const CameraReading& reading, const SensorPlace& place,
             Out&& out) {
    using namespace sensor_messages;
    out("image_raw", color_image(reading.color, place));
    out("camera_info", camera_info(camera.optics, reading.intrinsics, reading.distortion, place));
}

template <class Out>
void publish(const DepthCameraSpec& camera, const DepthCameraReading& reading, const SensorPlace& place,
             Out&& out) {
    using namespace sensor_messages;
    out("depth/image_raw", image(reading.depth, "32FC1", place));
    out("depth/camera_info", camera_info(camera.optics, reading.intrinsics, reading.distortion, place));
}

template <class Out>
void publish(const RgbdCameraSpec& camera, const RgbdCameraReading& reading, const SensorPlace& place,
             Out&& out) {
    using namespace sensor_messages;
    const CameraInfo info = camera_info(camera.optics, reading.intrinsics, reading.distortion, place);
    out("image_raw", color_image(reading.color, place));
    out("camera_info", info);
    out("depth/image_raw", image(reading.depth, "32FC1", place));
    out("depth/camera_info", info);
}

template <class Out>
void publish(const ThermalCameraSpec& camera, const ThermalCameraReading& reading, const SensorPlace& place,
             Out&& out) {
    using namespace sensor_messages;
    out("temperature/image_raw", image(reading.temperature, "32FC1", place));
    out("temperature/camera_info", camera_info(camera.optics, reading.intrinsics, reading.distortion, place));
}

template <class Out>
void publish(const SegmentationCameraSpec& camera, const SegmentationCameraReading& reading,
             const SensorPlace& place, Out&& out) {
    using namespace sensor_messages;
    out("labels/image_raw", image(reading.labels, "mono8", place));
    out("labels/camera_info", camera_info(camera.optics, reading.intrinsics, reading.distortion, place));
}

template <class Out>
void publish(const AltimeterSpec&, const AltimeterReading& reading, const SensorPlace& place, Out&& out) {
    out("altimeter", Altimeter{sensor_messages::header(place, place.frame), reading.vertical_position,
                               reading.vertical_velocity, reading.reference});
}

template <class Out>
void publish(const ContactSpec&, const ContactReading& reading, const SensorPlace& place, Out&& out) {
    out("contacts", sensor_messages::contacts(reading, place));
}

/// The function of the sensor's kind. `sample`: its reading; null: an empty one.
template <class Out>
void publish(const SensorPlace& place, const Sample* sample, Out&& out) {
    std::visit(
        [&]<class Spec>(const Spec& spec) {
            if constexpr (requires { typename Spec::Reading; }) {
                using Reading = typename Spec::Reading;
                publish(spec, sample != nullptr ? std::get<Reading>(*sample) : Reading{}, place, out);
            }
        },
        place.info.spec.parameters);
}

/// Calls out(suffix, message) for each topic of a sensor; the messages are empty.
template <class Out>
void for_each_topic(const Model& model, const SensorInfo& info, Out&& out) {
    publish(SensorPlace{model, info, {}, {}, {}, {}, {}, {}}, nullptr, out);
}

}  // namespace roboss::ros2
