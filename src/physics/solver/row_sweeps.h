// Gauss-Seidel sweeps over the rows of robots with joints: where Newton's method starts. Each row gets the
// impulse that it needs if the others keep theirs, cut to its bounds, one row after the other. Sweeps are
// accelerated as by nonlinear conjugate gradients; lanes/lane_pair_sweeps.h has the same for free bodies.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "physics/solver/newton.h"

namespace roboss {

class RowSweeps {
  public:
    using Problem = SolveProblem<double>;

    /// Impulses of a contact: normal, friction along both tangents.
    struct ContactImpulse {
        double n = 0, t1 = 0, t2 = 0;
    };

    /// At most `most` sweeps, fewer if they converge, from the impulses that the contacts carried last (the
    /// normals hold them), or that all rows hold if they are solved again. `v` ends as the velocities with
    /// the impulses found. Torsional and rolling friction take no part.
    void run(const Problem& p, int most, std::vector<double>& v);
    /// Continues from there until they converge ten times closer.
    void go_on(const Problem& p, int most, std::vector<double>& v);

    /// Starts again from the impulses that the rows hold now, and sweeps.
    void take_up(const Problem& p, int most, std::vector<double>& v);

    /// Impulses found, by row.
    double joint(std::size_t row) const { return impulses_[row]; }
    double coupling(std::size_t row) const { return impulses_[joints_ + row]; }
    const ContactImpulse& contact(std::size_t row) const { return contact_impulses_[row]; }

  private:
    /// A robot that rows act on. Its numbers stand together, an even number of them.
    struct Side {
        std::size_t robot = 0;
        std::size_t velocity = 0, count = 0;  // in v_
        std::size_t jacobian = 0;             // in numbers_: J, one vector after the other, then M^-1 J^T
    };
    struct Sides {
        Side a, b;  // b: none if its count is 0
    };
    /// A joint row or a coupling.
    struct Scalar {
        Sides sides;
        std::size_t unknown = 0;  // in v_, of a joint row
        double mass = 0;          // effective
    };
    struct Contact {
        Sides sides;
        double mass_n = 0, mass_t = 0;  // effective
        double t1_n = 0, t2_n = 0;      // tangential velocities per unit of normal impulse
    };

    void start(const Problem& p, std::size_t n);
    void sweep_all(const Problem& p, int most, std::vector<double>& v);
    void start_scalars(const Problem& p, bool again);
    void start_contacts(const Problem& p, bool again);
    void add_joint(const Problem& p, const JointRow& row);
    void add_coupling(const Problem& p, const CouplingRow& row);
    void add_contact(const Problem& p, const ContactRow& row);
    const Side& side_of(int dof, std::size_t vectors, Sides& sides);
    void respond(const Problem& p, const Sides& sides, std::size_t vectors);
    double velocity(const Sides& sides, std::size_t vector) const;
    double product(const Sides& sides, std::size_t vector, std::size_t other) const;
    double sweep(const Problem& p);
    double sweep_scalar(const BoundedRow& row, std::size_t at, double u);
    double sweep_contact(const ContactRow& row, std::size_t at);
    double squared_impulses() const;
    void accelerate(double share);
    void push(const Sides& sides, std::size_t vectors, std::size_t vector, double impulse);

    double converged_ = 0;  // squared change, relative to the squared impulses
    std::size_t joints_ = 0;
    std::vector<double> factors_;            // of all mass matrices, as tree_factor leaves them
    std::vector<std::size_t> factor_first_;  // by robot
    std::vector<std::size_t> robot_of_;      // by unknown of the problem
    std::vector<std::size_t> place_;         // by robot, and the end: in v_
    std::vector<Scalar> scalars_;            // joint rows, then couplings
    std::vector<Contact> contacts_;
    std::vector<double> numbers_;
    std::vector<double> v_free_;                      // without rows
    std::vector<double> v_, v_before_, v_direction_;  // now; before the last sweep; search direction
    std::vector<double> impulses_, impulses_before_, directions_;  // likewise, of scalars_
    std::vector<ContactImpulse> contact_impulses_, contacts_before_, contact_directions_;
};

}  // namespace roboss
