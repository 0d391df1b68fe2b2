// See onboard_kinds/joint_trajectory_controller.h.
#include "onboard/controllers.h"
#include "onboard/pid.h"

namespace roboss {
namespace {

constexpr double kRounding = 1e-9;  // s: a point's time and the tick that it falls on

/// The numbers of one joint.
std::span<double> of_joint(std::span<double> memory, std::size_t joint) {
    return memory.subspan(
        JointTrajectoryControllerSpec::kHeadSize + JointTrajectoryControllerSpec::kJointSize * joint,
        JointTrajectoryControllerSpec::kJointSize);
}

/// Takes the targets of a row of the command.
void take_targets(std::span<const double> row, std::span<double> memory) {
    for (std::size_t j = 0; 3 * j + 1 < row.size(); ++j) {
        const std::span<double> joint = of_joint(memory, j);
        joint[JointTrajectoryControllerSpec::kPosition] = row[3 * j + 1];
        joint[JointTrajectoryControllerSpec::kVelocity] = row[3 * j + 2];
        joint[JointTrajectoryControllerSpec::kEffort] = row[3 * j + 3];
    }
}

/// Goes on to the point that is to be reached next.
void advance(OnboardContext& c, std::span<double> memory) {
    const std::span<const double> points = c.list(0);
    const std::size_t width = 3 * c.joint_count() + 1, count = points.size() / width;
    const auto commanded = static_cast<double>(c.commanded_at(0));
    bool is_new = false;
    if (commanded > memory[JointTrajectoryControllerSpec::kSeen]) {
        memory[JointTrajectoryControllerSpec::kSeen] = commanded,
        memory[JointTrajectoryControllerSpec::kStart] = static_cast<double>(c.tick());
        memory[JointTrajectoryControllerSpec::kIndex] = memory[JointTrajectoryControllerSpec::kProgress] = 0;
        memory[JointTrajectoryControllerSpec::kIsActive] = count > 0 ? 1 : 0;
        is_new = true;
    }
    if (memory[JointTrajectoryControllerSpec::kIsActive] == 0) return;
    const double elapsed =
        (static_cast<double>(c.tick()) - memory[JointTrajectoryControllerSpec::kStart]) * c.dt();
    auto index = static_cast<std::size_t>(memory[JointTrajectoryControllerSpec::kIndex]);
    const std::size_t before = index;
    while (index + 1 < count && points[index * width] + kRounding < elapsed) ++index;
    if (!is_new && index == before) return;
    take_targets(points.subspan(index * width, width), memory);
    memory[JointTrajectoryControllerSpec::kIndex] = static_cast<double>(index);
    memory[JointTrajectoryControllerSpec::kProgress] =
        static_cast<double>(index + 1) / static_cast<double>(count);
    if (index + 1 == count) memory[JointTrajectoryControllerSpec::kIsActive] = 0;
}

}  // namespace

void run(const JointTrajectoryControllerSpec& spec, OnboardContext& c) {
    const std::span<double> memory = c.memory();
    advance(c, memory);
    for (std::size_t j = 0; j < c.joint_count(); ++j) {
        const std::span<double> joint = of_joint(memory, j);
        const double by_position =
            update_pid(spec.position.of(j), c.position(j) - joint[JointTrajectoryControllerSpec::kPosition],
                       c.dt(), {joint, JointTrajectoryControllerSpec::kPositionPid});
        const double by_velocity =
            update_pid(spec.velocity.of(j), c.velocity(j) - joint[JointTrajectoryControllerSpec::kVelocity],
                       c.dt(), {joint, JointTrajectoryControllerSpec::kVelocityPid});
        c.push_joint(j, by_position + by_velocity + joint[JointTrajectoryControllerSpec::kEffort]);
    }
}

}  // namespace roboss
