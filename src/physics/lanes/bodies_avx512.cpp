// Free bodies with AVX512. Built for that instruction set alone (layer.cmake): nothing in here may run before
// the processor has been asked (body_kernel).
#include "physics/lanes/lane_bodies.h"

namespace roboss {

std::unique_ptr<BodyKernel> make_avx512_body_kernel() {
#if defined(__AVX512F__)
    return std::make_unique<LaneBodies>();
#else
    return nullptr;
#endif
}

}  // namespace roboss
