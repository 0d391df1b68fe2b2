// Fronts with AVX2. Built for that instruction set alone (layer.cmake): nothing in here may run before
// the processor has been asked (front_kernel).
#include "physics/sparse/front_loops.h"

namespace roboss {

const FrontKernel* avx2_front_kernel() {
#if defined(__AVX2__)
    return &kFrontLoops;
#else
    static_cast<void>(kFrontLoops);
    return nullptr;
#endif
}

}  // namespace roboss
