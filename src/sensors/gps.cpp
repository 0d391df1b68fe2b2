// The GPS receiver: position and velocity with their own horizontal (world x, y) and vertical (world z)
// noise; latitude, longitude and altitude follow from the noisy position.
#include "physics/dynamics/kinematics.h"
#include "sensors/geodesy.h"
#include "sensors/readings.h"
#include "sensors/sensor_noise.h"

namespace roboss {
namespace {

Vec3 disturbed(const Vec3& value, const NoiseSpec& horizontal, const NoiseSpec& vertical,
               const SensorQuery& query, std::uint64_t first) {
    return {noisy_value(value.x, horizontal, query, first, first),
            noisy_value(value.y, horizontal, query, first + 1, first + 1),
            noisy_value(value.z, vertical, query, first + 2, first + 2)};
}

}  // namespace

Result<GpsReading> read(const GpsSpec& gps, const SensorQuery& query) {
    const SensorInfo& info = query.info();
    const Transform X_WL = link_pose(query.type(), query.state, info.link);
    const Twist twist = link_twist(query.type(), query.state, info.link);
    const Vec3 p_LS_W = X_WL.R * info.spec.X_LS.p;

    GpsReading reading;
    reading.p_W =
        disturbed(X_WL.p + p_LS_W, gps.position_horizontal_noise, gps.position_vertical_noise, query, 0);
    reading.v_W = disturbed(twist.linear + cross(twist.angular, p_LS_W), gps.velocity_horizontal_noise,
                            gps.velocity_vertical_noise, query, 3);
    if (query.model.spherical) {
        const Geodetic position = world_to_geodetic(*query.model.spherical, reading.p_W);
        reading.geodetic = true;
        reading.latitude_rad = position.latitude_rad;
        reading.longitude_rad = position.longitude_rad;
        reading.altitude_m = position.altitude_m;
    }
    return reading;
}

}  // namespace roboss
