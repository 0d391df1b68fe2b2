// The gyrocompass: orientation, turning rate, and the heading against true north at the sensor's own place
// (the meridians of a wide world are not parallel). Its noise (rad) turns the reading about the vertical;
// heading and orientation agree.
#include "core/check.h"
#include "core/float_env.h"
#include "physics/kinematics.h"
#include "sensors/geodesy.h"
#include "sensors/readings.h"
#include "sensors/sensor_noise.h"

namespace roboss {
namespace {

/// Clockwise from north, seen from above, 0 .. 2 pi. An axis that points straight up or down has heading 0.
double heading_of(const Model& model, const Transform& X_WS, const Mat3& R_WS) {
    Vec3 ahead = R_WS.col(0);
    if (model.spherical) {
        const Geodetic place = world_to_geodetic(*model.spherical, X_WS.p);
        ahead = transpose_times(east_north_up(place.latitude_rad, place.longitude_rad),
                                world_to_earth(*model.spherical) * ahead);
    }
    const double heading = fixed_atan2(ahead.x, ahead.y);
    return heading < 0.0 ? heading + 2.0 * kPi : heading;
}

}  // namespace

CompassReading read_compass(const Model& model, RobotId robot, std::size_t sensor, const RobotState& state,
                            Tick tick, std::uint64_t seed) {
    const ExactFloatScope exact;
    const RobotType& type = model.type_of(robot);
    ROBOSS_CHECK(sensor < type.sensors.size(), type.name + " has no sensor number " + std::to_string(sensor));
    const SensorInfo& info = type.sensors[sensor];
    ROBOSS_CHECK(info.spec.kind == SensorKind::kCompass, info.spec.name + " is no gyrocompass");
    const Transform X_WS = link_pose(type, state, info.link) * to_transform(info.spec.X_LS);
    const double error = noisy_value(0.0, info.spec.noise, {seed, robot, sensor, tick}, 0, 0);

    CompassReading reading;
    reading.tick = tick;
    reading.q_WS = axis_angle({0, 0, 1}, -error) * to_quat(X_WS.R);
    const SensorMoment moment{seed, robot, sensor, tick};
    const Vec3 rate = transpose_times(X_WS.R, link_twist(type, state, info.link).angular);
    for (std::size_t axis = 0; axis < 3; ++axis)  // channel and index 0 are those of the angle
        reading.angular_velocity_S[axis] =
            noisy_value(rate[axis], info.spec.gyro_noise, moment, 1 + axis, 1 + axis);
    reading.magnetic_field_S = transpose_times(X_WS.R, model.magnetic_field_T);
    reading.heading_rad = heading_of(model, X_WS, to_matrix(reading.q_WS));
    return reading;
}

}  // namespace roboss
