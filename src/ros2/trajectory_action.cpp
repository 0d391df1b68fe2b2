// See trajectory_action.h.
#include "ros2/trajectory_action.h"

#include <algorithm>
#include <iterator>
#include <variant>

#include "ros2/action_server.h"
#include "ros2/entities.h"
#include "ros2/stamps.h"
#include "ros2/trajectory_goal.h"

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

template <class Feedback>
Feedback feedback_of(const TrajectoryGoal& goal, const TrajectoryGoal::Sample& sample, const Time& stamp) {
    Feedback feedback;
    feedback.header.stamp = stamp;
    feedback.joint_names = goal.names();
    feedback.desired = message_of(sample.desired), feedback.actual = message_of(sample.actual);
    feedback.error = difference(sample);
    if constexpr (requires { feedback.index; }) feedback.index = static_cast<std::int32_t>(sample.point);
    return feedback;
}

/// The work of a TrajectoryAction, for one layout of feedback.
template <class A>
class Follower {
  public:
    Follower(Transport& transport, EntityId node, const std::string& action, RunControl& run, RobotId robot)
        : run_(run),
          robot_(robot),
          able_(TrajectoryJoints::of(run.model().type_of(robot))),
          server_(transport, node, action,
                  {[this](const GoalId& id, const typename A::Goal& goal) { return begin(id, goal); },
                   [this](const GoalId&) { cancel(); }, [this] { return now(); }}) {}

    bool take(const Incoming& call) { return server_.take(call); }
    void advance(std::int64_t now_ms);
    std::vector<std::string> take_notices() {
        std::vector<std::string> all = server_.take_notices();
        std::ranges::move(std::exchange(notices_, {}), std::back_inserter(all));
        return all;
    }

  private:
    static constexpr std::size_t kMostNotices = 20;

    Time now() const { return stamp_of(run_.model(), std::max<Tick>(run_.tick(), 0)); }
    bool begin(const GoalId& id, const typename A::Goal& wanted);
    void cancel() {
        if (!goal_) return;
        goal_->hold(run_);
        end(GoalStatus::kCanceled, {Outcome::kSuccessful, "cancelled: the joints hold their positions"});
    }
    void end(std::int8_t status, const Outcome& result) {
        goal_.reset();
        server_.end(id_, status, result);
    }

    RunControl& run_;
    RobotId robot_;
    TrajectoryJoints able_;
    GoalId id_{};
    std::optional<TrajectoryGoal> goal_;  // the one that is executed
    Tick seen_ = 0;                       // the last tick at which it was looked at
    std::uint64_t era_ = 0;               // of the run, when the goal began
    std::vector<std::string> notices_;
    ActionServer<A> server_;
};

template <class A>
bool Follower<A>::begin(const GoalId& id, const typename A::Goal& wanted) {
    Result<TrajectoryGoal> goal = TrajectoryGoal::of(wanted, run_, robot_, able_);
    const Result<> begun = goal ? goal.value().begin(run_) : Result<>(goal.error());
    if (!begun) {
        if (notices_.size() < kMostNotices)
            notices_.push_back("a trajectory was refused: " + begun.error().message);
        return false;
    }
    if (goal_) end(GoalStatus::kAborted, {Outcome::kInvalidGoal, "a newer goal took its place"});
    goal_ = std::move(goal).value(), id_ = id;
    seen_ = run_.tick(), era_ = run_.era();
    goal_->follow(run_, 1);
    return true;
}

template <class A>
void Follower<A>::advance(std::int64_t now_ms) {
    server_.advance(now_ms);
    if (!goal_) return;
    if (run_.era() != era_)
        return end(GoalStatus::kAborted, {Outcome::kInvalidGoal, "the run was reset or changed"});
    if (run_.tick() <= seen_) return;
    const Tick period = run_.tick() - seen_;
    seen_ = run_.tick();
    const TrajectoryGoal::Sample sample = goal_->sample(run_);
    if (server_.has_listeners())
        server_.feedback(id_, feedback_of<typename A::Feedback>(*goal_, sample, now()));
    if (const std::optional<Outcome> outcome = goal_->outcome(run_, sample)) {
        if (outcome->error_code == Outcome::kSuccessful) return end(GoalStatus::kSucceeded, *outcome);
        goal_->hold(run_);
        return end(GoalStatus::kAborted, *outcome);
    }
    goal_->follow(run_, period);
}

}  // namespace

struct TrajectoryAction::Parts {
    std::variant<std::unique_ptr<Follower<FollowJointTrajectory>>,
                 std::unique_ptr<Follower<FollowJointTrajectoryBefore63>>>
        follower;
};

TrajectoryAction::TrajectoryAction(Transport& transport, EntityId node, const std::string& action,
                                   RunControl& run, RobotId robot, bool older)
    : parts_(std::make_unique<Parts>()) {
    if (older)
        parts_->follower =
            std::make_unique<Follower<FollowJointTrajectoryBefore63>>(transport, node, action, run, robot);
    else
        parts_->follower =
            std::make_unique<Follower<FollowJointTrajectory>>(transport, node, action, run, robot);
}

TrajectoryAction::~TrajectoryAction() = default;

bool TrajectoryAction::fits(const RobotType& type) {
    return !TrajectoryJoints::of(type).joints.empty();
}

bool TrajectoryAction::take(const Incoming& call) {
    return std::visit([&](const auto& follower) { return follower->take(call); }, parts_->follower);
}

void TrajectoryAction::advance(std::int64_t now_ms) {
    std::visit([&](const auto& follower) { follower->advance(now_ms); }, parts_->follower);
}

std::vector<std::string> TrajectoryAction::take_notices() {
    return std::visit([](const auto& follower) { return follower->take_notices(); }, parts_->follower);
}

}  // namespace roboss::ros2
