// Drive: the force law of an actuator of MuJoCo, as its elements and their defaults set it one after the
// other.
#pragma once

#include <array>
#include <string>

#include "mjcf/attributes.h"

namespace roboss::mjcf {

/// force = gain[0] * control + bias[0] + bias[1] * length + bias[2] * speed, within `force_range`; the joint
/// feels gear * force, length and speed are gear times its own.
struct Drive {
    std::array<double, 3> gain{1, 0, 0}, bias{};
    std::string gain_type = "fixed", bias_type = "none", dynamics = "none";
    double gear = 1;
    double control_range[2] = {0, 0}, force_range[2] = {0, 0};
    std::string control_limited = "auto", force_limited = "auto";
    double armature = 0,  ///< kg m^2 at the motor
        damping = 0;      ///< N m s/rad at the motor
    bool known = true;    ///< false: a kind that has no counterpart (muscle, adhesion ...)

    /// What an element of this kind says, or the element of a default class.
    void apply(const Attributes& element);

    bool controls_limited(bool autolimits) const;
    bool forces_limited(bool autolimits) const;
};

}  // namespace roboss::mjcf
