// What a motor gave in the last tick.
#pragma once

#include <algorithm>

#include "model/robot_state.h"

namespace roboss {

/// N m or N. The state of a robot that no row acts on has no impulses: only motors that give an effort may
/// drive such a robot.
inline double motor_effort(const MotorSetpoint& motor, double dt_s) {
    if (motor.mode == MotorMode::kEffort)
        return std::clamp(motor.target, -motor.max_effort, motor.max_effort);
    return motor.impulse / dt_s;
}

}  // namespace roboss
