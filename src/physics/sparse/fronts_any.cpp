// Fronts on any processor, and the choice of the best kernel.
#include "physics/sparse/front_loops.h"

namespace roboss {
namespace {

const FrontKernel& best_front_kernel() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
        if (const FrontKernel* kernel = avx512_front_kernel()) return *kernel;
    if (__builtin_cpu_supports("avx2"))
        if (const FrontKernel* kernel = avx2_front_kernel()) return *kernel;
#endif
    return *any_front_kernel();
}

}  // namespace

const FrontKernel* any_front_kernel() {
    return &kFrontLoops;
}

const FrontKernel& front_kernel() {
    static const FrontKernel& best = best_front_kernel();
    return best;
}

}  // namespace roboss
