// See joint_rows.h; here what is only done for one robot at a time: loops and couplings.
#include "physics/dynamics/joint_rows.h"

#include <cmath>
#include <limits>

#include "model/coordinates.h"
#include "model/loop_closure.h"
#include "physics/dynamics/drag.h"
#include "physics/dynamics/fluid_forces.h"
#include "world/joint_type.h"

namespace roboss {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

JointStates<double> joint_states(const RobotWork& robot) {
    return {robot.state->q, robot.state->v, robot.state->motors, robot.type->dofs};
}

/// Adds a row over the degrees of freedom that move B of the loop joint against A.
class LoopRowWriter {
  public:
    LoopRowWriter(const RobotWork& robot, const LoopJoint& loop, int offset, IslandRows& rows)
        : robot_(robot), loop_(loop), offset_(offset), rows_(rows) {}

    void add(const BoundedRow& bounded, const Spatial& wrench, bool soft, MotorSetpoint* motor = nullptr) {
        CouplingRow row;
        static_cast<BoundedRow&>(row) = bounded;
        row.motor = motor, row.soft = soft;
        row.robot = robot_.id, row.wrench = wrench;
        row.loop = static_cast<int>(&loop_ - robot_.type->loops.data());
        row.first = rows_.coupling_columns.size();
        visit_between(*robot_.type, loop_.body_a, loop_.body_b, [&](std::size_t k, double sign) {
            rows_.coupling_columns.push_back(
                {offset_ + static_cast<int>(k), sign * dot(robot_.axes[k], wrench)});
        });
        row.last = rows_.coupling_columns.size();
        rows_.couplings.push_back(row);
    }

    double rate(const Spatial& wrench) const {
        double sum = 0;
        visit_between(*robot_.type, loop_.body_a, loop_.body_b, [&](std::size_t k, double sign) {
            sum += sign * dot(robot_.axes[k], wrench) * robot_.state->v[k];
        });
        return sum;
    }

