// Services of ros_gz_interfaces, by which scripts for Gazebo control a world.
#pragma once

#include "ros2_types/messages/gazebo_messages.h"

namespace roboss::ros2::ros_gz_interfaces {

/// ros_gz_interfaces/msg/EntityFactory
struct EntityFactory {
    static constexpr const char* kName = "ros_gz_interfaces/msg/EntityFactory";
    std::string name;                   ///< in the world; empty: as in the description
    bool allow_renaming = false;        ///< a name that is taken is changed
    std::string sdf;                    ///< the description as text
    std::string sdf_filename;           ///< or a file with it
    std::string clone_name;             ///< or a robot that is copied
    PoseMessage pose;                   ///< m
    std::string relative_to = "world";  ///< frame of the pose; empty: the world

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("name", m.name);
        visit("allow_renaming", m.allow_renaming);
        visit("sdf", m.sdf);
        visit("sdf_filename", m.sdf_filename);
        visit("clone_name", m.clone_name);
        visit("pose", m.pose);
        visit("relative_to", m.relative_to);
    }
};

/// ros_gz_interfaces/msg/WorldReset
struct WorldReset {
    static constexpr const char* kName = "ros_gz_interfaces/msg/WorldReset";
    bool all = false;         ///< time and models
    bool time_only = false;   ///< the time alone
    bool model_only = false;  ///< the models alone

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("all", m.all);
        visit("time_only", m.time_only);
        visit("model_only", m.model_only);
    }
};

/// ros_gz_interfaces/msg/WorldControl
struct WorldControl {
    static constexpr const char* kName = "ros_gz_interfaces/msg/WorldControl";
    bool pause = false;            ///< the run is to be paused
    bool step = false;             ///< by one tick
    std::uint32_t multi_step = 0;  ///< by so many ticks, then paused
    WorldReset reset;              ///< to the start
    std::uint32_t seed = 0;        ///< of random numbers
    Time run_to_sim_time;          ///< until then, then paused

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("pause", m.pause);
        visit("step", m.step);
        visit("multi_step", m.multi_step);
        visit("reset", m.reset);
        visit("seed", m.seed);
        visit("run_to_sim_time", m.run_to_sim_time);
    }
};

/// ros_gz_interfaces/srv/SpawnEntity
struct SpawnEntity {
    static constexpr const char* kName = "ros_gz_interfaces/srv/SpawnEntity";
    /// The call.
    struct Request {
        static constexpr const char* kName = "ros_gz_interfaces/srv/SpawnEntity_Request";
        EntityFactory entity_factory;  ///< what and where

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("entity_factory", m.entity_factory);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "ros_gz_interfaces/srv/SpawnEntity_Response";
        bool success = false;  ///< it was done

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("success", m.success);
        }
    };
};

/// ros_gz_interfaces/srv/DeleteEntity
struct DeleteEntity {
    static constexpr const char* kName = "ros_gz_interfaces/srv/DeleteEntity";
    /// The call.
    struct Request {
        static constexpr const char* kName = "ros_gz_interfaces/srv/DeleteEntity_Request";
        GazeboEntity entity;  ///< the robot

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("entity", m.entity);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "ros_gz_interfaces/srv/DeleteEntity_Response";
        bool success = false;  ///< it was done

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("success", m.success);
        }
    };
};

/// ros_gz_interfaces/srv/SetEntityPose
struct SetEntityPose {
    static constexpr const char* kName = "ros_gz_interfaces/srv/SetEntityPose";
    /// The call.
    struct Request {
        static constexpr const char* kName = "ros_gz_interfaces/srv/SetEntityPose_Request";
        GazeboEntity entity;  ///< the robot
        PoseMessage pose;     ///< m

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("entity", m.entity);
            visit("pose", m.pose);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "ros_gz_interfaces/srv/SetEntityPose_Response";
        bool success = false;  ///< it was done

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("success", m.success);
        }
    };
};

/// ros_gz_interfaces/srv/ControlWorld
struct ControlWorld {
    static constexpr const char* kName = "ros_gz_interfaces/srv/ControlWorld";
    /// The call.
    struct Request {
        static constexpr const char* kName = "ros_gz_interfaces/srv/ControlWorld_Request";
        WorldControl world_control;  ///< what is to happen

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("world_control", m.world_control);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "ros_gz_interfaces/srv/ControlWorld_Response";
        bool success = false;  ///< it was done

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("success", m.success);
        }
    };
};

}  // namespace roboss::ros2::ros_gz_interfaces
