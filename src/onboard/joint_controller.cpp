// See onboard_kinds/joint_controller.h.
#include "onboard/controllers.h"
#include "onboard/pid.h"

namespace roboss {
namespace {

/// Whether the joint is slower than the target, in the target's direction.
bool is_too_slow(double target, double error) {
    return (target > 0 && error <= 0) || (target < 0 && error >= 0);
}

}  // namespace

double joint_target(bool use_actuator_msg, int actuator, double initial, const OnboardContext& c) {
    if (!c.is_commanded(0)) return initial;
    if (!use_actuator_msg) return c.command(0)[0];
    const std::span<const double> actuators = c.list(0);
    const auto at = static_cast<std::size_t>(actuator);
    return at < actuators.size() ? actuators[at] : initial;
}

void run(const JointControllerSpec& spec, OnboardContext& c) {
    const double target = joint_target(spec.use_actuator_msg, spec.actuator_number, spec.initial_velocity, c);
    if (!spec.use_force_commands) {
        for (std::size_t j = 0; j < c.joint_count(); ++j) c.drive(j, MotorMode::kVelocity, target);
        return;
    }
    const double error = c.velocity(0) - target;
    double effort = update_pid(spec.pid, error, c.dt(), {c.memory(), 0});
    if (spec.disable_braking && !is_too_slow(target, error)) effort = 0;
    for (std::size_t j = 0; j < c.joint_count(); ++j) c.push_joint(j, effort);
}

}  // namespace roboss
