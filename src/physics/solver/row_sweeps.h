// Gauss-Seidel sweeps over the rows of robots with joints: each row gets the impulse that it needs if the
// others keep theirs, cut to its bounds, one row after the other. They are where Newton's method starts, and
// the solution of large parts that move (SweepPlan). Sweeps are accelerated as by nonlinear conjugate
// gradients; lanes/lane_pair_sweeps.h has the same for free bodies.
//
// Sweeps use mass-weighted velocities y = D^1/2 L v, with L^T D L the mass matrix of a robot (tree_factor).
// The same vectors w = D^-1/2 L^-T J^T then give the velocity along a row, w y, and what its impulse f does
// to y, w f. They have entries on the paths to the links that the row acts on, and nowhere else.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/bodies/sweep_plan.h"
#include "physics/solver/newton.h"

namespace roboss {

/// True where all friction is that of contacts by Coulomb's law: sweeps know nothing of torsional and rolling
/// friction and of wheel slip.
bool sweeps_know_friction(const IslandRows& rows);

class RowSweeps {
  public:
    using Problem = SolveProblem<double>;

    /// Impulses of a contact: normal, friction along both tangents.
    struct ContactImpulse {
        double n = 0, t1 = 0, t2 = 0;
    };

    /// Sweeps from the impulses that the contacts carried last (the normals hold them), or that all rows hold
    /// if they are solved again or for the displacement. Friction bounds follow the normal impulses, but for
    /// the displacement. `v` ends as the velocities with the impulses found. Torsional and rolling friction
    /// take no part.
    SweepReport run(const Problem& p, const SweepPlan& plan, std::vector<double>& v);
    /// Continues from there until they converge ten times closer.
    void go_on(const Problem& p, int most, std::vector<double>& v);
    /// Starts again from the impulses that the rows hold now, and sweeps.
    void take_up(const Problem& p, int most, std::vector<double>& v);

    /// Impulses found, by row.
    double joint(std::size_t row) const { return scalars_[row].now; }
    double coupling(std::size_t row) const { return scalars_[joints_ + row].now; }
    const ContactImpulse& contact(std::size_t row) const { return contacts_[place_of_[row]].now; }

  private:
    /// Unknowns that stand side by side, an even number of them, the last one perhaps without an effect.
    struct Run {
        std::uint32_t first = 0, count = 0;  // in y_
    };
    /// The unknowns that a row acts on, and its vectors there: for each run one vector after the other.
    struct Support {
        std::uint32_t first_run = 0, last_run = 0;
        std::size_t numbers = 0;
    };
    /// A joint row or a coupling.
    struct Scalar {
        Support support;
        double target = 0, compliance = 0, low = 0, high = 0;
        double mass = 0, inverse_mass = 0;  // effective
        double now = 0, change = 0, direction = 0;
    };
    struct Contact {
        Support support;
        double target_n = 0, compliance = 0, low = 0, high = 0;
        double target_1 = 0, target_2 = 0, slip = 0;
        double bound = 0, coefficient = 0;  // of friction: bound + coefficient * normal impulse
        double mass_n = 0, mass_t = 0, inverse_n = 0, inverse_t = 0;  // effective
        double n_on_1 = 0, n_on_2 = 0;  // tangential velocities per unit of normal impulse
        ContactImpulse now, change, direction;
    };
    /// Up to three vectors of J, and the last entry empty.
    using Entry = std::array<double, 4>;

    // sweep_rows.cpp: what sweeps need to know of the rows
    void start(const Problem& p, std::size_t n);
    void start_robots(const Problem& p, std::size_t n);
    void order_contacts(const Problem& p);
    void add_scalar(const BoundedRow& row, std::size_t first_run, std::size_t first_number);
    void add_joint(const Problem& p, const JointRow& row);
    void add_coupling(const Problem& p, const CouplingRow& row);
    void add_contact(const Problem& p, std::size_t index);
    void touch(const Problem& p, std::size_t robot, int dof, const Entry& entry);
    void add_support(const Problem& p, std::size_t robot, std::size_t vectors);
    void start_impulses(const Problem& p, bool again);

    SweepReport sweep_all(const Problem& p, const SweepPlan& plan, std::vector<double>& v);
    double sweep(double share);
    double sweep_scalar(Scalar& row, double share);
    double sweep_contact(Contact& row, double share);
    double squared_impulses() const;
    double squared_motion(const Problem& p) const;
    void accelerate(double share);
    void push(const Support& support, double impulse);
    void push(const Support& support, const ContactImpulse& impulse);
    void take_velocities(const Problem& p, std::vector<double>& v) const;

    double converged_ = 0;  // squared change, relative to the squared impulses
    std::size_t joints_ = 0;
    std::vector<double> factors_;            // of all mass matrices, as tree_factor leaves them
    std::vector<double> roots_;              // D^-1/2, as y_
    std::vector<std::size_t> factor_first_;  // by robot
    std::vector<std::size_t> robot_of_;      // by unknown of the problem
    std::vector<std::size_t> first_;         // by robot, and the end: in y_
    std::vector<Scalar> scalars_;            // joint rows, then couplings
    std::vector<Contact> contacts_;          // as they are swept
    std::vector<std::uint32_t> order_;       // rows of the contacts, as they are swept
    std::vector<std::uint32_t> place_of_;    // and back
    std::vector<std::uint64_t> taken_;       // by robot: its colours
    std::vector<Run> runs_;
    std::vector<double> numbers_;
    std::vector<double> y_free_;                      // without rows
    std::vector<double> y_, y_before_, y_direction_;  // now; before the last sweep; search direction
    // Of the row that is added, by unknown of the robot; `support_` ascends.
    std::vector<Entry> entries_;
    std::vector<char> marks_;
    std::vector<int> support_;
    std::array<double, 5> products_{};  // w w: n n, t1 t1, t2 t2, n t1, n t2
};

}  // namespace roboss
