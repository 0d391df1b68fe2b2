// BodySolver's solution for the displacement of the tick.
#include "physics/bodies/body_points.h"
#include "physics/bodies/body_solver.h"

namespace roboss {

/// Lets points push that the displacement would violate, and others go that would pull; false if there are
/// none.
bool BodySolver::change_pushing() {
    constexpr double kViolation = 1e-9;  // m/s
    bool some = false;
    for (BodyPoint& p : island_.points) {
        const bool pushed = p.swept_n > 0;
        const bool pushes = p.target_n - p.u_n > (pushed ? 0 : kViolation);
        if (pushes == pushed) continue;
        p.swept_n = pushes ? 1 : 0;
        some = true;
    }
    return some;
}

/// The displacement from the solved velocities, by an active set method: each round is the solution if the
/// points that it started with push and no others, with friction linear, as it is at these velocities. False
/// if the rounds do not tell which points push; then all is as before.
bool BodySolver::displace() {
    constexpr int kRoundsMax = 10;
    keep_start();
    residual_ = kernel_.balance(island_);
    for (int round = 0; round < kRoundsMax; ++round) {
        if (round > 0) return_to_start();
        island_.for_points([&](std::size_t k) { set_curvature(island_.points[k]); });
        for (BodyPoint& p : island_.points) {
            p.d_n = p.f_n = 0;
            if (p.swept_n > 0) push(p);
        }
        kernel_.set_gradient(island_);
        if (!kernel_.find_step(island_, false, 0)) break;
        ++iterations_;
        kernel_.move(island_, 1);
        if (change_pushing()) continue;
        for (BodyPoint& p : island_.points) p.f_n = p.swept_n > 0 ? (p.target_n - p.u_n) * p.stiffness_n : 0;
        residual_ = 0;
        return true;
    }
    return_to_start();
    return false;
}

}  // namespace roboss
