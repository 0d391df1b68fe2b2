// When Gauss-Seidel sweeps over the contacts of free bodies (lanes/lane_pair_sweeps.h) end, and when what
// they found is the solution; decision 0037.
//
// Sums: impulses by effective mass (impulse^2 / mass) over all points; motion likewise (speed^2 * mass) over
// the contact points, with the speeds along them at the velocities that the solve starts from. Both are
// energies and do not depend on the frame of reference.
#pragma once

#include "model/model.h"

namespace roboss {

struct SweepPlan {
    int most = 0;             // sweeps, at most
    double converged = 1e-8;  // squared change by a sweep that ends them, relative to the squared impulses
    double settled = 0;  // squared change by a sweep, relative to the motion, that is the solution; 0: never
    int most_to_settle = 0;  // sweeps, at most, where there is motion to compare with
};

struct SweepReport {
    bool settled = false;  // the impulses are the solution
    int sweeps = 0;
    /// In iterations of Newton's method that take as long.
    int iterations() const { return sweeps / 12; }
};

/// The plan for a pile: to settle where the accuracy leaves that to sweeps, as in `standard`. They miss the
/// velocities by about a thousandth of how fast the contact points move (root mean square).
inline SweepPlan pile_plan(const Accuracy& accuracy, int most) {
    SweepPlan plan{.most = most};
    if (accuracy.tolerance >= 1e-9) plan.settled = 1e-7, plan.most_to_settle = 300;
    return plan;
}

/// Follows the sweeps of one solve.
class SweepProgress {
  public:
    explicit SweepProgress(const SweepPlan& plan) : plan_(plan) {}

    /// After the first sweep. `impulses`, `motion`: squared.
    void begin(double impulses, double motion);
    /// After each sweep. `change`: squared, of the impulses. True if that was the last.
    bool ends(double change);
    /// What is left of the search direction.
    double share() const { return share_; }
    const SweepReport& report() const { return report_; }

  private:
    bool is_stuck(double change);

    SweepPlan plan_;
    SweepReport report_;
    int most_ = 0, since_best_ = 0;
    double enough_ = 0, last_ = 0, best_ = 0, share_ = 0;
    bool moves_ = false;
};

}  // namespace roboss
