// See gripper_action.h.
#include "ros2/gripper_action.h"

#include <cmath>

#include "physics/dynamics/kinematics.h"
#include "physics/dynamics/motor_effort.h"
#include "ros2_types/messages/gripper_messages.h"

namespace roboss::ros2 {

namespace {

/// The joint of a gripper.
struct Finger {
    RobotId robot;
    JointId joint;
    ControllerEntry entry;
};

/// Where a goal sends the finger.
struct Target {
    double position = 0, max_effort = -1;  // a negative effort: the joint's own bound
};

/// A goal without a name of a joint means the only one.
Result<Target> target_of(const GripperCommand::Goal& goal, const Finger&) {
    return Target{goal.command.position, goal.command.max_effort > 0 ? goal.command.max_effort : -1};
}
Result<Target> target_of(const ParallelGripperCommand::Goal& goal, const Finger& finger) {
    const JointStateMessage& command = goal.command;
    const Error wrong{"the goal is not one position of '" + finger.entry.joints.front() + "'",
                      "give its position", "bad-goal"};
    if (command.position.size() != 1 || command.name.size() > 1) return wrong;
    if (!command.name.empty() && command.name.front() != finger.entry.joints.front()) return wrong;
    const bool has_effort = command.effort.size() == 1 && command.effort.front() > 0;
    return Target{command.position.front(), has_effort ? command.effort.front() : -1};
}

/// What is seen of the finger.
struct Seen {
    Time stamp;
    double position = 0, velocity = 0, effort = 0;
    bool stalled = false, reached = false;
};

JointStateMessage message_of(const Finger& finger, const Seen& seen) {
    JointStateMessage state;
    state.header.stamp = seen.stamp;
    state.name = finger.entry.joints;
    state.position = {seen.position}, state.velocity = {seen.velocity}, state.effort = {seen.effort};
    return state;
}
GripperCommand::Result gripper_result(const GripperCommand&, const Finger&, const Seen& seen) {
    return {seen.position, seen.effort, seen.stalled, seen.reached};
}
ParallelGripperCommand::Result gripper_result(const ParallelGripperCommand&, const Finger& finger,
                                              const Seen& seen) {
    return {message_of(finger, seen), seen.stalled, seen.reached};
}
GripperCommand::Feedback feedback_of(const GripperCommand& action, const Finger& finger, const Seen& seen) {
    return {gripper_result(action, finger, seen)};
}
ParallelGripperCommand::Feedback feedback_of(const ParallelGripperCommand&, const Finger& finger,
                                             const Seen& seen) {
    return {message_of(finger, seen)};
}

/// A goal that is executed.
template <class A>
class GripperExecution {
  public:
    GripperExecution(const Finger& finger, const Target& target, Tick begin)
        : finger_(finger), target_(target), moved_(begin) {}

    /// The motor keeps its setpoint, also when the goal has ended: a gripper keeps pressing.
    Result<> begin(RunControl& run) const { return send(run, target_.position, target_.max_effort); }
    typename A::Feedback feedback(const RunControl&) const { return feedback_of(A{}, finger_, seen_); }
    std::optional<GoalEnd<A>> end(const RunControl& run) {
        look(run);
        const double rest_s = static_cast<double>(run.tick() - moved_) * run.model().dt_s;
        seen_.reached = std::abs(seen_.position - target_.position) <= finger_.entry.goal_tolerance;
        seen_.stalled = !seen_.reached && rest_s >= finger_.entry.stall_timeout_s;
        if (!seen_.reached && !seen_.stalled) return {};
        const bool fine = seen_.reached || finger_.entry.allow_stalling;
        return GoalEnd<A>{fine ? GoalStatus::kSucceeded : GoalStatus::kAborted,
                          gripper_result(A{}, finger_, seen_)};
    }
    void follow(RunControl&, Tick) const {}
    /// A finger that has stalled keeps pressing; others stay where they are.
    void hold(RunControl& run) const {
        if (!seen_.stalled) (void)send(run, seen_.position, -1);  // the run reports a refusal
    }
    typename A::Result dropped(std::int8_t, const char*) const { return gripper_result(A{}, finger_, seen_); }

    /// Sees where the finger is.
    void look(const RunControl& run) {
        const RobotType& type = run.model().type_of(finger_.robot);
        const RobotState& state = run.states()[finger_.robot.index()];
        const JointState at = joint_state(type, state, finger_.joint);
        if (std::abs(at.velocity) > finger_.entry.stall_velocity) moved_ = run.tick();
        seen_ = {stamp_of(run.model(), run.tick()), at.position, at.velocity,
                 motor_effort(run.model(), type, state, finger_.joint)};
    }

  private:
    Result<> send(RunControl& run, double position, double max_effort) const {
        return run.order(finger_.robot,
                         SetJoint{finger_.joint, 0, MotorMode::kPosition, position, max_effort});
    }

    Finger finger_;
    Target target_;
    Tick moved_ = 0;  // the last tick at which it moved
    Seen seen_;
};

template <class A>
class GripperServer final : public GoalByGoal<A, GripperExecution<A>> {
  public:
    GripperServer(Transport& transport, EntityId node, const std::string& name, RunControl& run,
                  Finger finger)
        : GoalByGoal<A, GripperExecution<A>>(transport, node, name + "/gripper_cmd", run),
          finger_(std::move(finger)) {}

  private:
    Result<GripperExecution<A>> execute(const typename A::Goal& goal) override {
        RunControl& run = this->run();
        if (run.tick() < 0) return Error{"the world was not seen yet", "send the goal again", "no-world"};
        const Result<Target> target = target_of(goal, finger_);
        if (!target) return target.error();
        if (!std::isfinite(target.value().position) || !std::isfinite(target.value().max_effort))
            return Error{"the goal is not finite", "give a position in m or rad", "bad-goal"};
        GripperExecution<A> execution(finger_, target.value(), run.tick());
        execution.look(run);
        if (const Result<> begun = execution.begin(run); !begun) return begun.error();
        return execution;
    }

    Finger finger_;
};

}  // namespace

std::unique_ptr<RobotAction> gripper_action(Transport& transport, EntityId node, const std::string& name,
                                            RunControl& run, RobotId robot,
                                            const RobotController& controller) {
    Finger finger{robot, controller.joints.front(), *controller.entry};
    if (controller.entry->kind == ControllerEntry::Kind::kParallelGripper)
        return std::make_unique<GripperServer<ParallelGripperCommand>>(transport, node, name, run,
                                                                       std::move(finger));
    return std::make_unique<GripperServer<GripperCommand>>(transport, node, name, run, std::move(finger));
}

}  // namespace roboss::ros2
