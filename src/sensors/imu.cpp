// The IMU. The acceleration is the change of the sensor's velocity over the tick that begins at the observed
// states, which the probe steps: a state holds velocities but no accelerations, and a Client does not see
// every tick.
#include "physics/dynamics/kinematics.h"
#include "physics/probe.h"
#include "sensors/imu_frame.h"
#include "sensors/readings.h"
#include "sensors/sensor_noise.h"

namespace roboss {
namespace {

/// Orientation, velocity and turning rate of the sensor frame, world axes.
struct Motion {
    Quat q_WS;
    Vec3 velocity, angular;
};

Motion motion_of(const SensorQuery& query, const RobotState& state) {
    const SensorInfo& info = query.info();
    const Transform X_WL = link_pose(query.type(), state, info.link);
    const Twist twist = link_twist(query.type(), state, info.link);
    return {to_quat(X_WL.R) * info.spec.X_LS.q,
            twist.linear + cross(twist.angular, X_WL.R * info.spec.X_LS.p), twist.angular};
}

/// Half way from a to b.
Quat middle(const Quat& a, const Quat& b) {
    const double sign = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z < 0.0 ? -1.0 : 1.0;
    return normalized(Quat{a.w + sign * b.w, a.x + sign * b.x, a.y + sign * b.y, a.z + sign * b.z});
}

}  // namespace

Result<ImuReading> read(const ImuSpec& imu, const SensorQuery& query) {
    const Motion before = motion_of(query, query.state);
    const Motion after = motion_of(query, query.sources.step_probe().state_after(query.robot));
    const Vec3 acceleration = (after.velocity - before.velocity) / query.model.dt_s;
    // The mean over the tick, in the axes of its middle: right to second order in the step while the sensor
    // turns.
    const Vec3 gravity = gravity_of(query.model, type_of(query.type(), query.state));
    const Vec3 force = rotate(conjugate(middle(before.q_WS, after.q_WS)), acceleration - gravity);
    const Vec3 rate = rotate(conjugate(before.q_WS), before.angular);

    ImuReading reading;
    reading.angular_velocity_S = {noisy_value(rate.x, imu.angular_velocity_x, query, 0, 0),
                                  noisy_value(rate.y, imu.angular_velocity_y, query, 1, 1),
                                  noisy_value(rate.z, imu.angular_velocity_z, query, 2, 2)};
    reading.specific_force_S = {noisy_value(force.x, imu.linear_acceleration_x, query, 3, 3),
                                noisy_value(force.y, imu.linear_acceleration_y, query, 4, 4),
                                noisy_value(force.z, imu.linear_acceleration_z, query, 5, 5)};
    reading.orientation = {0, 0, 0, 0};
    if (!imu.enable_orientation) return reading;
    const Result<Mat3> reference = reference_frame_of(imu, query);
    if (!reference) return reference.error();
    reading.orientation = conjugate(to_quat(reference.value())) * before.q_WS;
    return reading;
}

}  // namespace roboss
