// The soft solver with AVX2. Built for that instruction set alone (layer.cmake): nothing in here may run
// before the processor has been asked (soft::kernel).
#include "physics/lanes/lane_soft.h"

namespace roboss::soft {

std::unique_ptr<Kernel> make_avx2_kernel() {
#if defined(__AVX2__)
    return std::make_unique<LaneSoft>();
#else
    return nullptr;
#endif
}

}  // namespace roboss::soft
