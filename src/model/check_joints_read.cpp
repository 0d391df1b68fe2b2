// What only the compiled parts show about sensors that read joints: each connected part of a model is a robot
// of its own, and a sensor reads its own robot.
#include "model/compile_type.h"

namespace roboss {

void check_joints_read(const RobotType& type, const std::string& robot, Diagnostics& diagnostics) {
    for (const SensorInfo& sensor : type.sensors) {
        for (const std::string& name : joints_read(sensor.spec)) {
            const std::string reads = "sensor '" + sensor.spec.name + "' of robot '" + robot +
                                      "' reads the joint '" + name + "', which ";
            const std::optional<JointId> joint = type.find_joint(name);
            if (!joint)
                diagnostics.error(
                    sensor.spec.where, "joint-of-another-part",
                    reads + "is in another part of the model; no joint connects the two parts",
                    "Put the sensor on a link that this joint moves or carries, or connect the parts.");
            else if (type.joints[joint->index()].nv != 1)
                diagnostics.error(sensor.spec.where, "bad-sensor",
                                  reads + "cannot move: other joints hold its two links",
                                  "Let it read a joint with one axis that can move.");
        }
    }
}

}  // namespace roboss
