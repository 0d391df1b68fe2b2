// What the solver of free bodies computes with all of them (body_island.h), for one instruction set each.
// Every processor gives the same bits: vectors hold separate sums, and what is summed across them is summed
// in one order.
#pragma once

#include <memory>

#include "physics/bodies/body_island.h"

namespace roboss {

class BodyKernel {
  public:
    BodyKernel() = default;
    virtual ~BodyKernel();
    BodyKernel(const BodyKernel&) = delete;
    BodyKernel& operator=(const BodyKernel&) = delete;

    /// What follows from the velocities: M v; velocities along the points.
    virtual void take_velocities(BodyIsland& island) const = 0;
    /// Impulses at the present velocities, then as set_gradient.
    virtual double balance(BodyIsland& island) const = 0;
    /// Applied impulses and gradient; returns the imbalance of momentum, relative.
    virtual double set_gradient(BodyIsland& island) const = 0;
    /// step = -H^-1 gradient, and what follows from it. `coupled`, `lack`: as Hessian::assemble. False if a
    /// pivot is zero.
    virtual bool find_step(BodyIsland& island, bool coupled, double lack) const = 0;
    /// Goes `alpha` steps.
    virtual void move(BodyIsland& island, double alpha) const = 0;
    /// The potential's derivative along the step, here; and `fraction` steps from here.
    virtual double slope(const BodyIsland& island) const = 0;
    virtual double slope_beyond(const BodyIsland& island, double fraction) const = 0;
    /// Gauss-Seidel sweeps, from what points carried last; velocities and impulses that they lead to.
    virtual void sweep(BodyIsland& island, int sweeps) const = 0;
};

/// The best that this processor can run.
const BodyKernel& body_kernel();

// One for each instruction set; nullptr if it was built without.
std::unique_ptr<BodyKernel> make_any_body_kernel();
std::unique_ptr<BodyKernel> make_avx2_body_kernel();
std::unique_ptr<BodyKernel> make_avx512_body_kernel();

}  // namespace roboss
