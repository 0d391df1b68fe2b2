// The shortcut of `--accuracy fast` where robots touch.
#pragma once

#include "model/model.h"

namespace roboss {

/// True at tolerances of 1e-6 and more, as `fast` has. Then robots that touch each other are left to soft
/// substeps (soft/soft_solver.h), where these can solve them. Momentum balances all the same, to rounding,
/// for velocities are those of the impulses found, and friction is within its bounds. What is left over shows
/// at the contacts: they overlap and creep a little more.
inline bool is_fast(const Accuracy& accuracy) {
    return accuracy.tolerance >= 1e-6;
}

}  // namespace roboss
