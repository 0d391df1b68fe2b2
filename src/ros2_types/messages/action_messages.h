// Interfaces that all actions share: unique_identifier_msgs and action_msgs.
#pragma once

#include "ros2_types/messages/standard_messages.h"

namespace roboss::ros2 {

/// unique_identifier_msgs/msg/UUID
struct Uuid {
    static constexpr const char* kName = "unique_identifier_msgs/msg/UUID";
    std::array<std::uint8_t, 16> uuid{};  ///< RFC 4122

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("uuid", m.uuid);
    }
};

/// action_msgs/msg/GoalInfo
struct GoalInfo {
    static constexpr const char* kName = "action_msgs/msg/GoalInfo";
    Uuid goal_id;  ///< of the goal
    Time stamp;    ///< when it was accepted

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("goal_id", m.goal_id);
        visit("stamp", m.stamp);
    }
};

/// action_msgs/msg/GoalStatus
struct GoalStatus {
    static constexpr const char* kName = "action_msgs/msg/GoalStatus";
    static constexpr std::int8_t kUnknown = 0;
    static constexpr std::int8_t kAccepted = 1;
    static constexpr std::int8_t kExecuting = 2;
    static constexpr std::int8_t kCanceling = 3;
    static constexpr std::int8_t kSucceeded = 4;
    static constexpr std::int8_t kCanceled = 5;
    static constexpr std::int8_t kAborted = 6;
    GoalInfo goal_info;      ///< which goal
    std::int8_t status = 0;  ///< one of the constants

    /// Calls visit(name, value) for each constant of the definition.
    template <class Visitor>
    static void constants(Visitor&& visit) {
        visit("STATUS_UNKNOWN", kUnknown);
        visit("STATUS_ACCEPTED", kAccepted);
        visit("STATUS_EXECUTING", kExecuting);
        visit("STATUS_CANCELING", kCanceling);
        visit("STATUS_SUCCEEDED", kSucceeded);
        visit("STATUS_CANCELED", kCanceled);
        visit("STATUS_ABORTED", kAborted);
    }
    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("goal_info", m.goal_info);
        visit("status", m.status);
    }
};

/// action_msgs/msg/GoalStatusArray
struct GoalStatusArray {
    static constexpr const char* kName = "action_msgs/msg/GoalStatusArray";
    std::vector<GoalStatus> status_list;  ///< of all goals that are remembered

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("status_list", m.status_list);
    }
};

/// action_msgs/srv/CancelGoal: of one goal, of those accepted up to a time, or of all.
struct CancelGoal {
    static constexpr const char* kName = "action_msgs/srv/CancelGoal";
    /// The call.
    struct Request {
        static constexpr const char* kName = "action_msgs/srv/CancelGoal_Request";
        GoalInfo goal_info;  ///< id and stamp 0: all goals

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("goal_info", m.goal_info);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "action_msgs/srv/CancelGoal_Response";
        static constexpr std::int8_t kNone = 0;
        static constexpr std::int8_t kRejected = 1;
        static constexpr std::int8_t kUnknownGoalId = 2;
        static constexpr std::int8_t kGoalTerminated = 3;
        std::int8_t return_code = 0;            ///< one of the constants
        std::vector<GoalInfo> goals_canceling;  ///< that will end

        /// Calls visit(name, value) for each constant of the definition.
        template <class Visitor>
        static void constants(Visitor&& visit) {
            visit("ERROR_NONE", kNone);
            visit("ERROR_REJECTED", kRejected);
            visit("ERROR_UNKNOWN_GOAL_ID", kUnknownGoalId);
            visit("ERROR_GOAL_TERMINATED", kGoalTerminated);
        }
        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("return_code", m.return_code);
            visit("goals_canceling", m.goals_canceling);
        }
    };
};

}  // namespace roboss::ros2
