// Actions by which grippers are closed and opened (control_msgs). See standard_messages.h and action_type.h.
#pragma once

#include "ros2_types/messages/sensor_messages.h"

namespace roboss::ros2 {

/// control_msgs/msg/GripperCommand
struct GripperTarget {
    static constexpr const char* kName = "control_msgs/msg/GripperCommand";
    double position = 0;    ///< m or rad, of the joint
    double max_effort = 0;  ///< N or N m; 0: the joint's own bound

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("position", m.position);
        visit("max_effort", m.max_effort);
    }
};

/// control_msgs/action/GripperCommand
struct GripperCommand {
    static constexpr const char* kName = "control_msgs/action/GripperCommand";
    /// The position that is asked for.
    struct Goal {
        static constexpr const char* kName = "control_msgs/action/GripperCommand_Goal";
        GripperTarget command;  ///< of the only joint

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("command", m.command);
        }
    };
    /// The end of the goal.
    struct Result {
        static constexpr const char* kName = "control_msgs/action/GripperCommand_Result";
        double position = 0;        ///< m or rad
        double effort = 0;          ///< N or N m, of the motor
        bool stalled = false;       ///< something stops it
        bool reached_goal = false;  ///< it is where it was sent

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("position", m.position);
            visit("effort", m.effort);
            visit("stalled", m.stalled);
            visit("reached_goal", m.reached_goal);
        }
    };
    /// The state on the way, as in a Result.
    struct Feedback : Result {
        static constexpr const char* kName = "control_msgs/action/GripperCommand_Feedback";
    };
};

/// control_msgs/action/ParallelGripperCommand
struct ParallelGripperCommand {
    static constexpr const char* kName = "control_msgs/action/ParallelGripperCommand";
    /// The position that is asked for.
    struct Goal {
        static constexpr const char* kName = "control_msgs/action/ParallelGripperCommand_Goal";
        JointStateMessage command;  ///< of the only joint; its velocity has no effect

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("command", m.command);
        }
    };
    /// The end of the goal.
    struct Result {
        static constexpr const char* kName = "control_msgs/action/ParallelGripperCommand_Result";
        JointStateMessage state;    ///< of the joint
        bool stalled = false;       ///< something stops it
        bool reached_goal = false;  ///< it is where it was sent

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("state", m.state);
            visit("stalled", m.stalled);
            visit("reached_goal", m.reached_goal);
        }
    };
    /// The state on the way.
    struct Feedback {
        static constexpr const char* kName = "control_msgs/action/ParallelGripperCommand_Feedback";
        JointStateMessage state;  ///< of the joint

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("state", m.state);
        }
    };
};

}  // namespace roboss::ros2
