// The odometer: joint encoders, and with a wheel radius the distance and speed that they amount to. Its noise
// is a fraction: mean and bias are an error of the wheel's radius, kept through the run; the draw of each
// tick disturbs the speed only (over many ticks such draws cancel out).
#include "physics/dynamics/kinematics.h"
#include "sensors/readings.h"
#include "sensors/sensor_noise.h"

namespace roboss {
namespace {

/// The joint's position at the start of the run; of a joint that closes a loop from its bodies' poses then.
double start_of(const Model& model, RobotId robot, JointId id) {
    const RobotType& type = model.type_of(robot);
    const Joint& joint = type.joints[id.index()];
    if (joint.loop < 0) return type.initial_q[static_cast<std::size_t>(joint.q_index) - 7];
    return joint_state(type, initial_state(model, robot), id).position;
}

/// The joint that an odometer reads. It may be missing: in a model of several connected parts each part is a
/// robot of its own, with its own joints.
Result<JointId> joint_read(const SensorQuery& query, const std::string& name) {
    const RobotType& type = query.type();
    const std::string sensor = "odometer '" + query.info().spec.name + "' of robot '" +
                               query.model.robots[query.robot.index()].name + "'";
    const std::optional<JointId> id = type.find_joint(name);
    if (!id)
        return Error{sensor + " reads joint '" + name + "', which this robot does not have",
                     "put the odometer on a link that this joint moves or carries"};
    if (type.joints[id->index()].nv != 1)
        return Error{sensor + " reads joint '" + name + "', which does not have one axis",
                     "let it read revolute, continuous, prismatic or screw joints"};
    return *id;
}

}  // namespace

Result<OdometerReading> read(const OdometerSpec& spec, const SensorQuery& query) {
    OdometerReading reading;
    double angle = 0, speed = 0;  // rad, rad/s, summed over the joints
    for (const std::string& name : spec.joints) {
        if (query.type().is_static) {  // nothing of a static model moves
            reading.joint_positions.push_back(0), reading.joint_velocities.push_back(0);
            continue;
        }
        const Result<JointId> id = joint_read(query, name);
        if (!id) return id.error();
        const JointState at = joint_state(query.type(), query.state, id.value());
        reading.joint_positions.push_back(at.position);
        reading.joint_velocities.push_back(at.velocity);
        angle += at.position - start_of(query.model, query.robot, id.value());
        speed += at.velocity;
    }
    if (spec.wheel_radius == 0.0 || spec.joints.empty()) return reading;
    const double metres = spec.wheel_radius / static_cast<double>(spec.joints.size());
    reading.distance = angle * metres * (1.0 + sensor_bias(spec.noise, query, 0));
    reading.speed = speed * metres * noisy_value(1.0, spec.noise, query, 0, 0);
    return reading;
}

}  // namespace roboss
