// Sensor readings: pure functions of (Model, states, tick, seed), computed on the Client's side.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/model.h"
#include "model/robot_state.h"

namespace roboss {

struct LaserReading {
    int samples = 0, vertical_samples = 0;
    // m, row by row (vertical angle ascending), horizontal angle ascending; +infinity: nothing within
    // range_max, -infinity: something nearer than range_min.
    std::vector<double> ranges;
    Tick tick = 0;  // of the measurement, as in all readings
};

struct OdometerReading {
    std::vector<double> joint_positions;  // rad (or m), one a joint of the sensor
    std::vector<double> joint_velocities;
    double distance = 0;  // m, mean wheel way since the start (0 without <wheel_radius>)
    double speed = 0;     // m/s
    Tick tick = 0;
};

struct GpsReading {
    Vec3 p_W;               // m, world frame
    Vec3 v_W;               // m/s
    bool geodetic = false;  // world has spherical coordinates: the next three are set (WGS84)
    double latitude_rad = 0, longitude_rad = 0, altitude_m = 0;
    Tick tick = 0;
};

struct CompassReading {
    Quat q_WS;                // orientation of the sensor frame
    Vec3 angular_velocity_S;  // rad/s, sensor axes (the gyro)
    Vec3 magnetic_field_S;    // T, sensor axes: the world's field, undisturbed
    double heading_rad = 0;   // of the sensor's x axis: clockwise from true north where the world has
                              // spherical coordinates (world y = north without), 0 .. 2 pi
    Tick tick = 0;
};

/// Rays against the static scenery and every robot (Embree, pinned to one instruction set, robust mode).
class RayScene {
  public:
    explicit RayScene(std::shared_ptr<const Model> model);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// Moves every robot's shapes to its state; states[i] belongs to RobotId i.
    void update(std::span<const RobotState* const> states);
    /// Nearest hit from `origin_W` along unit `direction_W`, in m, or +infinity; `self` (if valid) is not
    /// seen when `ignore_self_link` is the link that carries the sensor.
    struct Ray {
        Vec3 origin_W, direction_W;
        double max_range = 0;
        RobotId self;             // robot that carries the sensor
        LinkId ignore_self_link;  // that link's own shapes are not seen
    };
    void cast(std::span<const Ray> rays, std::span<double> distances);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Readings of sensor number `sensor` (of RobotType::sensors, of the matching kind) of a robot in `state`.
/// Noise is a pure function of (seed, robot, sensor, tick): SDF's mean, stddev, and a bias drawn once a run
/// from (bias_mean, bias_stddev).
/// A reading is that of the tick given; who asks less often than there are ticks because of the sensor's
/// <update_rate> is the Client (client/held_samples.h).
///
/// Laser: beam (row, column) points along (cos e cos a, cos e sin a, sin e) of the sensor frame, a in
/// [min_angle, max_angle], e in the vertical range, ends included (a single sample: the smaller end).
/// Surfaces are seen from both sides. Noise, then range_resolution, then clamped to [range_min, range_max];
/// whether a beam is out of range is judged without noise.
LaserReading read_laser(const Model& model, RobotId robot, std::size_t sensor, const RobotState& state,
                        Tick tick, std::uint64_t seed, RayScene& scene);
/// Odometer: noise as a fraction; distance has mean and bias (a wrong wheel radius), speed also the draw of
/// the tick. The draws do not add up in the distance: it is read off the wheels' angles, which an encoder
/// does not lose, and errors that add up would have to be remembered from reading to reading. SDFormat has no
/// odometer to follow.
OdometerReading read_odometer(const Model& model, RobotId robot, std::size_t sensor, const RobotState& state,
                              Tick tick, std::uint64_t seed);
/// GPS: the world is the plane that touches the WGS84 ellipsoid at its origin; noise in world axes, before
/// the conversion.
GpsReading read_gps(const Model& model, RobotId robot, std::size_t sensor, const RobotState& state, Tick tick,
                    std::uint64_t seed);
/// Gyrocompass: north at the sensor's own place; noise (rad) turns heading and orientation together; the gyro
/// has its own (<gyro><noise>, rad/s), drawn for each axis.
CompassReading read_compass(const Model& model, RobotId robot, std::size_t sensor, const RobotState& state,
                            Tick tick, std::uint64_t seed);

}  // namespace roboss
