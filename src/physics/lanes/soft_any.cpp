// The soft solver on any processor, and the choice of the best kernel.
#include "physics/lanes/lane_soft.h"

namespace roboss::soft {
namespace {

std::unique_ptr<Kernel> make_best_kernel() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
        if (auto kernel = make_avx512_kernel()) return kernel;
    if (__builtin_cpu_supports("avx2"))
        if (auto kernel = make_avx2_kernel()) return kernel;
#endif
    return make_any_kernel();
}

}  // namespace

Kernel::~Kernel() = default;

std::unique_ptr<Kernel> make_any_kernel() {
    return std::make_unique<LaneSoft>();
}

const Kernel& kernel() {
    static const std::unique_ptr<Kernel> best = make_best_kernel();
    return *best;
}

}  // namespace roboss::soft
