// The rows of a contact island: everything that pushes besides inertia and explicit forces, in one form each.
#pragma once

#include <span>
#include <vector>

#include "physics/contact.h"

namespace roboss {

/// One direction with a bounded impulse: clamp((target - u) / compliance, low, high).
struct BoundedRow {
    double target = 0;           // for the velocity
    double position_target = 0;  // for the way of this tick, where what is violated is mended without speed
    double compliance = 1, low = 0, high = 0;
    double stiffness = 1;  // 1 / compliance, set by the solver
    double u = 0, du = 0;  // velocity along it; per unit step of the line search
    double impulse = 0;
    double d = 0;                          // minus the derivative of the impulse by the velocity
    double d_held = 0;                     // of it, what the Hessian holds
    double slack_low = 0, slack_high = 0;  // multipliers of the bounds (interior point), and their steps
    double slack_low_step = 0, slack_high_step = 0;
};

/// Friction in a plane: impulse = (target - u) / compliance, cut to the disc of radius `bound` = coefficient
/// * normal impulse (isotropic Coulomb).
struct FrictionDisc {
    double coefficient = 0, bound = 0, compliance = 1;
    double stiffness = 1;  // 1 / compliance, set by the solver
    double target_1 = 0, target_2 = 0;
    double u_1 = 0, u_2 = 0, du_1 = 0, du_2 = 0;  // velocity minus target; per unit step of the line search
    double impulse_1 = 0, impulse_2 = 0;
    double d_11 = 0, d_12 = 0, d_22 = 0;           // minus the derivative of the impulses by the velocity
    double d_1n = 0, d_2n = 0;                     // by the normal velocity, where the bound moves with it
    double held_11 = 0, held_12 = 0, held_22 = 0;  // what the Hessian holds
    double slack = 0, slack_step = 0;              // multiplier of the bound (interior point)
    double bound_error = 0,
           relaxation = 1;  // of the last update of the bound: what it lacked, the share given
};

/// Motor, joint friction or limit: a row on one degree of freedom.
struct JointRow : BoundedRow {
    int dof = 0;                     // in the contact island
    MotorSetpoint* motor = nullptr;  // that remembers its load
};

/// One entry of a coupling row's Jacobian.
struct CouplingColumn {
    int dof = 0;  // in the contact island
    double j = 0;
};

/// A row over several degrees of freedom of one robot (gearbox, mimic, closed loop): u = sum of j * v.
struct CouplingRow : BoundedRow {
    std::size_t first = 0, last = 0;  // columns
    MotorSetpoint* motor = nullptr;   // that remembers its load
    RobotId robot;
    int loop = -1;   // in RobotType::loops, if it is of one
    Spatial wrench;  // of a loop: on its body B about the robot's origin, per unit of impulse
};

/// Columns of the contacts' Jacobians: velocity of A against B at the point, along (normal, tangent 1,
/// tangent 2), per unit of one degree of freedom; in an AngularRow: angular velocity. Those of one contact
/// ascend along A's path, then along B's.
struct ContactColumns {
    std::vector<int> dof;  // in the contact island
    std::vector<double> n, t1, t2;

    std::size_t size() const { return count_; }
    /// Adds columns, not set yet. The arrays only ever grow, so that in the long run nothing is filled twice.
    void extend(std::size_t more) {
        count_ += more;
        if (count_ <= dof.size()) return;
        const std::size_t room = 2 * count_;
        dof.resize(room), n.resize(room), t1.resize(room), t2.resize(room);
    }
    void clear() { count_ = 0; }
    /// Columns from `middle` on into those of [first, middle), ascending, one a degree of freedom: a robot in
    /// contact with itself.
    void merge(std::size_t first, std::size_t middle);

  private:
    std::size_t count_ = 0;
};

/// A contact point: normal (low 0, no high) and friction at the point.
struct ContactRow {
    std::size_t first = 0, last = 0;  // columns
    BoundedRow normal;
    FrictionDisc slip;
    double load_max = 0;  // of its normal impulse, what may count as a load and not as a blow
    bool soft = false;    // a spring and damper
    bool sticks = false;  // it carried a load in the last tick and did not slide: it probably will not now
    double ease = 1;      // 1/kg: mobility that its compliances are relative to
};

/// Torsional friction about the normal and rolling friction about the tangents, bounded by the normal impulse
/// of a contact of the same island.
struct AngularRow {
    std::size_t first = 0, last = 0;  // contact columns
    std::size_t contact = 0;          // index of the ContactRow whose normal impulse bounds it
    double torsional = 0;             // m: torque per normal force
    BoundedRow spin;
    double spin_error = 0, spin_relaxation = 1;  // as FrictionDisc::bound_error and relaxation
    FrictionDisc roll;                           // coefficient in m
};

/// All rows of one contact island.
struct IslandRows {
    std::vector<JointRow> joints;
    std::vector<CouplingColumn> coupling_columns;
    std::vector<CouplingRow> couplings;
    ContactColumns columns;
    std::vector<ContactRow> contacts;
    std::vector<AngularRow> angulars;

    void clear() {
        joints.clear(), coupling_columns.clear(), couplings.clear();
        columns.clear(), contacts.clear(), angulars.clear();
    }
};

struct RowBuffer;

/// Motors, joint friction, limits, loops and couplings of one robot; `offset` is its first dof in the contact
/// island, `buffer` is overwritten. Returns true if a row has something to mend.
bool add_joint_rows(const Model& model, const RobotWork& robot, int offset, RowBuffer& buffer,
                    IslandRows& rows);

/// True if add_joint_rows would add nothing but loops and couplings, and no spring or damping is stiff: the
/// robot moves smoothly when nothing touches it.
bool moves_freely(const Model& model, const RobotWork& robot);

/// Normal and tangents of a contact's row. Across the friction axis the tangent is shortened to the share of
/// friction there: in these coordinates the ellipse of friction impulses is a disc, and what the solver finds
/// in the disc (most dissipation) is what Coulomb's law says of the ellipse.
struct ContactFrame {
    Vec3 n, t1, t2;
};
ContactFrame frame_of(const Contact& contact);

/// Rows of one contact; offsets[i] is the first dof of robots[i] in the contact island. Returns true if the
/// way of this tick needs another target than the velocity (penetration to mend, an impact inside the tick).
bool add_contact_row(const Model& model, const Contact& contact, std::span<const RobotWork> robots,
                     std::span<const int> offsets, IslandRows& rows);

/// The row of torsional and rolling friction at the contact added last, if it has any.
void add_angular_row(const Model& model, const Contact& contact, std::span<const RobotWork> robots,
                     std::span<const int> offsets, IslandRows& rows);

}  // namespace roboss
