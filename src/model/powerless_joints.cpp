// Joints with an effort or velocity limit of 0: exporters write effort="0" velocity="0" where the fields were
// left empty in.
#include "model/powerless_joints.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <unordered_map>

#include "model/compile_type.h"

namespace roboss {
namespace {

constexpr ZeroLimit kZeroLimits[] = {
    {"no-effort", "effort limit",
     "write the greatest effort of the motor (effort=\"...\" of <limit> in URDF, <effort> in SDFormat), or "
     "none"},
    {"no-velocity", "velocity limit",
     "write the greatest velocity of the motor (velocity=\"...\" of <limit> in URDF, <velocity> in "
     "SDFormat), "
     "or none"},
};

const ZeroLimit* zero_limit_of(const AxisSpec& axis) {
    return axis.mimic ? nullptr : zero_limit(axis.max_effort, axis.max_velocity);
}

/// The limit of a joint that no motor can move about any axis.
const ZeroLimit* zero_limit_of(const JointSpec& joint) {
    const auto moves = [](const AxisSpec& axis) { return zero_limit_of(axis) == nullptr; };
    if (joint.axes.empty() || std::ranges::any_of(joint.axes, moves)) return nullptr;
    return zero_limit_of(joint.axes[0]);
}

/// Joints with the same cause.
struct Powerless {
    std::string names;
    std::size_t count = 0;
    SourceLocation where;  // of the first
};

void report_cause(const ZeroLimit& limit, const Powerless& joints, const std::string& model,
                  Diagnostics& diagnostics) {
    const bool single = joints.count == 1;
    std::string remedy(limit.remedy);
    remedy[0] = 'W';
    diagnostics.warning(
        joints.where, std::string(limit.code),
        "the " + std::string(limit.name) + " is 0 at " + (single ? "joint " : "joints ") + joints.names +
            " of model '" + model + "': " +
            (single ? "no motor can drive it, so it moves freely, and orders to it are refused"
                    : "no motor can drive them, so they move freely, and orders to them are "
                      "refused"),
        remedy + ".");
}

}  // namespace

const ZeroLimit* zero_limit(double max_effort, double max_velocity) {
    if (max_effort == 0) return &kZeroLimits[0];
    return max_velocity == 0 ? &kZeroLimits[1] : nullptr;
}

bool is_of_zero_limit(std::string_view code) {
    return std::ranges::find(kZeroLimits, code, &ZeroLimit::code) != std::end(kZeroLimits);
}

void report_powerless(const RobotType& type, const ModelSpec& spec, Diagnostics& diagnostics) {
    constexpr std::size_t kShown = 5;
    std::unordered_map<std::string_view, const JointSpec*> of_names;
    for (const JointSpec& joint : spec.joints) of_names.emplace(joint.name, &joint);
    for (const ZeroLimit& limit : kZeroLimits) {
        Powerless found;
        for (const Joint& joint : type.joints) {
            const auto named = of_names.find(joint.name);
            if (named == of_names.end() || zero_limit_of(*named->second) != &limit) continue;
            if (found.count == 0) found.where = named->second->where;
            if (++found.count > kShown) continue;
            found.names += (found.count == 1 ? "'" : ", '") + joint.name + "'";
        }
        if (found.count == 0) continue;
        if (found.count > kShown) found.names += " and " + std::to_string(found.count - kShown) + " more";
        report_cause(limit, found, spec.name, diagnostics);
    }
}

}  // namespace roboss
