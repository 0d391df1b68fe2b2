// Joints with an effort limit of 0: exporters write effort="0" velocity="0" where the fields were left empty
// in.
#include <algorithm>
#include <string_view>
#include <unordered_map>

#include "model/compile_type.h"

namespace roboss {

void report_powerless(const RobotType& type, const ModelSpec& spec, Diagnostics& diagnostics) {
    constexpr std::size_t kShown = 5;
    std::string names;
    std::size_t count = 0;
    SourceLocation where;
    std::unordered_map<std::string_view, const JointSpec*> of_names;
    for (const JointSpec& joint : spec.joints) of_names.emplace(joint.name, &joint);
    for (const Joint& joint : type.joints) {
        const auto named = of_names.find(joint.name);
        if (named == of_names.end()) continue;
        const JointSpec* of_file = named->second;
        const auto is_driven = [](const AxisSpec& axis) { return axis.max_effort != 0 || axis.mimic; };
        if (of_file->axes.empty() || std::ranges::any_of(of_file->axes, is_driven)) continue;
        if (count == 0) where = of_file->where;
        if (++count <= kShown) names += (count == 1 ? "'" : ", '") + joint.name + "'";
    }
    if (count == 0) return;
    if (count > kShown) names += " and " + std::to_string(count - kShown) + " more";
    diagnostics.warning(where, "no-effort",
                        "the effort limit is 0 at " + std::string(count == 1 ? "joint " : "joints ") + names +
                            " of model '" + spec.name +
                            "': they move freely, no motor can drive them, and "
                            "orders to them are refused",
                        "Write the greatest effort of the motor (effort=\"...\" of <limit> in URDF, <effort> "
                        "in SDFormat), or none.");
}

}  // namespace roboss
