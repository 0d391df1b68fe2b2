// See joint_parameter_texts.h.
#include "model/joint_parameter_texts.h"

#include <algorithm>
#include <limits>

#include "model/joint_motion.h"
#include "model/model.h"
#include "world/joint_type.h"

namespace roboss {

const char* unit_of(JointParameter parameter, const Joint& joint, int axis) {
    const auto motions = joint_type(joint.kind).motions;
    const auto motion = std::min(static_cast<std::size_t>(axis), motions.size() - 1);
    const JointParameterInfo& row = info_of(parameter);
    return joint_traits(motions[motion]).turns ? row.turning : row.sliding;
}

std::optional<double> value_of_null(JointParameter parameter) {
    if (!info_of(parameter).endless) return std::nullopt;
    const double infinity = std::numeric_limits<double>::infinity();
    return parameter == JointParameter::kLower ? -infinity : infinity;
}

}  // namespace roboss
