// Passes of the soft solver over batches of patches and over bodies, one implementation for each instruction
// set. All give the same bits: lanes hold patches that share no body, and nothing is summed across them.
#pragma once

#include <memory>

#include "physics/soft/soft_rows.h"

namespace roboss::soft {

enum class Pass {
    kWarm,    // applies the impulses that the last tick ended with
    kPush,    // normals, overlaps pushed out
    kRelax,   // normals without that, then friction; adds up the impulses
    kBounce,  // normals of blows part with their speed
};

class Kernel {
  public:
    Kernel() = default;
    virtual ~Kernel();
    Kernel(const Kernel&) = delete;
    Kernel& operator=(const Kernel&) = delete;

    /// Batches of one colour.
    virtual void run(Problem& problem, std::size_t first, std::size_t last, Pass pass,
                     const Substep& substep) const = 0;
};

/// The best that this processor has for batches of this size: wider registers help where they are
/// filled.
const Kernel& kernel(int patches);

// One for each instruction set; nullptr if it was built without.
std::unique_ptr<Kernel> make_any_kernel();
std::unique_ptr<Kernel> make_avx2_kernel();
std::unique_ptr<Kernel> make_avx512_kernel();

}  // namespace roboss::soft