  private:
    const RobotWork& robot_;
    const LoopJoint& loop_;
    int offset_;
    IslandRows& rows_;
};

/// The angle nearest to `aim`: without limits any number of turns is the same.
double near(double angle, double aim, bool turns_alone, const Dof& dof) {
    if (!turns_alone || std::isfinite(dof.lower) || std::isfinite(dof.upper)) return angle;
    return aim + wrap_angle(angle - aim);
}

/// Damping and spring of a loop joint's axis, taken implicitly; those of the tree are in the mass matrix.
void add_spring(const AxisState& axis, double q, const Spatial& wrench, LoopRowWriter& writer) {
    const double damping = axis.dt * axis.dof.spring_stiffness + axis.dof.damping;
    if (!(damping > 0)) return;
    BoundedRow row;
    row.target = row.position_target = -axis.dof.spring_stiffness * (q - axis.dof.spring_reference) / damping;
    row.compliance = 1.0 / (axis.dt * damping);
    row.low = -kInfinity, row.high = kInfinity;
    writer.add(row, wrench, row.compliance > axis.dof.inverse_inertia);
}

/// Everything that acts along the free directions of a loop joint. Returns true if something is to be
/// corrected.
bool add_loop_axes(const Model& model, const RobotWork& robot, const LoopJoint& loop, int offset,
                   std::vector<BoundedRow>& buffer, IslandRows& rows) {
    const auto placed = [&](int b) {
        if (b < 0) {
            const std::vector<double>& q = robot.state->q;
            return Transform{to_matrix(Quat{q[3], q[4], q[5], q[6]}), {}};
        }
        const Transform& X_WB = robot.bodies[static_cast<std::size_t>(b)].X_WB;
        return Transform{X_WB.R, X_WB.p - robot.origin};
    };
    LoopRowWriter writer(robot, loop, offset, rows);
    const FreeDirections free = free_directions(loop, placed(loop.body_a), placed(loop.body_b));
    const JointType& type = joint_type(loop.kind);
    const bool one_hinge = type.count(JointKind::kRevolute) == 1;
    Lockstep<double> alone;
    bool corrects = false;
    for (std::size_t k = 0; k < free.count; ++k) {
        const FreeDirection& direction = free.directions[k];
        const Dof& dof = loop.dofs[k];
        const bool turns_alone = one_hinge && type.motions[k] == JointKind::kRevolute;
        MotorSetpoint& motor = robot.state->motors[static_cast<std::size_t>(loop.motor_index) + k];
        const AxisState axis{dof,
                             motor,
                             near(direction.position, motor.target, turns_alone, dof),
                             writer.rate(direction.wrench),
                             model.dt_s,
                             model.accuracy.compliance * dof.inverse_inertia,
                             !type.is_isotropic()};
        buffer.clear();
        corrects |= add_axis_rows(axis, alone, buffer);
        for (std::size_t r = 0; r < buffer.size(); ++r)
            writer.add(buffer[r], direction.wrench, buffer[r].compliance > axis.dof.inverse_inertia,
                       r == 0 && has_hard_motor(axis) ? &motor : nullptr);
        add_spring(axis, near(direction.position, dof.spring_reference, turns_alone, dof), direction.wrench,
                   writer);
    }
    return corrects;
}

/// True if the free directions of a loop joint are not all left to themselves.
bool needs_rows(const LoopJoint& loop, const RobotState& state) {
    for (std::size_t d = 0; d < loop.dofs.size(); ++d) {
        const Dof& dof = loop.dofs[d];
        if (!is_switched_off(state.motors[static_cast<std::size_t>(loop.motor_index) + d])) return true;
        if (dof.friction > 0 || dof.damping > 0 || dof.spring_stiffness > 0) return true;
        if (std::isfinite(dof.lower) || std::isfinite(dof.upper)) return true;
    }
    return false;
}

/// Loops, gearboxes and mimic joints hold in the middle between the velocities before and after the tick:
/// then what they push does no work (as in the leapfrog and SHAKE methods). What is left of an error is taken
/// out of the coordinates after the tick.
void add_equality_rows(const Model& model, RobotId robot, const Equalities& equalities, int offset,
                       IslandRows& rows) {
    for (const EqualityRow& equality : equalities.rows) {
        if (!(equality.mobility > 0)) continue;
        CouplingRow row;
        row.target = row.position_target = -0.5 * model.dt_s * equality.curvature;
        row.compliance = model.accuracy.compliance * equality.mobility;
        row.low = -kInfinity, row.high = kInfinity;
        row.equality = true;
        row.robot = robot, row.loop = equality.loop, row.wrench = equality.wrench;
        row.first = rows.coupling_columns.size();
        for (std::size_t c = equality.first; c < equality.last; ++c)
            rows.coupling_columns.push_back({offset + equalities.columns[c].dof, equalities.columns[c].j});
        row.last = rows.coupling_columns.size();
        rows.couplings.push_back(row);
    }
}

}  // namespace

bool add_joint_rows(const Model& model, const RobotWork& robot, int offset, RowBuffer& buffer,
                    IslandRows& rows) {
    const RobotType& type = *robot.type;
    Lockstep<double> alone;
    bool corrects = add_tree_rows(model, type, joint_states(robot), offset, alone, rows.joints);
    if (!type.has_equalities()) return corrects;
    gather_equalities(robot, robot.state->q, buffer.equalities);
    add_equality_rows(model, robot.id, buffer.equalities, offset, rows);
    for (const LoopJoint& loop : type.loops)
        corrects |= add_loop_axes(model, robot, loop, offset, buffer.axis, rows);
    return corrects;
}

bool moves_freely(const Model& model, const RobotWork& robot) {
    const RobotType& type = *robot.type;
    if (robot.bonded) return false;
    for (const LoopJoint& loop : type.loops)
        if (needs_rows(loop, *robot.state)) return false;
    if (drag_is_stiff(model, robot) || (type.feels_flow && flow_is_stiff(model, robot))) return false;
    for (std::size_t d = 0; d < type.dofs.size(); ++d)
        if (is_stiff(robot.type->dofs[d], model.dt_s) ||
            !is_left_alone(tree_axis(model, type, joint_states(robot), d)))
            return false;
    return true;
}

}  // namespace roboss
