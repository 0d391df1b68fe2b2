// What `--accuracy fast` leaves out where many touch (decision 0034).
#pragma once

#include <algorithm>

#include "model/model.h"

namespace roboss {

/// Whether Gauss-Seidel sweeps alone find the velocities of a pile, without Newton's method: at tolerances of
/// 1e-6 and more, as `fast` has. Momentum balances all the same, to rounding, for velocities are those of the
/// impulses found, and friction is within its bounds. What is left over shows in the velocities at the
/// contacts: bodies overlap and creep a little more.
inline bool sweeps_suffice(const Accuracy& accuracy) {
    return accuracy.tolerance >= 1e-6;
}

/// m, the penetration that a rigid contact leaves alone. `slop`: what its surfaces say.
inline double slop_with(const Accuracy& accuracy, double slop) {
    constexpr double kLoose = 1e-4;
    return sweeps_suffice(accuracy) ? std::max(slop, kLoose) : slop;
}

}  // namespace roboss
