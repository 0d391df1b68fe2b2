// See sweep_plan.h.
#include "physics/bodies/sweep_plan.h"

#include <algorithm>
#include <cmath>

namespace roboss {

void SweepProgress::begin(double impulses, double motion) {
    // Of what settles, relative to the impulses: less is left to Newton's method, more is not taken, for what
    // rests beside something fast is to carry its load.
    constexpr double kMost = 1e-6;
    const double enough = plan_.settle_tolerance * motion;
    moves_ = enough > plan_.least * impulses;
    most_ = moves_ ? plan_.most_to_settle : plan_.most;
    enough_ = moves_ ? std::min(enough, kMost * impulses) : plan_.start_tolerance * impulses;
}

bool SweepProgress::ends(double change) {
    ++report_.sweeps;
    const bool is_last = report_.sweeps >= most_;
    report_.settled = moves_ && change <= (is_last ? plan_.at_last : 1) * enough_;
    if (change <= enough_ || is_last || !std::isfinite(change)) return true;
    share_ = report_.sweeps > 1 && change <= last_ ? change / last_ : 0;
    last_ = change;
    if (is_stuck(change)) share_ = 0;
    return false;
}

/// True in the second half of a series of sweeps that gets nowhere. In a pile that jams accelerated sweeps
/// may run in a circle; without acceleration they leave it.
bool SweepProgress::is_stuck(double change) {
    constexpr double kProgress = 0.7;  // of the least change before
    constexpr int kPatience = 16;
    const bool improves = report_.sweeps == 1 || change < kProgress * best_;
    since_best_ = improves ? 0 : since_best_ + 1;
    if (improves) best_ = change;
    if (since_best_ < kPatience) return false;
    if (since_best_ == 2 * kPatience) since_best_ = 0, best_ = change;
    return true;
}

}  // namespace roboss
