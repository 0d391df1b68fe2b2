// When Gauss-Seidel sweeps over contacts end, and when what they found is the solution. Shared by those of
// free bodies (lanes/lane_pair_sweeps.h) and of robots with joints (row_sweeps.h).
//
// Sums are over all rows: impulses by effective mass (impulse^2 / mass), motion likewise (speed^2 * mass),
// where the speeds are those along the rows before the solve: of contact points that slide, close and open.
// Both are energies, and do not depend on the frame of reference.
#pragma once

#include "model/model.h"

namespace roboss {

struct SweepPlan {
    int most = 0;             // sweeps, at most
    double converged = 1e-8;  // squared change by a sweep that ends them, relative to the squared impulses
    double settled = 0;  // squared change by a sweep, relative to the motion, that is the solution; 0: never
    int most_to_settle = 0;  // sweeps, at most, where there is motion to compare with
};

/// Squared change that ends a pile's sweeps, relative to its motion; 0 where Newton's method shall finish.
/// Sweeps alone miss the velocities by a thousandth of how fast the contact points move (root mean square).
inline double pile_may_settle(const Accuracy& accuracy) {
    return accuracy.tolerance >= 1e-9 ? 1e-7 : 0;
}

/// Follows the sweeps of one solve.
class SweepProgress {
  public:
    explicit SweepProgress(const SweepPlan& plan) : plan_(plan) {}

    /// After the first sweep. `impulses`: squared.
    void begin(double impulses, double motion);
    /// After each sweep. `change`: squared, of the impulses. True if that was the last.
    bool ends(double change);
    /// What is left of the search direction.
    double share() const { return share_; }
    /// The last sweep changed so little that nothing more is needed.
    bool settled() const { return settled_; }

  private:
    bool is_stuck(double change);

    SweepPlan plan_;
    int sweeps_ = 0, most_ = 0, since_best_ = 0;
    double enough_ = 0, last_ = 0, best_ = 0, share_ = 0;
    bool moves_ = false, settled_ = false;
};

}  // namespace roboss
