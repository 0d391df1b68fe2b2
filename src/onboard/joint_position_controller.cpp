// See onboard_kinds/joint_position_controller.h.
#include "onboard/controllers.h"
#include "onboard/pid.h"

namespace roboss {

void run(const JointPositionControllerSpec& spec, OnboardContext& c) {
    const double target = joint_target(spec.use_actuator_msg, spec.actuator_number, spec.initial_position, c);
    const double error = c.position(0) - target;
    if (spec.use_velocity_commands) {
        const double fastest = std::fabs(spec.pid.cmd_max);
        const double velocity = std::clamp(-error / c.dt(), -fastest, fastest);
        for (std::size_t j = 0; j < c.joint_count(); ++j) c.drive(j, MotorMode::kVelocity, velocity);
        return;
    }
    PidGains gains = spec.pid;
    if (gains.cmd_max == JointPositionControllerSpec::kUnwritten) gains.cmd_max = 1000;
    const double effort = update_pid(gains, error, c.dt(), {c.memory(), 0});
    for (std::size_t j = 0; j < c.joint_count(); ++j) c.push_joint(j, effort);
}

}  // namespace roboss
