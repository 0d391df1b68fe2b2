// Free bodies on any processor, and the choice of the best kernel.
#include "physics/lanes/best_kernel.h"
#include "physics/lanes/lane_bodies.h"

namespace roboss {
BodyKernel::~BodyKernel() = default;

std::unique_ptr<BodyKernel> make_any_body_kernel() {
    return std::make_unique<LaneBodies>();
}

const BodyKernel& body_kernel() {
    static const std::unique_ptr<BodyKernel> best =
        best_kernel(make_avx512_body_kernel, make_avx2_body_kernel, make_any_body_kernel);
    return *best;
}

}  // namespace roboss
