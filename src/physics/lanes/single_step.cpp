// One robot by itself in floats: the same step as in lanes, with the same bits, on any processor.
#include "physics/lanes/lane_step.h"

namespace roboss {

std::unique_ptr<LaneStepper> make_single_stepper() {
    return std::make_unique<LaneStep<Single>>();
}

}  // namespace roboss
