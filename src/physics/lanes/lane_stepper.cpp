// See lane_stepper.h.
#include "physics/lanes/lane_stepper.h"

#include "physics/dynamics/fast_turning.h"

namespace roboss {

LaneStepper::~LaneStepper() = default;

bool fits_lanes(const RobotType& type, const RobotState& state) {
    const bool is_lone_body = type.free_base && type.nv == 6;
    return type.nv > 0 && !is_lone_body && !type.has_equalities() && type.drags.empty() && !type.feels_flow &&
           !type.has_slip && type.self_pairs.empty() && state.wrenches.empty() && state.bonds.empty() &&
           state.surfaces.empty() && is_driven<double>(state.motors);
}

std::unique_ptr<LaneStepper> make_lane_stepper(Precision precision, std::size_t most) {
    const bool floats = precision == Precision::kFloat;
#if defined(__x86_64__)
    if (floats) most /= 2;  // twice as many fill a register
    if (most >= 8 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
        if (auto stepper = make_avx512_stepper(precision)) return stepper;
    if (most >= 4 && __builtin_cpu_supports("avx2"))
        if (auto stepper = make_avx2_stepper(precision)) return stepper;
#else
    static_cast<void>(most);
#endif
    return floats ? make_single_stepper() : nullptr;
}

}  // namespace roboss
