// Interfaces of ros2_control (control_msgs). See standard_messages.h and action_type.h.
#pragma once

#include "ros2_types/messages/command_messages.h"

namespace roboss::ros2 {

/// control_msgs/msg/JointTolerance
struct JointTolerance {
    static constexpr const char* kName = "control_msgs/msg/JointTolerance";
    std::string name;         ///< of the joint
    double position = 0;      ///< rad or m; 0: the default; negative: none
    double velocity = 0;      ///< rad/s or m/s, likewise
    double acceleration = 0;  ///< rad/s^2 or m/s^2, likewise

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("name", m.name);
        visit("position", m.position);
        visit("velocity", m.velocity);
        visit("acceleration", m.acceleration);
    }
};

/// control_msgs/msg/JointComponentTolerance
struct JointComponentTolerance {
    static constexpr const char* kName = "control_msgs/msg/JointComponentTolerance";
    std::string joint_name;       ///< a joint with several degrees of freedom
    std::uint16_t component = 0;  ///< 1 x, 2 y, 3 z, 4 translation, 5 rotation
    double position = 0;          ///< m or rad
    double velocity = 0;          ///< m/s or rad/s
    double acceleration = 0;      ///< m/s^2 or rad/s^2

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("joint_name", m.joint_name);
        visit("component", m.component);
        visit("position", m.position);
        visit("velocity", m.velocity);
        visit("acceleration", m.acceleration);
    }
};

/// control_msgs/action/FollowJointTrajectory, as of control_msgs 6.3 (Lyrical).
struct FollowJointTrajectory {
    static constexpr const char* kName = "control_msgs/action/FollowJointTrajectory";
    /// The motion that is asked for.
    struct Goal {
        static constexpr const char* kName = "control_msgs/action/FollowJointTrajectory_Goal";
        JointTrajectory trajectory;                    ///< of joints with one axis
        MultiDofJointTrajectory multi_dof_trajectory;  ///< of joints with several
        std::vector<JointTolerance> path_tolerance;    ///< on the way
        std::vector<JointComponentTolerance>
            component_path_tolerance;                ///< on the way, of joints with several axes
        std::vector<JointTolerance> goal_tolerance;  ///< at the end
        std::vector<JointComponentTolerance>
            component_goal_tolerance;  ///< at the end, of joints with several axes
        Duration goal_time_tolerance;  ///< how much later the end may be reached

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("trajectory", m.trajectory);
            visit("multi_dof_trajectory", m.multi_dof_trajectory);
            visit("path_tolerance", m.path_tolerance);
            visit("component_path_tolerance", m.component_path_tolerance);
            visit("goal_tolerance", m.goal_tolerance);
            visit("component_goal_tolerance", m.component_goal_tolerance);
            visit("goal_time_tolerance", m.goal_time_tolerance);
        }
    };
    /// The end of the goal.
    struct Result {
        static constexpr const char* kName = "control_msgs/action/FollowJointTrajectory_Result";
        static constexpr std::int32_t kSuccessful = 0;
        static constexpr std::int32_t kInvalidGoal = -1;
        static constexpr std::int32_t kInvalidJoints = -2;
        static constexpr std::int32_t kOldHeaderTimestamp = -3;
        static constexpr std::int32_t kPathToleranceViolated = -4;
        static constexpr std::int32_t kGoalToleranceViolated = -5;
        std::int32_t error_code = 0;  ///< one of the constants
        std::string error_string;     ///< for people

        /// Calls visit(name, value) for each constant of the definition.
        template <class Visitor>
        static void constants(Visitor&& visit) {
            visit("SUCCESSFUL", kSuccessful);
            visit("INVALID_GOAL", kInvalidGoal);
            visit("INVALID_JOINTS", kInvalidJoints);
            visit("OLD_HEADER_TIMESTAMP", kOldHeaderTimestamp);
            visit("PATH_TOLERANCE_VIOLATED", kPathToleranceViolated);
            visit("GOAL_TOLERANCE_VIOLATED", kGoalToleranceViolated);
        }
        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("error_code", m.error_code);
            visit("error_string", m.error_string);
        }
    };
    /// The state on the way.
    struct Feedback {
        static constexpr const char* kName = "control_msgs/action/FollowJointTrajectory_Feedback";
        Header header;                                   ///< time
        std::vector<std::string> joint_names;            ///< in the order of the values
        JointTrajectoryPoint desired;                    ///< where the joints are to be
        JointTrajectoryPoint actual;                     ///< where they are
        JointTrajectoryPoint error;                      ///< desired - actual
        std::int32_t index = 0;                          ///< of the point that the joints move to
        std::vector<std::string> multi_dof_joint_names;  ///< none here
        MultiDofJointTrajectoryPoint multi_dof_desired;  ///< none here
        MultiDofJointTrajectoryPoint multi_dof_actual;   ///< none here
        MultiDofJointTrajectoryPoint multi_dof_error;    ///< none here
        std::int32_t multi_dof_index = 0;                ///< none here

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("header", m.header);
            visit("joint_names", m.joint_names);
            visit("desired", m.desired);
            visit("actual", m.actual);
            visit("error", m.error);
            visit("index", m.index);
            visit("multi_dof_joint_names", m.multi_dof_joint_names);
            visit("multi_dof_desired", m.multi_dof_desired);
            visit("multi_dof_actual", m.multi_dof_actual);
            visit("multi_dof_error", m.multi_dof_error);
            visit("multi_dof_index", m.multi_dof_index);
        }
    };
};

/// The same as of control_msgs before 6.3 (Humble, Jazzy, Kilted): its feedback has no indices.
struct FollowJointTrajectoryBefore63 {
    static constexpr const char* kName = FollowJointTrajectory::kName;
    using Goal = FollowJointTrajectory::Goal;
    using Result = FollowJointTrajectory::Result;
    /// The state on the way.
    struct Feedback {
        static constexpr const char* kName = "control_msgs/action/FollowJointTrajectory_Feedback";
        Header header;                                   ///< time
        std::vector<std::string> joint_names;            ///< in the order of the values
        JointTrajectoryPoint desired;                    ///< where the joints are to be
        JointTrajectoryPoint actual;                     ///< where they are
        JointTrajectoryPoint error;                      ///< desired - actual
        std::vector<std::string> multi_dof_joint_names;  ///< none here
        MultiDofJointTrajectoryPoint multi_dof_desired;  ///< none here
        MultiDofJointTrajectoryPoint multi_dof_actual;   ///< none here
        MultiDofJointTrajectoryPoint multi_dof_error;    ///< none here

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("header", m.header);
            visit("joint_names", m.joint_names);
            visit("desired", m.desired);
            visit("actual", m.actual);
            visit("error", m.error);
            visit("multi_dof_joint_names", m.multi_dof_joint_names);
            visit("multi_dof_desired", m.multi_dof_desired);
            visit("multi_dof_actual", m.multi_dof_actual);
            visit("multi_dof_error", m.multi_dof_error);
        }
    };
};

}  // namespace roboss::ros2
