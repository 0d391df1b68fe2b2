// See face_services.h.
#include "ros2/face_services.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "ros2/gripper_action.h"
#include "ros2/robot_names.h"
#include "ros2/trajectory_action.h"

namespace roboss::ros2 {

namespace {

constexpr std::size_t kActionsInATurn = 5;  // each takes some milliseconds

/// Robots that are driven in another way (by velocities) have no trajectories.
bool follows_trajectories(const RobotType& type) {
    const bool has_controller = std::ranges::any_of(type.onboard, [](const OnboardInfo& onboard) {
        return std::holds_alternative<JointTrajectoryControllerSpec>(onboard.spec.parameters);
    });
    return (has_controller || type.channels.empty()) && !TrajectoryJoints::of(type).joints.empty();
}

void append(std::vector<std::string>& to, std::vector<std::string> from) {
    std::move(from.begin(), from.end(), std::back_inserter(to));
}

}  // namespace

FaceServices::FaceServices(Transport& transport, EntityId world_node, FaceServiceOptions options)
    : transport_(transport),
      world_node_(world_node),
      options_(std::move(options)),
      simulation_(transport, world_node, run_, options_.simulation),
      parameters_(transport, world_node, "/roboss") {
    parameters_.put("use_sim_time", parameter_value(true), "stamps are simulated time");
}

void FaceServices::use(BusClient& client, const std::vector<EntityId>& nodes, std::vector<std::string> names,
                       std::shared_ptr<const Controllers> controllers) {
    actions_.clear();
    run_.use(client);
    names_ = std::move(names), nodes_ = nodes, next_ = 0;
    controllers_ = std::move(controllers);
    if (gazebo_ && world_ == client.model().name) return;
    world_ = client.model().name;
    gazebo_.reset();
    gazebo_.emplace(transport_, world_node_, ros_name(world_), simulation_);
}

void FaceServices::put(const std::string& parameter, double value, const std::string& description) {
    parameters_.put(parameter, parameter_value(value), description);
}

/// Some in each turn, for a thousand at once would stop the world's topics for seconds.
void FaceServices::add_actions() {
    std::size_t made = 0;
    while (next_ < nodes_.size() && made < kActionsInATurn) made += add_actions(RobotId(next_++));
    if (made > 0) transport_.announce();
}

/// Those of a robot; how many.
std::size_t FaceServices::add_actions(RobotId robot) {
    const RobotType& type = run_.model().type_of(robot);
    const std::string& robot_name = names_[robot.index()];
    const EntityId node = nodes_[robot.index()];
    const std::size_t before = actions_.size();
    const auto follow = [&](const std::string& name, TrajectoryJoints joints) {
        actions_.push_back(trajectory_action(transport_, node, below(robot_name, name), run_, robot,
                                             std::move(joints), options_.older_feedback));
    };
    std::vector<RobotController> own;
    if (controllers_) own = controllers_of(*controllers_, type, robot_name);
    for (const RobotController& controller : own) {
        const ControllerEntry& entry = *controller.entry;
        if (entry.kind == ControllerEntry::Kind::kTrajectory)
            follow(entry.name, TrajectoryJoints::of(type, controller.joints));
        else if (entry.kind == ControllerEntry::Kind::kGripper ||
                 entry.kind == ControllerEntry::Kind::kParallelGripper)
            actions_.push_back(
                gripper_action(transport_, node, below(robot_name, entry.name), run_, robot, controller));
    }
    if (own.empty() && follows_trajectories(type))
        follow("joint_trajectory_controller", TrajectoryJoints::of(type));
    return actions_.size() - before;
}

bool FaceServices::take(const Incoming& call) {
    const auto takes = [&](const auto& action) { return action->take(call); };
    return simulation_.take(call) || (gazebo_ && gazebo_->take(call)) || parameters_.take(call) ||
           std::ranges::any_of(actions_, takes);
}

bool FaceServices::advance(std::int64_t now_ms) {
    run_.advance();
    simulation_.advance(now_ms);
    if (run_.tick() < 0) return run_.take_ordered();
    add_actions();
    for (const std::unique_ptr<RobotAction>& action : actions_) action->advance(now_ms);
    return run_.take_ordered();
}

std::vector<std::string> FaceServices::take_notices() {
    std::vector<std::string> notices = simulation_.take_notices();
    if (gazebo_) append(notices, gazebo_->take_notices());
    append(notices, parameters_.take_notices());
    for (const std::unique_ptr<RobotAction>& action : actions_) append(notices, action->take_notices());
    return notices;
}

}  // namespace roboss::ros2
