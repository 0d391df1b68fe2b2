// Numbers of joint axes as files, messages and pages give and show them: their units, and null for no bound.
#pragma once

#include <optional>

#include "model/joint_parameters.h"

namespace roboss {

struct Joint;

/// The unit of a number of this axis: "N m s/rad". `axis`: one of the joint's, from 0.
const char* unit_of(JointParameter parameter, const Joint& joint, int axis);

/// The number that null stands for in JSON, which has no infinity: no bound. nullopt: null is no such number.
std::optional<double> value_of_null(JointParameter parameter);

}  // namespace roboss
