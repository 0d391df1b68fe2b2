// Lanes of AVX2: four doubles or eight floats. Built for that instruction set alone (floor.cmake): nothing in
// here may run before the processor has been asked (make_lane_stepper).
#include "core/lanes_x86.h"
#include "physics/lane_step.h"

namespace roboss {

std::unique_ptr<LaneStepper> make_avx2_stepper() {
#if defined(__AVX2__)
    return std::make_unique<LaneStep<DoublesAvx2>>();
#else
    return nullptr;
#endif
}

std::unique_ptr<LaneStepper> make_avx2_float_stepper() {
#if defined(__AVX2__)
    return std::make_unique<LaneStep<FloatsAvx2>>();
#else
    return nullptr;
#endif
}

}  // namespace roboss
