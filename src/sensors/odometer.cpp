// The odometer: joint encoders, and with a wheel radius the way and speed that they amount to. Its noise is a
// fraction of the way: mean and bias are an error of the wheel's radius, kept through the run; the draw of
// each tick disturbs the speed only (over a way of many ticks such draws cancel out).
#include "core/check.h"
#include "core/float_env.h"
#include "physics/kinematics.h"
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

}  // namespace

OdometerReading read_odometer(const Model& model, RobotId robot, std::size_t sensor, const RobotState& state,
                              Tick tick, std::uint64_t seed) {
    const ExactFloatScope exact;
    const RobotType& type = model.type_of(robot);
    ROBOSS_CHECK(sensor < type.sensors.size(), type.name + " has no sensor number " + std::to_string(sensor));
    const SensorSpec& spec = type.sensors[sensor].spec;
    ROBOSS_CHECK(spec.kind == SensorKind::kOdometer, spec.name + " is no odometer");
    OdometerReading reading;
    reading.tick = tick;
    double way = 0, speed = 0;
    for (const std::string& name : spec.joints) {
        const std::optional<JointId> id = type.find_joint(name);
        ROBOSS_CHECK(id.has_value(), spec.name + " reads the unknown joint " + name);
        const Joint& joint = type.joints[id->index()];
        ROBOSS_CHECK(joint.nv == 1, spec.name + " reads joint " + name + ", which has not one axis");
        const JointState at = joint_state(type, state, *id);
        reading.joint_positions.push_back(at.position);
        reading.joint_velocities.push_back(at.velocity);
        way += at.position - start_of(model, robot, *id);
        speed += at.velocity;
    }
    if (spec.wheel_radius == 0.0 || spec.joints.empty()) return reading;
    const double metres = spec.wheel_radius / static_cast<double>(spec.joints.size());
    const SensorMoment moment{seed, robot, sensor, tick};
    reading.distance = way * metres * (1.0 + sensor_bias(spec.noise, moment, 0));
    reading.speed = speed * metres * noisy_value(1.0, spec.noise, moment, 0, 0);
    return reading;
}

}  // namespace roboss
