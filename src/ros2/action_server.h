// ActionServer: an action of a node: its services send_goal, cancel_goal and get_result, its topics feedback
// and status. It keeps goals and their states as ROS 2 has them (design.ros2.org, "Actions"); what a goal
// means is its owner's affair.
//
//   accepted -> executing -> succeeded | aborted
//               executing -> canceling -> canceled | succeeded | aborted
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ros2/service_table.h"
#include "ros2_types/action_type.h"

namespace roboss::ros2 {

/// The id of a goal, chosen by its client.
using GoalId = std::array<std::uint8_t, 16>;

/// The states of the goals of an action, and what they are told by: the same for all actions.
class GoalBook {
  public:
    /// A book for this action of a node.
    GoalBook(Transport& transport, EntityId node, const std::string& action);
    ~GoalBook();
    GoalBook(const GoalBook&) = delete;
    GoalBook& operator=(const GoalBook&) = delete;

    /// True if there is such a goal, ended ones included.
    bool has(const GoalId& goal) const { return goals_.contains(goal); }
    /// Status of a goal; GoalStatus::kUnknown: there is none.
    std::int8_t status(const GoalId& goal) const;
    /// True while a goal has not ended.
    bool is_active(const GoalId& goal) const;
    /// Notes a new goal as executing.
    void begin(const GoalId& goal, const Time& stamp);
    /// Changes the status of a goal.
    void set(const GoalId& goal, std::int8_t status);
    /// The active goals that a request to cancel means, and its return code if there are none.
    std::vector<GoalId> meant_by(const CancelGoal::Request& request, std::int8_t& code) const;
    /// Id and stamp of a goal, for replies to requests to cancel.
    GoalInfo info(const GoalId& goal) const;
    /// Lets time pass; forgets goals that ended long ago. Returns those.
    std::vector<GoalId> advance(std::int64_t now_ms);
    /// Why its topic could not be made; empty: it was.
    const std::string& problem() const { return problem_; }

  private:
    struct Goal {
        Time stamp;
        std::int8_t status = GoalStatus::kExecuting;
        std::int64_t ended_ms = 0;  // of those that have ended
    };
    void publish();

    Transport& transport_;
    EntityId topic_ = 0;
    std::string problem_;
    std::map<GoalId, Goal> goals_;
    std::int64_t now_ms_ = 0;
};

/// See the top of the file.
template <ActionType A>
class ActionServer {
  public:
    /// The owner's part with goals. None of these is called from within another one of them.
    struct Owner {
        /// A goal has come: true if it is accepted and executes from now on.
        std::function<bool(const GoalId&, const typename A::Goal&)> begin;
        /// An executing goal is to be cancelled: the owner calls end() some time later.
        std::function<void(const GoalId&)> cancel;
        /// Simulated time, for stamps.
        std::function<Time()> now;
    };

    /// `action`: its name, "/arm/follow_joint_trajectory". `transport` outlives it.
    ActionServer(Transport& transport, EntityId node, const std::string& action, Owner owner)
        : transport_(transport),
          owner_(std::move(owner)),
          goals_(transport, node, action),
          table_(transport, node) {
        if (!goals_.problem().empty()) table_.notice(goals_.problem());
        const Result<EntityId> topic = transport.add_publisher(
            node, action + "/_action/feedback", type_of<FeedbackMessage<A>>(), {true, false, 10});
        if (topic)
            feedback_ = topic.value();
        else
            table_.notice(topic.error().text());
        table_.add<SendGoal<A>>(
            action + "/_action/send_goal",
            [this](const auto& request, const auto& reply) { take_goal(request, reply); });
        table_.add<CancelGoal>(
            action + "/_action/cancel_goal",
            [this](const auto& request, const auto& reply) { take_cancel(request, reply); });
        table_.add<GetResult<A>>(
            action + "/_action/get_result",
            [this](const auto& request, const auto& reply) { take_question(request.goal_id.uuid, reply); });
    }
    ~ActionServer() {
        if (feedback_ != 0) transport_.remove(feedback_);
    }
    ActionServer(const ActionServer&) = delete;
    ActionServer& operator=(const ActionServer&) = delete;

    /// Serves a call. False: it is not for this action.
    bool take(const Incoming& call) { return table_.take(call); }
    /// Lets time pass.
    void advance(std::int64_t now_ms) {
        for (const GoalId& gone : goals_.advance(now_ms)) results_.erase(gone), waiting_.erase(gone);
    }
    /// Reports how far a goal is; costs nothing while nobody listens.
    void feedback(const GoalId& goal, const typename A::Feedback& feedback) {
        if (has_listeners()) transport_.publish(feedback_, to_cdr(FeedbackMessage<A>{{goal}, feedback}));
    }
    /// True if somebody listens to feedback.
    bool has_listeners() const { return feedback_ != 0 && transport_.subscribers(feedback_) > 0; }
    /// A goal has ended: GoalStatus::kSucceeded, kAborted, or kCanceled after a cancel.
    void end(const GoalId& goal, std::int8_t status, const typename A::Result& result) {
        if (!goals_.is_active(goal)) return;
        goals_.set(goal, status);
        results_[goal] = result;
        for (const Reply<GetResult<A>>& reply : waiting_[goal]) reply({status, result});
        waiting_.erase(goal);
    }
    /// True while a goal has not ended.
    bool is_active(const GoalId& goal) const { return goals_.is_active(goal); }
    /// As of ServiceTable.
    std::vector<std::string> take_notices() { return table_.take_notices(); }

  private:
    static constexpr std::size_t kMostWaiting = 100;  // questions for the result of one goal

    void take_goal(const typename SendGoal<A>::Request& request, const Reply<SendGoal<A>>& reply) {
        const GoalId& goal = request.goal_id.uuid;
        const Time now = owner_.now();
        // The reply comes first: a client does not know a goal before.
        const bool is_new = !goals_.has(goal);
        if (!is_new) return reply({false, now});
        goals_.begin(goal, now);
        const bool accepted = owner_.begin(goal, request.goal);
        if (!accepted) goals_.set(goal, GoalStatus::kUnknown);
        reply({accepted, now});
    }
    void take_cancel(const CancelGoal::Request& request, const Reply<CancelGoal>& reply) {
        CancelGoal::Response response;
        const std::vector<GoalId> meant = goals_.meant_by(request, response.return_code);
        for (const GoalId& goal : meant) response.goals_canceling.push_back(goals_.info(goal));
        for (const GoalId& goal : meant) goals_.set(goal, GoalStatus::kCanceling);
        reply(response);
        for (const GoalId& goal : meant) owner_.cancel(goal);
    }
    void take_question(const GoalId& goal, const Reply<GetResult<A>>& reply) {
        const auto known = results_.find(goal);
        if (known != results_.end()) return reply({goals_.status(goal), known->second});
        if (!goals_.is_active(goal)) return reply({GoalStatus::kUnknown, {}});
        if (waiting_[goal].size() < kMostWaiting) waiting_[goal].push_back(reply);
    }

    Transport& transport_;
    Owner owner_;
    GoalBook goals_;
    ServiceTable table_;
    EntityId feedback_ = 0;
    std::map<GoalId, typename A::Result> results_;
    std::map<GoalId, std::vector<Reply<GetResult<A>>>> waiting_;
};

}  // namespace roboss::ros2
