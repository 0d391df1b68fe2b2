// What `--accuracy fast` leaves out where many touch.
#pragma once

#include "model/model.h"

namespace roboss {

/// Whether Gauss-Seidel sweeps alone find the velocities of a pile, without Newton's method: at tolerances of
/// 1e-6 and more, as `fast` has. Momentum balances all the same, to rounding, for velocities are those of the
/// impulses found, and friction is within its bounds. What is left over shows in the velocities at the
/// contacts: bodies overlap and creep a little more.
inline bool sweeps_suffice(const Accuracy& accuracy) {
    return accuracy.tolerance >= 1e-6;
}

}  // namespace roboss
