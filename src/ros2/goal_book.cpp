// See action_server.h.
#include "ros2/action_server.h"

#include <algorithm>
#include <tuple>

namespace roboss::ros2 {

namespace {

constexpr std::int64_t kKept_ms = 900'000;  // how long a result may be asked for, as in rcl
constexpr std::size_t kMostEnded = 100;     // goals that have ended and are kept

bool is_over(std::int8_t status) {
    return status >= GoalStatus::kSucceeded || status == GoalStatus::kUnknown;
}

bool is_zero(const Time& t) {
    return t.sec == 0 && t.nanosec == 0;
}

bool is_later(const Time& a, const Time& b) {
    return std::tie(a.sec, a.nanosec) > std::tie(b.sec, b.nanosec);
}

}  // namespace

GoalBook::GoalBook(Transport& transport, EntityId node, const std::string& action) : transport_(transport) {
    const Result<EntityId> topic = transport.add_publisher(node, action + "/_action/status",
                                                           type_of<GoalStatusArray>(), {true, true, 1});
    if (topic)
        topic_ = topic.value();
    else
        problem_ = topic.error().text();
    if (topic_ != 0) publish();
}

GoalBook::~GoalBook() {
    if (topic_ != 0) transport_.remove(topic_);
}

std::int8_t GoalBook::status(const GoalId& goal) const {
    const auto known = goals_.find(goal);
    return known == goals_.end() ? GoalStatus::kUnknown : known->second.status;
}

bool GoalBook::is_active(const GoalId& goal) const {
    return !is_over(status(goal));
}

void GoalBook::begin(const GoalId& goal, const Time& stamp) {
    goals_[goal] = {stamp, GoalStatus::kExecuting, 0};
    publish();
}

void GoalBook::set(const GoalId& goal, std::int8_t status) {
    if (status == GoalStatus::kUnknown) {
        goals_.erase(goal);  // it was not accepted
    } else {
        Goal& known = goals_[goal];
        known.status = status, known.ended_ms = now_ms_;
    }
    publish();
}

GoalInfo GoalBook::info(const GoalId& goal) const {
    const auto known = goals_.find(goal);
    return {{goal}, known == goals_.end() ? Time{} : known->second.stamp};
}

/// A goal by its id; or all that were accepted up to a time; or both; all, if neither is given.
std::vector<GoalId> GoalBook::meant_by(const CancelGoal::Request& request, std::int8_t& code) const {
    using Response = CancelGoal::Response;
    const GoalId wanted = request.goal_info.goal_id.uuid;
    const bool has_id = wanted != GoalId{};
    const Time& until = request.goal_info.stamp;
    std::vector<GoalId> meant;
    for (const auto& [id, goal] : goals_) {
        const bool by_time = is_zero(until) ? !has_id : !is_later(goal.stamp, until);
        if ((by_time || id == wanted) && goal.status == GoalStatus::kExecuting) meant.push_back(id);
    }
    code = Response::kNone;
    if (!meant.empty() || !has_id) return meant;
    code = !goals_.contains(wanted)            ? Response::kUnknownGoalId
           : is_over(goals_.at(wanted).status) ? Response::kGoalTerminated
                                               : Response::kRejected;
    return meant;
}

std::vector<GoalId> GoalBook::advance(std::int64_t now_ms) {
    now_ms_ = now_ms;
    std::vector<std::pair<std::int64_t, GoalId>> ended;
    for (const auto& [id, goal] : goals_)
        if (is_over(goal.status)) ended.emplace_back(goal.ended_ms, id);
    std::ranges::sort(ended);
    std::vector<GoalId> gone;
    for (std::size_t i = 0; i < ended.size(); ++i)
        if (now_ms - ended[i].first >= kKept_ms || ended.size() - i > kMostEnded)
            gone.push_back(ended[i].second);
    for (const GoalId& goal : gone) goals_.erase(goal);
    return gone;
}

void GoalBook::publish() {
    if (topic_ == 0) return;
    GoalStatusArray all;
    for (const auto& [id, goal] : goals_) all.status_list.push_back({{{id}, goal.stamp}, goal.status});
    transport_.publish(topic_, to_cdr(all));
}

}  // namespace roboss::ros2
