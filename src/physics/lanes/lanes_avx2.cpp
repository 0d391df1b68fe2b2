// Lanes of AVX2: four doubles or eight floats. Built for that instruction set alone (layer.cmake): nothing in
// here may run before the processor has been asked (make_lane_stepper).
#include "core/lanes_x86.h"
#include "physics/lanes/lane_step.h"

namespace roboss {

std::unique_ptr<LaneStepper> make_avx2_stepper(Precision precision) {
#if defined(__AVX2__)
    if (precision == Precision::kFloat) return std::make_unique<LaneStep<FloatsAvx2>>();
    return std::make_unique<LaneStep<DoublesAvx2>>();
#else
    static_cast<void>(precision);
    return nullptr;
#endif
}

}  // namespace roboss
