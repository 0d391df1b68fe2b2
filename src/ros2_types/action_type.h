// Actions of ROS 2: a goal that takes time, its feedback and its result. An action is a struct with its name
// and the messages Goal, Result and Feedback. It consists of two services, SendGoal and GetResult, and the
// messages of a topic, FeedbackMessage; all three follow from it.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "ros2_types/messages/action_messages.h"
#include "ros2_types/service_type.h"

namespace roboss::ros2 {

/// An action: see the top of the file.
template <class T>
concept ActionType =
    Message<typename T::Goal> && Message<typename T::Result> && Message<typename T::Feedback> && requires {
    {T::kName};
};

/// A text that can be an argument of a template.
template <std::size_t n>
struct FixedText {
    char text[n]{};  ///< with the 0 at its end
    /// From a literal.
    constexpr FixedText(const char (&from)[n]) { std::copy_n(from, n, text); }
};

/// The name of a part of an action.
template <class A, FixedText suffix>
struct PartName {
    /// Its characters, with a 0 at the end.
    static constexpr auto kText = [] {
        constexpr std::string_view kAction(A::kName);
        std::array<char, kAction.size() + sizeof(suffix.text)> all{};
        std::copy_n(suffix.text, sizeof(suffix.text), std::ranges::copy(kAction, all.begin()).out);
        return all;
    }();
};

/// The service by which a goal is given.
template <ActionType A>
struct SendGoal {
    static constexpr const char* kName = PartName<A, "_SendGoal">::kText.data();
    /// The call.
    struct Request {
        static constexpr const char* kName = PartName<A, "_SendGoal_Request">::kText.data();
        Uuid goal_id;           ///< chosen by the client
        typename A::Goal goal;  ///< what is asked for

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("goal_id", m.goal_id);
            visit("goal", m.goal);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = PartName<A, "_SendGoal_Response">::kText.data();
        bool accepted = false;  ///< else nothing happens
        Time stamp;             ///< when it was accepted

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("accepted", m.accepted);
            visit("stamp", m.stamp);
        }
    };
};

/// The service by which the result of a goal is asked for; its reply comes when the goal has ended.
template <ActionType A>
struct GetResult {
    static constexpr const char* kName = PartName<A, "_GetResult">::kText.data();
    /// The call.
    struct Request {
        static constexpr const char* kName = PartName<A, "_GetResult_Request">::kText.data();
        Uuid goal_id;  ///< of the goal

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("goal_id", m.goal_id);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = PartName<A, "_GetResult_Response">::kText.data();
        std::int8_t status = GoalStatus::kUnknown;  ///< one of GoalStatus
        typename A::Result result;                  ///< how it ended

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("status", m.status);
            visit("result", m.result);
        }
    };
};

/// A message of the topic on which a goal reports how far it is.
template <ActionType A>
struct FeedbackMessage {
    static constexpr const char* kName = PartName<A, "_FeedbackMessage">::kText.data();
    Uuid goal_id;                   ///< of the goal
    typename A::Feedback feedback;  ///< how far it is

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("goal_id", m.goal_id);
        visit("feedback", m.feedback);
    }
};

/// The description of an action.
template <ActionType A>
TypeDescription describe() {
    TypeDescription action{A::kName, {}, {}, {}};
    const auto add = [&](const char* name, TypeDescription part) {
        action.fields.push_back({name, kNested, kSingle, 0, part.name});
        add_nested(action, std::move(part));
    };
    add("goal", describe<typename A::Goal>());
    add("result", describe<typename A::Result>());
    add("feedback", describe<typename A::Feedback>());
    add("send_goal_service", describe<SendGoal<A>>());
    add("get_result_service", describe<GetResult<A>>());
    add("feedback_message", describe<FeedbackMessage<A>>());
    return action;
}

}  // namespace roboss::ros2
