// The force-torque sensor: the reaction of its joint in the tick that begins at the observed states, which
// the probe steps.
#include "physics/dynamics/kinematics.h"
#include "sensors/joint_reaction.h"
#include "sensors/readings.h"
#include "sensors/sensor_noise.h"

namespace roboss {
namespace {

/// Axes in which the reading is given, in the world.
Mat3 axes_of(const ForceTorqueSpec& sensor, const SensorQuery& query, const Transform& X_WS) {
    if (sensor.frame == "sensor") return X_WS.R;
    const Link& child = query.type().links[query.info().link.index()];
    if (sensor.frame == "child" || child.parent < 0)
        return sensor.frame == "child" ? link_pose(query.type(), query.state, query.info().link).R
                                       : Mat3::identity();
    return link_pose(query.type(), query.state, LinkId(static_cast<std::size_t>(child.parent))).R;
}

}  // namespace

Result<ForceTorqueReading> read(const ForceTorqueSpec& sensor, const SensorQuery& query) {
    const std::vector<JointReaction> all = query.sources.step_probe().joint_reactions(query.robot);
    const JointReaction* const reaction = find_reaction(all, query.type(), sensor.joint);
    if (reaction == nullptr)
        return Error{"sensor '" + query.info().spec.name + "' measures the joint '" + sensor.joint +
                         "', which bears nothing",
                     "put it in a joint between two links of one robot"};
    const Transform X_WS = sensor_pose(query);
    const double sign = sensor.measure_direction == "child_to_parent" ? -1.0 : 1.0;
    Vec3 force = reaction->force * sign, torque = reaction->torque * sign;
    if (sensor.frame == "sensor") torque -= cross(X_WS.p - reaction->origin_W, force);
    const Mat3 R = axes_of(sensor, query, X_WS);
    force = transpose_times(R, force), torque = transpose_times(R, torque);
    return ForceTorqueReading{
        {noisy_value(force.x, sensor.force_x, query, 0, 0), noisy_value(force.y, sensor.force_y, query, 1, 1),
         noisy_value(force.z, sensor.force_z, query, 2, 2)},
        {noisy_value(torque.x, sensor.torque_x, query, 3, 3),
         noisy_value(torque.y, sensor.torque_y, query, 4, 4),
         noisy_value(torque.z, sensor.torque_z, query, 5, 5)},
        0};
}

}  // namespace roboss
