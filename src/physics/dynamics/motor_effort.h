// What a motor gave in the last tick.
#pragma once

#include <algorithm>
#include <vector>

#include "model/model.h"
#include "physics/dynamics/axis_rows.h"
#include "physics/dynamics/kinematics.h"

namespace roboss {

/// N m or N, of one axis of a joint. A hard motor's is in the state. That of a motor with gains, or that
/// gives an effort, follows from where its axis is at the end of the tick: these motors are rows whose force
/// is a function of that (axis_rows.h). So it is that of an order which came since, if there is one. With
/// `precision` float, that of a servo at its maximum velocity is only known within what it has to give.
inline double motor_effort(const Model& model, const RobotType& type, const RobotState& state, JointId id,
                           int axis = 0) {
    const Joint& joint = type.joints[id.index()];
    const MotorSetpoint& motor = state.motors[type.motor_index(joint, axis)];
    const Dof& dof = dof_of(type, state, joint, axis);
    const JointState at = joint_state(type, state, id, axis);
    const double begin = at.position - model.dt_s * at.velocity;
    const AxisState now{dof,         motor,      begin,
                        at.velocity, model.dt_s, model.accuracy.compliance * dof.inverse_inertia};
    if (has_hard_motor(now)) return motor.impulse / model.dt_s;
    std::vector<BoundedRow> rows;
    add_motor(now, rows);
    double impulse = 0;
    for (const BoundedRow& row : rows)
        impulse += std::clamp((row.target - at.velocity) / row.compliance, row.low, row.high);
    return impulse / model.dt_s;
}

}  // namespace roboss
