// See step_failure.h.
#include "physics/step_failure.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/joint_motion.h"

namespace roboss {
namespace {

/// The joint of the tree that moves a body; none: the base.
JointId joint_of_body(const RobotType& type, int body) {
    for (std::size_t j = 0; j < type.joints.size(); ++j)
        if (type.joints[j].body == body && type.joints[j].loop < 0) return JointId(j);
    return JointId();
}

/// Of the first body whose coordinates or velocities are not finite.
JointId broken_joint(const RobotType& type, const RobotState& state) {
    const auto broken = [](const std::vector<double>& values, int first, std::size_t count) {
        const auto begin = values.begin() + first;
        return !std::all_of(begin, begin + static_cast<std::ptrdiff_t>(count),
                            [](double x) { return std::isfinite(x); });
    };
    if (broken(state.q, 0, 7) || broken(state.v, 0, static_cast<std::size_t>(type.base_nv())))
        return JointId();
    for (std::size_t b = 0; b < type.bodies.size(); ++b) {
        const Body& body = type.bodies[b];
        if (body.joint == JointKind::kFree) continue;
        const auto width = static_cast<std::size_t>(joint_traits(body.joint).nq);
        if (broken(state.q, body.q_index, width) ||
            broken(state.v, body.v_index, static_cast<std::size_t>(body.nv)))
            return joint_of_body(type, static_cast<int>(b));
    }
    return JointId();
}

void note_failure(RobotId robot, bool beyond_numbers, JointId joint, StepReport& report) {
    const bool is_first =
        !report.not_finite.valid() ||
        std::pair(!beyond_numbers, robot) < std::pair(!report.beyond_numbers, report.not_finite);
    if (!is_first) return;
    report.not_finite = robot;
    report.not_finite_joint = joint;
    report.beyond_numbers = beyond_numbers;
}

}  // namespace

bool is_finite(const RobotState& state) {
    double sum = 0;
    for (double x : state.q) sum += x - x;
    for (double x : state.v) sum += x - x;
    for (double x : state.onboard) sum += x - x;
    return sum == 0;
}

std::optional<int> body_beyond_numbers(const RobotWork& work) {
    if (!is_finite(work.origin)) return -1;
    const ShapeGroups& groups = work.type->shape_groups;
    for (const std::uint32_t s : groups.loose)
        if (!std::isfinite(work.shapes[s].margin)) return work.type->shapes[s].body;
    for (std::size_t k = 0; k < work.crowds.size(); ++k)
        if (!std::isfinite(work.crowds[k].margin)) return groups.crowds[k].body;
    return std::nullopt;
}

void note_beyond_numbers(const RobotWork& work, int body, StepReport& report) {
    note_failure(work.id, true, joint_of_body(*work.type, body), report);
}

void note_not_finite(const RobotWork& work, StepReport& report) {
    note_failure(work.id, false, broken_joint(*work.type, *work.state), report);
}

void note_failure_of(const StepReport& other, StepReport& report) {
    if (other.not_finite.valid())
        note_failure(other.not_finite, other.beyond_numbers, other.not_finite_joint, report);
}

}  // namespace roboss
