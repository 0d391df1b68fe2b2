// The rows of a contact island: everything that pushes besides inertia and explicit forces, in one form each.
#pragma once

#include <vector>

#include "physics/contact.h"

namespace roboss {

/// A bounded row on one degree of freedom (motor, joint friction, limit): impulse = clamp((target - v) /
/// compliance, low, high).
struct JointRow {
    int dof = 0;  // in the contact island
    double target = 0, compliance = 1, low = 0, high = 0;
    double mend =
        0;  // added to the target for the way of this tick: a violated limit is mended without speed
    double impulse = 0;
    double d = 0;                          // minus the derivative of the impulse by the velocity
    double slack_low = 0, slack_high = 0;  // multipliers of the bounds (interior point), and their steps
    double slack_low_step = 0, slack_high_step = 0;
};

/// One column of a contact's Jacobian: velocity of A against B at the point, along (normal, tangent 1,
/// tangent 2), per unit of one degree of freedom.
struct ContactColumn {
    int dof = 0;
    double n = 0, t1 = 0, t2 = 0;
};

/// A contact point as rows. Normal: impulse = max(0, (target - u_n) / compliance). Friction: impulse = -u_t /
/// compliance_t, cut to the disc of radius `bound` = mu * normal impulse (isotropic Coulomb).
struct ContactRow {
    std::size_t first = 0, last = 0;  // columns
    double target = 0;                // for the velocity
    double position_target = 0;       // for the way of this tick
    double compliance_n = 1, compliance_t = 1;
    double mu = 0, bound = 0;
    double u_n = 0, u_t1 = 0, u_t2 = 0;  // velocity at the point
    double impulse_n = 0, impulse_t1 = 0, impulse_t2 = 0;
    double du_n = 0, du_t1 = 0, du_t2 = 0;         // per unit step of the line search
    double d_n = 0, d_11 = 0, d_12 = 0, d_22 = 0;  // minus the derivative of the impulses by the velocity
    double slack_n = 0, slack_t = 0;  // multipliers of the bounds (interior point), and their steps
    double slack_n_step = 0, slack_t_step = 0;
    double bound_error = 0,
           relaxation = 1;  // of the last update of the bound: what it lacked, the share that was given
};

/// Motors, joint friction, limits of one robot; `offset` is its first dof in the contact island. Returns true
/// if a row has something to mend.
bool add_joint_rows(const Model& model, const RobotWork& robot, int offset, std::vector<JointRow>& rows);

/// True if add_joint_rows would add nothing and no spring or damping is stiff: the robot moves smoothly when
/// nothing touches it.
bool moves_freely(const Model& model, const RobotWork& robot);

/// Rows of one contact; offsets[i] is the first dof of robots[i] in the contact island. Returns true if the
/// way of this tick needs another target than the velocity (penetration to mend, an impact inside the tick).
bool add_contact_row(const Model& model, const Contact& contact, std::span<const RobotWork> robots,
                     std::span<const int> offsets, std::vector<ContactColumn>& columns,
                     std::vector<ContactRow>& rows);

}  // namespace roboss
