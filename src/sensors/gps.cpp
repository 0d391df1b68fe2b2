// The GPS receiver: position and velocity with their own horizontal (world x, y) and vertical (world z)
// noise; latitude, longitude and altitude follow from the noisy position.
#include "core/check.h"
#include "core/float_env.h"
#include "physics/kinematics.h"
#include "sensors/geodesy.h"
#include "sensors/readings.h"
#include "sensors/sensor_noise.h"

namespace roboss {
namespace {

Vec3 disturbed(const Vec3& value, const NoiseSpec& horizontal, const NoiseSpec& vertical,
               const SensorMoment& moment, std::uint64_t first) {
    return {noisy_value(value.x, horizontal, moment, first, first),
            noisy_value(value.y, horizontal, moment, first + 1, first + 1),
            noisy_value(value.z, vertical, moment, first + 2, first + 2)};
}

}  // namespace

GpsReading read_gps(const Model& model, RobotId robot, std::size_t sensor, const RobotState& state, Tick tick,
                    std::uint64_t seed) {
    const ExactFloatScope exact;
    const RobotType& type = model.type_of(robot);
    ROBOSS_CHECK(sensor < type.sensors.size(), type.name + " has no sensor number " + std::to_string(sensor));
    const SensorInfo& info = type.sensors[sensor];
    const SensorSpec& spec = info.spec;
    ROBOSS_CHECK(spec.kind == SensorKind::kGps, spec.name + " is no GPS receiver");
    const Transform X_WL = link_pose(type, state, info.link);
    const Twist twist = link_twist(type, state, info.link);
    const Vec3 p_LS_W = X_WL.R * spec.X_LS.p;

    const SensorMoment moment{seed, robot, sensor, tick};
    GpsReading reading;
    reading.tick = tick;
    reading.p_W =
        disturbed(X_WL.p + p_LS_W, spec.position_horizontal_noise, spec.position_vertical_noise, moment, 0);
    reading.v_W = disturbed(twist.linear + cross(twist.angular, p_LS_W), spec.velocity_horizontal_noise,
                            spec.velocity_vertical_noise, moment, 3);
    if (model.spherical) {
        const Geodetic place = world_to_geodetic(*model.spherical, reading.p_W);
        reading.geodetic = true;
        reading.latitude_rad = place.latitude_rad;
        reading.longitude_rad = place.longitude_rad;
        reading.altitude_m = place.altitude_m;
    }
    return reading;
}

}  // namespace roboss
