// The altimeter: heights of the sensor's origin now and in the initial state.
#include "physics/dynamics/kinematics.h"
#include "sensors/readings.h"
#include "sensors/sensor_noise.h"

namespace roboss {

Result<AltimeterReading> read(const AltimeterSpec& altimeter, const SensorQuery& query) {
    const SensorInfo& info = query.info();
    const auto height = [&](const RobotState& state) {
        return (link_pose(query.type(), state, info.link) * info.spec.X_LS.p).z;
    };
    const Transform X_WL = link_pose(query.type(), query.state, info.link);
    const Twist twist = link_twist(query.type(), query.state, info.link);
    const double climb = (twist.linear + cross(twist.angular, X_WL.R * info.spec.X_LS.p)).z;

    AltimeterReading reading;
    reading.reference = height(initial_state(query.model, query.robot));
    reading.vertical_position =
        noisy_value(height(query.state) - reading.reference, altimeter.position_noise, query, 0, 0);
    reading.vertical_velocity = noisy_value(climb, altimeter.velocity_noise, query, 1, 1);
    return reading;
}

}  // namespace roboss
