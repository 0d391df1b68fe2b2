// Lanes of AVX-512: eight doubles or sixteen floats. Built for that instruction set alone (layer.cmake):
// nothing in here may run before the processor has been asked (make_lane_stepper).
#include "core/lanes_x86.h"
#include "physics/lanes/lane_step.h"

namespace roboss {

std::unique_ptr<LaneStepper> make_avx512_stepper(Precision precision) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
    if (precision == Precision::kFloat) return std::make_unique<LaneStep<FloatsAvx512>>();
    return std::make_unique<LaneStep<DoublesAvx512>>();
#else
    static_cast<void>(precision);
    return nullptr;
#endif
}

}  // namespace roboss
