// Sensor readings: pure functions of (Model, states, tick, seed), computed on the Client's side. What a
// reading means, its units and its noise stand with its kind, in src/sensor_kinds.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/result.h"
#include "sensor_kinds/sensor_spec.h"
#include "sensors/sensor_query.h"

namespace roboss {

/// Rays against the static scenery and every robot: trees of boxes cull, shapes are measured in doubles.
class RayScene {
  public:
    /// Contains the static scenery; robots appear with the first update().
    explicit RayScene(std::shared_ptr<const Model> model);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// Moves every robot's shapes to its state; states[i] belongs to RobotId i.
    void update(std::span<const RobotState* const> states);
    /// One ray, in the world frame.
    struct Ray {
        Vec3 origin_W,            ///< m
            direction_W;          ///< unit vector
        double max_range = 0;     ///< m; hits beyond it do not count
        RobotId self;             ///< robot that carries the sensor; none: everything is seen
        LinkId ignore_self_link;  ///< that link's own shapes are not seen
    };
    /// Distance of the nearest hit of each ray, in m, or +infinity. Both spans have the same size.
    void cast(std::span<const Ray> rays, std::span<double> distances) const;
    /// Where rays of one sensor begin, and what they see.
    struct Fan {
        Transform X_WS;           ///< the sensor in the world
        double max_range = 0;     ///< m; hits beyond it do not count
        RobotId self;             ///< robot that carries the sensor; none: everything is seen
        LinkId ignore_self_link;  ///< that link's own shapes are not seen
    };
    /// The same for rays from the sensor's origin along unit vectors in its frame. `retros`: of each ray the
    /// laser_retro of what it meets, 0 where it meets nothing; or empty. Several threads may call it at once
    /// in share_out(), else one.
    void cast(const Fan& fan, std::span<const Vec3> directions_S, std::span<double> distances,
              std::span<double> retros) const;
    /// Whether a shape of the world has a laser_retro.
    bool has_retro() const;
    /// Threads that large casts and share_out() use, the calling one included; 1 at first. No bit depends on
    /// it.
    void set_threads(unsigned threads);
    /// Calls work(i) for each i below count, on all threads; work may cast.
    void share_out(std::size_t count, const std::function<void(std::size_t)>& work);
    /// What a ray meets first.
    struct Sight {
        double distance = 0;  ///< m, or +infinity
        RobotId robot;        ///< not valid: scenery, or nothing
        double retro = 0;     ///< laser_retro of the shape
    };
    /// The same, and whose shapes they are. Several threads may call it at once, between two update().
    void look(std::span<const Ray> rays, std::span<Sight> sights) const;
    /// How many shapes stand between two points of the world, m: of scenery and of robots other than these
    /// two. Planes do not count.
    std::size_t shapes_between(const Vec3& from_W, const Vec3& to_W, RobotId a, RobotId b) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// The reading of one sensor. An Error names a robot or sensor that does not exist, a sensor that measures
/// nothing, or why this one cannot measure. The sensor is read at the tick given, whatever its
/// `<update_rate>`: a Client holds samples in between (client/held_samples.h).
Result<Sample> measure(const SensorQuery& query);

/// The same as a reading of a known type; an Error also where the sensor is of another kind.
template <class Reading>
Result<Reading> measure_as(const SensorQuery& query) {
    Result<Sample> sample = measure(query);
    if (!sample) return sample.error();
    if (Reading* reading = std::get_if<Reading>(&sample.value())) return std::move(*reading);
    return Error{"sensor '" + query.info().spec.name + "' is read as " + kind_of_reading<Reading>().phrase,
                 std::string("it is ") + query.info().spec.kind().phrase};
}

/// The readings of sensors of one kind at one tick, all with the same sources, in the order of the queries;
/// on all threads of their ray scene where the kind allows it (SensorKind::by_rays).
std::vector<Result<Sample>> measure_all(std::span<const SensorQuery> queries);

// One for each kind, in a file of its own; called by measure(). The query is one that measure() has checked.
Result<LaserReading> read(const LaserSpec& laser, const SensorQuery& query);
Result<GpsReading> read(const GpsSpec& gps, const SensorQuery& query);
Result<CompassReading> read(const CompassSpec& compass, const SensorQuery& query);
Result<OdometerReading> read(const OdometerSpec& odometer, const SensorQuery& query);
Result<ImuReading> read(const ImuSpec& imu, const SensorQuery& query);
Result<AltimeterReading> read(const AltimeterSpec& altimeter, const SensorQuery& query);
Result<MagnetometerReading> read(const MagnetometerSpec& magnetometer, const SensorQuery& query);
Result<ContactReading> read(const ContactSpec& contact, const SensorQuery& query);
Result<ForceTorqueReading> read(const ForceTorqueSpec& sensor, const SensorQuery& query);
Result<OdometryReading> read(const OdometrySpec& odometry, const SensorQuery& query);
Result<JointStatesReading> read(const JointStatesSpec& states, const SensorQuery& query);
Result<LinkPosesReading> read(const LinkPosesSpec& poses, const SensorQuery& query);
Result<WheelOdometryReading> read(const WheelOdometrySpec& odometry, const SensorQuery& query);
Result<BatteryReading> read(const BatterySensorSpec& battery, const SensorQuery& query);
Result<KineticEnergyReading> read(const KineticEnergySpec& energy, const SensorQuery& query);
Result<TrajectoryProgressReading> read(const TrajectoryProgressSpec& progress, const SensorQuery& query);
Result<LogicalCameraReading> read(const LogicalCameraSpec& camera, const SensorQuery& query);
Result<MicrophoneReading> read(const MicrophoneSpec& microphone, const SensorQuery& query);
Result<AirPressureReading> read(const AirPressureSpec& barometer, const SensorQuery& query);
Result<AirSpeedReading> read(const AirSpeedSpec& tube, const SensorQuery& query);
Result<EnvironmentalReading> read(const EnvironmentalSpec& sensor, const SensorQuery& query);
Result<TrackOdometryReading> read(const TrackOdometrySpec& odometry, const SensorQuery& query);
Result<SonarReading> read(const SonarSpec& sonar, const SensorQuery& query);
Result<CameraReading> read(const ColorCameraSpec& camera, const SensorQuery& query);
Result<DepthCameraReading> read(const DepthCameraSpec& camera, const SensorQuery& query);
Result<RgbdCameraReading> read(const RgbdCameraSpec& camera, const SensorQuery& query);
Result<SegmentationCameraReading> read(const SegmentationCameraSpec& camera, const SensorQuery& query);
Result<BoxCameraReading> read(const BoxCameraSpec& camera, const SensorQuery& query);
Result<ThermalCameraReading> read(const ThermalCameraSpec& camera, const SensorQuery& query);
Result<JointEffortReading> read(const JointEffortSpec& sensor, const SensorQuery& query);
Result<InfraredReading> read(const InfraredSpec& sensor, const SensorQuery& query);
Result<RadioReading> read(const RadioSpec& radio, const SensorQuery& query);

/// The messages that a radio received after query.since up to query.tick, by time of arrival. An Error as of
/// measure().
Result<std::vector<RadioMessage>> receive(const SensorQuery& query);

}  // namespace roboss
