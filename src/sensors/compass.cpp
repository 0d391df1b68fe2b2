// The gyrocompass: orientation, turning rate, and the heading against true north at the sensor's own position
// (the meridians of a wide world are not parallel). Its noise (rad) turns the reading about the vertical;
// heading and orientation agree.
#include "physics/dynamics/kinematics.h"
#include "sensors/geodesy.h"
#include "sensors/readings.h"
#include "sensors/sensor_noise.h"

namespace roboss {
namespace {

/// Clockwise from north, seen from above, 0 .. 2 pi. An axis that points straight up or down has heading 0.
double heading_of(const Model& model, const Transform& X_WS, const Mat3& R_WS) {
    Vec3 ahead = R_WS.col(0);
    if (model.spherical) {
        const Geodetic position = world_to_geodetic(*model.spherical, X_WS.p);
        ahead = transpose_times(east_north_up(position.latitude_rad, position.longitude_rad),
                                world_to_earth(*model.spherical) * ahead);
    }
    const double heading = fixed_atan2(ahead.x, ahead.y);
    return heading < 0.0 ? heading + 2.0 * kPi : heading;
}

}  // namespace

Result<CompassReading> read(const CompassSpec& compass, const SensorQuery& query) {
    const SensorInfo& info = query.info();
    const Transform X_WS = sensor_pose(query);
    const double error = noisy_value(0.0, compass.noise, query, 0, 0);

    CompassReading reading;
    reading.q_WS = axis_angle({0, 0, 1}, -error) * to_quat(X_WS.R);
    const Vec3 rate = transpose_times(X_WS.R, link_twist(query.type(), query.state, info.link).angular);
    for (std::size_t axis = 0; axis < 3; ++axis)  // channel and index 0 are those of the angle
        reading.angular_velocity_S[axis] =
            noisy_value(rate[axis], compass.gyro_noise, query, 1 + axis, 1 + axis);
    reading.magnetic_field_S = transpose_times(X_WS.R, query.model.magnetic_field_T);
    reading.heading_rad = heading_of(query.model, X_WS, to_matrix(reading.q_WS));
    return reading;
}

}  // namespace roboss
