// The choice between code for several instruction sets. Included by code for every processor alone.
#pragma once

namespace roboss {

/// The kernel of the first of these that this processor can run. `avx512` and `avx2` return null where they
/// were built without.
template <class Kernel>
Kernel best_kernel(Kernel (*avx512)(), Kernel (*avx2)(), Kernel (*any)()) {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
        if (auto kernel = avx512()) return kernel;
    if (__builtin_cpu_supports("avx2"))
        if (auto kernel = avx2()) return kernel;
#else
    (void)avx512, (void)avx2;
#endif
    return any();
}

}  // namespace roboss
