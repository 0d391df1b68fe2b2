// Lanes of NEON, eight doubles or sixteen floats: four registers. Every aarch64 processor has it.
#include "core/lanes_neon.h"
#include "physics/lanes/lane_step.h"

namespace roboss {

std::unique_ptr<LaneStepper> make_neon8_stepper(Precision precision) {
#if defined(__aarch64__)
    if (precision == Precision::kFloat) return std::make_unique<LaneStep<FloatsNeon16>>();
    return std::make_unique<LaneStep<DoublesNeon8>>();
#else
    static_cast<void>(precision);
    return nullptr;
#endif
}

}  // namespace roboss
