// The soft solver on any processor, and the choice of the best kernel.
#include "physics/lanes/best_kernel.h"
#include "physics/lanes/lane_soft.h"

namespace roboss::soft {
Kernel::~Kernel() = default;

std::unique_ptr<Kernel> make_any_kernel() {
    return std::make_unique<LaneSoft>();
}

const Kernel& kernel() {
    static const std::unique_ptr<Kernel> best =
        best_kernel(make_avx512_kernel, make_avx2_kernel, make_any_kernel);
    return *best;
}

}  // namespace roboss::soft
