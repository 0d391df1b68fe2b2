// Fronts on any processor, and the choice of the best kernel.
#include "physics/lanes/best_kernel.h"
#include "physics/sparse/front_loops.h"

namespace roboss {
const FrontKernel* any_front_kernel() {
    return &kFrontLoops;
}

const FrontKernel& front_kernel() {
    static const FrontKernel* best = best_kernel(avx512_front_kernel, avx2_front_kernel, any_front_kernel);
    return *best;
}

}  // namespace roboss
