// See sweep_plan.h.
#include "physics/solver/sweep_plan.h"

namespace roboss {

void SweepProgress::begin(double impulses, double motion) {
    constexpr double kMoves =
        1e-9;  // what settles, relative to the impulses; less is left to Newton's method
    moves_ = plan_.settled * motion > kMoves * impulses;
    most_ = moves_ ? plan_.most_to_settle : plan_.most;
    enough_ = moves_ ? plan_.settled * motion : plan_.converged * impulses;
}

bool SweepProgress::ends(double change) {
    ++sweeps_;
    settled_ = moves_ && change <= enough_;
    if (change <= enough_ || sweeps_ >= most_) return true;
    share_ = sweeps_ > 1 && change <= last_ ? change / last_ : 0;
    last_ = change;
    return false;
}

}  // namespace roboss
