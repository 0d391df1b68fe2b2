// See trajectory_action.h.
#include "ros2/trajectory_action.h"

#include "ros2_types/cdr.h"

namespace roboss::ros2 {

namespace {

using Outcome = FollowJointTrajectory::Result;

JointTrajectoryPoint message_of(const std::vector<JointPoint>& joints) {
    JointTrajectoryPoint point;
    for (const JointPoint& joint : joints) {
        point.positions.push_back(joint.position), point.velocities.push_back(joint.velocity);
        point.accelerations.push_back(joint.acceleration);
    }
    return point;
}

JointTrajectoryPoint difference(const TrajectoryGoal::Sample& sample) {
    JointTrajectoryPoint point;
    for (std::size_t j = 0; j < sample.desired.size(); ++j) {
        point.positions.push_back(sample.desired[j].position - sample.actual[j].position);
        point.velocities.push_back(sample.desired[j].velocity - sample.actual[j].velocity);
    }
    return point;
}

/// A goal that is executed, for one layout of feedback.
template <class A>
class TrajectoryExecution {
  public:
    explicit TrajectoryExecution(TrajectoryGoal goal) : goal_(std::move(goal)) {}

    typename A::Feedback feedback(const RunControl& run) const {
        typename A::Feedback feedback;
        feedback.header.stamp = stamp_of(run.model(), run.tick());
        feedback.joint_names = goal_.names();
        feedback.desired = message_of(sample_.desired), feedback.actual = message_of(sample_.actual);
        feedback.error = difference(sample_);
        if constexpr (requires { feedback.index; }) feedback.index = static_cast<std::int32_t>(sample_.point);
        return feedback;
    }
    std::optional<GoalEnd<A>> end(const RunControl& run) {
        sample_ = goal_.sample(run);
        const std::optional<Outcome> outcome = goal_.outcome(run, sample_);
        if (!outcome) return {};
        const bool fine = outcome->error_code == Outcome::kSuccessful;
        return GoalEnd<A>{fine ? GoalStatus::kSucceeded : GoalStatus::kAborted, *outcome};
    }
    void follow(RunControl& run, Tick period) const { goal_.follow(run, period); }
    void hold(RunControl& run) const { goal_.hold(run); }
    Outcome dropped(std::int8_t status, const char* why) const {
        return {status == GoalStatus::kCanceled ? Outcome::kSuccessful : Outcome::kInvalidGoal, why};
    }

  private:
    TrajectoryGoal goal_;
    TrajectoryGoal::Sample sample_;  // at the last observation
};

template <class A>
class TrajectoryServer final : public GoalByGoal<A, TrajectoryExecution<A>> {
  public:
    TrajectoryServer(Transport& transport, EntityId node, const std::string& controller, RunControl& run,
                     RobotId robot, TrajectoryJoints joints)
        : Base(transport, node, controller + "/follow_joint_trajectory", run),
          transport_(transport),
          robot_(robot),
          joints_(std::move(joints)) {
        if (joints_.channel) return;
        const Result<EntityId> topic = transport.add_subscription(node, controller + "/joint_trajectory",
                                                                  type_of<JointTrajectory>(), Qos{});
        if (topic)
            topic_ = topic.value();
        else
            this->notice(topic.error().text());
    }
    ~TrajectoryServer() override {
        if (topic_ != 0) transport_.remove(topic_);
    }
    TrajectoryServer(const TrajectoryServer&) = delete;
    TrajectoryServer& operator=(const TrajectoryServer&) = delete;

    bool take(const Incoming& call) override {
        if (topic_ == 0 || call.entity != topic_) return Base::take(call);
        const Result<JointTrajectory> message = from_cdr<JointTrajectory>(call.bytes);
        if (!message) return this->notice(message.error().message), true;
        if (message.value().points.empty())  // as ros2_control has it
            return this->stop("an empty trajectory: the joints hold their positions", GoalStatus::kAborted),
                   true;
        typename A::Goal goal;
        goal.trajectory = message.value();
        (void)this->begin(std::nullopt, goal);
        return true;
    }

  private:
    using Base = GoalByGoal<A, TrajectoryExecution<A>>;

    Result<TrajectoryExecution<A>> execute(const typename A::Goal& wanted) override {
        Result<TrajectoryGoal> goal = TrajectoryGoal::of(wanted, this->run(), robot_, joints_);
        if (!goal) return goal.error();
        if (const Result<> begun = goal.value().begin(this->run()); !begun) return begun.error();
        return TrajectoryExecution<A>(std::move(goal).value());
    }

    Transport& transport_;
    RobotId robot_;
    TrajectoryJoints joints_;
    EntityId topic_ = 0;
};

}  // namespace

std::unique_ptr<RobotAction> trajectory_action(Transport& transport, EntityId node,
                                               const std::string& controller, RunControl& run, RobotId robot,
                                               TrajectoryJoints joints, bool older) {
    if (older)
        return std::make_unique<TrajectoryServer<FollowJointTrajectoryBefore63>>(
            transport, node, controller, run, robot, std::move(joints));
    return std::make_unique<TrajectoryServer<FollowJointTrajectory>>(transport, node, controller, run, robot,
                                                                     std::move(joints));
}

}  // namespace roboss::ros2
