// The rows of a robot's joints: those of the tree's axes on one degree of freedom each (over T: see rows.h);
// loops, gearboxes, mimic joints and the axes of loop joints over several.
#pragma once

#include "model/joint_motion.h"
#include "physics/dynamics/axis_rows.h"
#include "physics/dynamics/equality.h"

namespace roboss {

/// What add_joint_rows overwrites from robot to robot.
struct RowBuffer {
    Equalities equalities;
    std::vector<BoundedRow> axis;  // of a loop joint
};

/// Coordinates, velocities and motors of a robot, or of a few in lanes.
template <class T>
struct JointStates {
    std::span<const T> q, v;
    std::span<MotorSetpointT<T>> motors;
    std::span<const Dof> dofs;  // of the tree (Mechanics::dofs)
};

/// One degree of freedom of the tree.
template <class T>
AxisStateT<T> tree_axis(const Model& model, const RobotType& type, const JointStates<T>& state,
                        std::size_t d) {
    const Dof& dof = state.dofs[d];
    const Body& body = type.bodies[static_cast<std::size_t>(dof.body)];
    const bool has_position = joint_traits(body.joint).has_positions();
    return {dof,
            state.motors[d],
            has_position ? state.q[static_cast<std::size_t>(body.q_index)] : T(0),
            state.v[d + static_cast<std::size_t>(type.base_nv())],
            model.dt_s,
            hard_compliance<T>(model.accuracy) * dof.inverse_inertia,
            has_position};
}

/// Motors, joint friction and limits of the tree. True if a row has something to mend.
template <class T>
MaskOf<T> add_tree_rows(const Model& model, const RobotType& type, const JointStates<T>& state, int offset,
                        Lockstep<T>& together, std::vector<JointRowT<T>>& rows) {
    MaskOf<T> corrects = false;
    for (std::size_t d = 0; d < type.dofs.size(); ++d) {
        const std::size_t first = rows.size();
        const AxisStateT<T> axis = tree_axis(model, type, state, d);
        corrects = corrects | add_axis_rows(axis, together, rows);
        for (std::size_t r = first; r < rows.size(); ++r) {
            JointRowT<T>& row = rows[r];
            row.dof = offset + type.base_nv() + static_cast<int>(d);
            if (r == first && has_hard_motor(axis)) row.motor = &state.motors[d];
            if (kIsFloat<T> && !(r == first && axis.motor.mode == MotorMode::kVelocity))
                row.target -= axis.v, row.position_target -= axis.v;  // relative, as a velocity motor's is
        }
    }
    return corrects;
}

/// Motors, joint friction, limits, loops and couplings of one robot; `offset` is its first dof in the contact
/// island, `buffer` is overwritten. Returns true if a row has something to mend.
bool add_joint_rows(const Model& model, const RobotWork& robot, int offset, RowBuffer& buffer,
                    IslandRows& rows);

/// True if add_joint_rows would add nothing but loops and couplings, no spring or damping is stiff, and no
/// bond joins it to anything: the robot moves smoothly when nothing touches it.
bool moves_freely(const Model& model, const RobotWork& robot);

}  // namespace roboss
