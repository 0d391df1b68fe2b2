// Rows of one axis of a joint, whether it is a degree of freedom of the tree or a free direction of a loop
// joint: motor, joint friction, limits.
#pragma once

#include <vector>

#include "physics/equality.h"
#include "physics/rows.h"

namespace roboss {

/// What add_joint_rows overwrites from robot to robot.
struct RowBuffer {
    Equalities equalities;
    std::vector<BoundedRow> axis;
};

/// Everything about one axis that its rows need.
struct AxisState {
    const Dof& dof;
    const MotorSetpoint& motor;
    double q = 0, v = 0, dt = 0;
    double compliance = 0;  // of a hard row
    bool has_position = true;
};

/// Rows of the axis, appended. Returns true if a hard limit is violated and so has something to mend.
bool add_axis_rows(const AxisState& axis, std::vector<BoundedRow>& rows);

/// True if the axis' motor is hard, one without gains: its row, the first, starts from the motor's load.
bool has_hard_motor(const AxisState& axis);

/// True if no row acts on the axis and none will in this tick.
bool is_left_alone(const AxisState& axis);

/// Springs or damping so stiff that the explicit Runge-Kutta step would not follow them.
bool is_stiff(const Dof& dof, double dt);

}  // namespace roboss
