// Fronts with AVX-512. Built for that instruction set alone (layer.cmake): nothing in here may run before
// the processor has been asked (front_kernel).
#include "physics/sparse/front_loops.h"

namespace roboss {

const FrontKernel* avx512_front_kernel() {
#if defined(__AVX512F__)
    return &kFrontLoops;
#else
    static_cast<void>(kFrontLoops);
    return nullptr;
#endif
}

}  // namespace roboss
