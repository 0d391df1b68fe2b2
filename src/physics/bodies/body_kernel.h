// Linear algebra and Gauss-Seidel sweeps of BodySolver, one implementation for each instruction set. All give
// the same bits: vectors hold separate sums, and what is summed across them is summed in one order.
#pragma once

#include <memory>

#include "physics/bodies/body_island.h"
#include "physics/bodies/sweep_plan.h"

namespace roboss {

class BodyKernel {
  public:
    BodyKernel() = default;
    virtual ~BodyKernel();
    BodyKernel(const BodyKernel&) = delete;
    BodyKernel& operator=(const BodyKernel&) = delete;

    /// Computes M v and the velocities along the points.
    virtual void take_velocities(BodyIsland& island) const = 0;
    /// Sets the impulses from the velocities, then calls set_gradient.
    virtual double balance(BodyIsland& island) const = 0;
    /// Sums the impulses on each body; returns the relative error of the momentum balance.
    virtual double set_gradient(BodyIsland& island) const = 0;
    /// step = -H^-1 gradient, and what follows from it. `coupled`, `lack`: as Hessian::assemble. False if a
    /// pivot is zero.
    virtual bool find_step(BodyIsland& island, bool coupled, double lack) const = 0;
    /// v += alpha * step.
    virtual void move(BodyIsland& island, double alpha) const = 0;
    /// The potential's derivative along the step at the present velocities, and `fraction` steps beyond.
    virtual double slope(const BodyIsland& island) const = 0;
    virtual double slope_beyond(BodyIsland& island, double fraction) const = 0;
    /// Gauss-Seidel sweeps from the impulses f_n, f_1, f_2 at the velocities that take_velocities() took. The
    /// result are swept_n, swept_1, swept_2, also in f_n, f_1, f_2, and v, of which momentum balances to
    /// rounding; what follows from v is not set.
    virtual SweepReport sweep(BodyIsland& island, const SweepPlan& plan) const = 0;
};

/// The best that this processor can run.
const BodyKernel& body_kernel();

// One for each instruction set; nullptr if it was built without.
std::unique_ptr<BodyKernel> make_any_body_kernel();
std::unique_ptr<BodyKernel> make_avx2_body_kernel();
std::unique_ptr<BodyKernel> make_avx512_body_kernel();

}  // namespace roboss
