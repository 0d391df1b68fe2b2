// See onboard_kinds/joint_pose_trajectory.h.
#include "onboard/controllers.h"

namespace roboss {

void run(const JointPoseTrajectorySpec& spec, OnboardContext& c) {
    using Spec = JointPoseTrajectorySpec;
    constexpr double kRounding = 1e-9;  // s
    const std::span<double> memory = c.memory();
    const std::span<const double> points = c.list(0);
    const std::size_t width = c.joint_count() + 1, count = points.size() / width;
    if (const auto at = static_cast<double>(c.commanded_at(0)); at > memory[Spec::kSeen]) {
        memory[Spec::kSeen] = at, memory[Spec::kNext] = c.time();
        memory[Spec::kIndex] = count > 0 ? 0 : -1;
    }
    if (memory[Spec::kIndex] < 0) return;
    const double period = spec.update_rate > 0 ? 1 / spec.update_rate : 0;
    if (c.time() + kRounding < memory[Spec::kLooked] + period) return;
    memory[Spec::kLooked] = c.time();
    if (c.time() + kRounding < memory[Spec::kNext]) return;
    const auto index = static_cast<std::size_t>(memory[Spec::kIndex]);
    const std::span<const double> point = points.subspan(index * width, width);
    for (std::size_t j = 0; j < c.joint_count(); ++j)
        c.state().q[static_cast<std::size_t>(c.info().axes[j].q_index)] = point[j + 1];
    memory[Spec::kNext] += point[0];
    memory[Spec::kIndex] = index + 1 < count ? static_cast<double>(index + 1) : -1;
}

}  // namespace roboss
