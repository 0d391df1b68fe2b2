// Positions, velocities and efforts of joints.
#include "physics/dynamics/kinematics.h"
#include "physics/dynamics/motor_effort.h"
#include "sensors/readings.h"

namespace roboss {
namespace {

void add_joint(const SensorQuery& query, JointId id, JointStatesReading& reading) {
    const RobotType& type = query.type();
    const JointState at = joint_state(type, query.state, id);
    reading.positions.push_back(at.position), reading.velocities.push_back(at.velocity);
    reading.efforts.push_back(motor_effort(query.model, type, query.state, id));
}

}  // namespace

Result<JointStatesReading> read(const JointStatesSpec& spec, const SensorQuery& query) {
    const RobotType& type = query.type();
    JointStatesReading reading;
    if (spec.joints.empty())
        for (std::size_t j = 0; j < type.joints.size(); ++j)
            if (type.joints[j].nv > 0) add_joint(query, JointId(j), reading);
    for (const std::string& name : spec.joints) {
        const std::optional<JointId> id = type.find_joint(name);
        if (!id)
            return Error{"sensor '" + query.info().spec.name + "' reads joint '" + name +
                             "', which this robot does not have",
                         "name one of its joints"};
        if (type.joints[id->index()].nv > 0) {
            add_joint(query, *id, reading);
        } else {  // it cannot move
            for (std::vector<double>* values : {&reading.positions, &reading.velocities, &reading.efforts})
                values->push_back(0);
        }
    }
    return reading;
}

}  // namespace roboss
