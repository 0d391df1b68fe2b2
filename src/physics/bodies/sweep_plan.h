// When Gauss-Seidel sweeps over contacts end, of free bodies (lanes/lane_pair_sweeps.h) and of robots with
// joints (solver/row_sweeps.h), and when what they found is the solution; decision 0037.
//
// Sums over all contact points, with m their effective masses: `impulses` is the sum of impulse^2 / m,
// `change` that of (impulse change by a sweep)^2 / m, `motion` that of m speed^2 at the velocities that the
// solve starts from. They are energies and do not depend on the frame of reference.
#pragma once

#include <cstddef>

#include "model/model.h"

namespace roboss {

struct SweepPlan {
    // A part at rest.
    int most = 0;                   // sweeps
    double start_tolerance = 1e-8;  // they end at this change / impulses
    bool rest_settles = false;      // what reaches it is the solution; else Newton's method starts from there
    // A part that moves. What the sweeps found is the solution if they reach the tolerance.
    int most_to_settle = 0;       // sweeps
    double settle_tolerance = 0;  // change / motion; 0: always as at rest
    double least = 1e-9;          // of the tolerance times motion / impulses: below, the part is at rest

    /// For sweeps that go on from what others settled.
    void tighten(double factor) {
        settle_tolerance *= factor, least *= factor;
        if (rest_settles) start_tolerance *= factor;
    }
};

struct SweepReport {
    bool settled = false;  // the impulses are the solution
    int sweeps = 0;
    /// The number of Newton iterations that take as long as these sweeps.
    int iterations() const { return sweeps / 12; }
};

/// True where sweeps may settle piles, as in `standard` and `fast`.
inline bool sweeps_may_settle(const Accuracy& accuracy) {
    return accuracy.tolerance >= 1e-9;
}

/// What a factor of a part's matrix would hold beside the matrix itself. Where it is much, each iteration of
/// Newton's method takes as long as many sweeps.
enum class Fill { kLittle, kMuch };

/// The plan for a pile: to settle where the accuracy leaves that to sweeps, as in `standard`. They miss the
/// velocities by about a thousandth of how fast the contact points move (root mean square).
///
/// Where a factor would fill up, they may settle what rests, too.
inline SweepPlan pile_plan(const Accuracy& accuracy, int most, Fill fill) {
    SweepPlan plan{.most = most};
    if (!sweeps_may_settle(accuracy)) return plan;
    plan.settle_tolerance = 1e-7, plan.most_to_settle = 300;
    if (fill == Fill::kLittle) return plan;
    plan.most_to_settle = 200;
    plan.most = 100, plan.start_tolerance = 1e-12, plan.rest_settles = true;
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
    /// Factor on the search direction (beta of nonlinear conjugate gradients); 0 starts it anew.
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
