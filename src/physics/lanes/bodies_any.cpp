// Free bodies on any processor, and the choice of the best kernel.
#include "physics/lanes/lane_bodies.h"

namespace roboss {
namespace {

std::unique_ptr<BodyKernel> make_best_kernel() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
        if (auto kernel = make_avx512_body_kernel()) return kernel;
    if (__builtin_cpu_supports("avx2"))
        if (auto kernel = make_avx2_body_kernel()) return kernel;
#endif
    return make_any_body_kernel();
}

}  // namespace

BodyKernel::~BodyKernel() = default;

std::unique_ptr<BodyKernel> make_any_body_kernel() {
    return std::make_unique<LaneBodies>();
}

const BodyKernel& body_kernel() {
    static const std::unique_ptr<BodyKernel> best = make_best_kernel();
    return *best;
}

}  // namespace roboss
