// The list of all cases, and the judgement on a figure.
#include "accuracy/case.h"

#include <cmath>

namespace roboss::bench {

bool passes(const Quantity& quantity, double figure) {
    if (!quantity.bound) return true;
    return std::fabs(figure - quantity.target.value_or(0)) <= *quantity.bound;  // false for no number
}

std::vector<Case> all_cases() {
    std::vector<Case> all;
    for (const auto& some : {free_motion_cases(), dynamics_cases(), convergence_cases(), slope_cases(),
                             impact_cases(), car_cases(), resting_cases(), gripper_cases(), loop_cases(),
                             motor_cases(), walker_cases(), random_cases()})
        all.insert(all.end(), some.begin(), some.end());
    return all;
}

}  // namespace roboss::bench
