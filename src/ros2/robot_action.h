// RobotAction: an action that a robot executes, one goal at a time: a newer goal takes the place of the one
// before. A cancel holds the robot where it is; a reset or a change of the run ends the goal.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ros2/action_server.h"
#include "ros2/run_control.h"
#include "ros2/stamps.h"

namespace roboss::ros2 {

/// See the top of the file. A change of the world ends it: make another one.
class RobotAction {
  public:
    virtual ~RobotAction() = default;
    /// Serves a call, or takes a message. False: it is not for this action.
    virtual bool take(const Incoming& call) = 0;
    /// Continues the goal. Called after each observation; orders are given here.
    virtual void advance(std::int64_t now_ms) = 0;
    /// Goals that were refused and why, since the last call.
    virtual std::vector<std::string> take_notices() = 0;
};

/// The end of a goal of the action A.
template <class A>
struct GoalEnd {
    std::int8_t status = GoalStatus::kSucceeded;  ///< GoalStatus::kSucceeded or kAborted
    typename A::Result result;                    ///< as the client gets it
};

/// The action A. An Execution is a goal that is executed, and gives orders:
///     A::Feedback feedback(const RunControl&) const;
///     std::optional<GoalEnd<A>> end(const RunControl&);   // where it has ended; called after each
///     observation void follow(RunControl&, Tick period);              // the orders of a period that begins
///     now void hold(RunControl&);                             // stay where you are A::Result
///     dropped(std::int8_t status, const char* why) const;   // it ends by a cancel, or is aborted
template <ActionType A, class Execution>
class GoalByGoal : public RobotAction {
  public:
    /// `action`: "/arm/joint_trajectory_controller/follow_joint_trajectory". `transport` and `run` outlive
    /// it.
    GoalByGoal(Transport& transport, EntityId node, const std::string& action, RunControl& run)
        : run_(run),
          action_(action),
          server_(transport, node, action,
                  {[this](const GoalId& id, const typename A::Goal& goal) { return begin(id, goal); },
                   [this](const GoalId&) { cancel(); },
                   [this] { return stamp_of(run_.model(), std::max<Tick>(run_.tick(), 0)); }}) {}

    bool take(const Incoming& call) override { return server_.take(call); }
    void advance(std::int64_t now_ms) override;
    std::vector<std::string> take_notices() override {
        std::vector<std::string> all = server_.take_notices();
        std::ranges::move(std::exchange(notices_, {}), std::back_inserter(all));
        return all;
    }

  protected:
    /// Begins to execute a goal; an Error: why it cannot be.
    virtual Result<Execution> execute(const typename A::Goal& goal) = 0;

    /// Executes a goal from now on. `id`: none: no client waits for it. False: it was refused.
    bool begin(const std::optional<GoalId>& id, const typename A::Goal& goal);
    /// The robot holds the position that it has.
    void stop(const char* why, std::int8_t status) {
        if (!now_) return;
        now_->hold(run_);
        end({status, now_->dropped(status, why)});
    }
    /// Says something for the log; of many lines, the first are kept.
    void notice(const std::string& line) {
        constexpr std::size_t kMost = 20;
        if (notices_.size() < kMost) notices_.push_back(action_ + ": " + line);
    }
    /// The run.
    RunControl& run() { return run_; }

  private:
    void cancel() { stop("cancelled: the joints hold their positions", GoalStatus::kCanceled); }
    void drop(const char* why) { end({GoalStatus::kAborted, now_->dropped(GoalStatus::kAborted, why)}); }
    void end(const GoalEnd<A>& how) {
        now_.reset();
        if (const std::optional<GoalId> id = std::exchange(id_, {})) server_.end(*id, how.status, how.result);
    }

    RunControl& run_;
    std::string action_;
    std::optional<GoalId> id_;
    std::optional<Execution> now_;
    Tick seen_ = 0;          // the last tick at which it was looked at
    std::uint64_t era_ = 0;  // of the run, when the goal began
    std::vector<std::string> notices_;
    ActionServer<A> server_;
};

template <ActionType A, class Execution>
bool GoalByGoal<A, Execution>::begin(const std::optional<GoalId>& id, const typename A::Goal& goal) {
    Result<Execution> execution = execute(goal);
    if (!execution) return notice("a goal was refused: " + execution.error().message), false;
    if (now_) drop("a newer goal took its place");
    now_.emplace(std::move(execution).value());
    id_ = id, seen_ = run_.tick(), era_ = run_.era();
    now_->follow(run_, 1);
    return true;
}

template <ActionType A, class Execution>
void GoalByGoal<A, Execution>::advance(std::int64_t now_ms) {
    server_.advance(now_ms);
    if (!now_) return;
    if (run_.era() != era_) return drop("the run was reset or changed");
    if (run_.tick() <= seen_) return;
    const Tick period = run_.tick() - seen_;
    seen_ = run_.tick();
    const std::optional<GoalEnd<A>> ended = now_->end(run_);
    if (id_ && server_.has_listeners()) server_.feedback(*id_, now_->feedback(run_));
    if (!ended) return now_->follow(run_, period);
    if (ended->status != GoalStatus::kSucceeded) now_->hold(run_);
    end(*ended);
}

}  // namespace roboss::ros2
