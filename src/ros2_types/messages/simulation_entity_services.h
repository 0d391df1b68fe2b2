// Services of simulation_interfaces 2.1 about entities, which are the robots of a world.
#pragma once

#include "ros2_types/messages/simulation_messages.h"

namespace roboss::ros2::simulation_interfaces {

/// simulation_interfaces/srv/GetEntities
struct GetEntities {
    static constexpr const char* kName = "simulation_interfaces/srv/GetEntities";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/GetEntities_Request";
        EntityFilters filters;  ///< all must match

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("filters", m.filters);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/GetEntities_Response";
        Result result;                      ///< how it went
        std::vector<std::string> entities;  ///< their names

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
            visit("entities", m.entities);
        }
    };
};

/// simulation_interfaces/srv/GetEntitiesStates
struct GetEntitiesStates {
    static constexpr const char* kName = "simulation_interfaces/srv/GetEntitiesStates";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/GetEntitiesStates_Request";
        EntityFilters filters;  ///< all must match

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("filters", m.filters);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/GetEntitiesStates_Response";
        Result result;                      ///< how it went
        std::vector<std::string> entities;  ///< their names
        std::vector<EntityState> states;    ///< in the same order

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
            visit("entities", m.entities);
            visit("states", m.states);
        }
    };
};

/// simulation_interfaces/srv/GetEntityBounds
struct GetEntityBounds {
    static constexpr const char* kName = "simulation_interfaces/srv/GetEntityBounds";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/GetEntityBounds_Request";
        std::string entity;  ///< its name

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("entity", m.entity);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/GetEntityBounds_Response";
        Result result;  ///< how it went
        Bounds bounds;  ///< a box about its canonical link, m

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
            visit("bounds", m.bounds);
        }
    };
};

/// simulation_interfaces/srv/GetEntityInfo
struct GetEntityInfo {
    static constexpr const char* kName = "simulation_interfaces/srv/GetEntityInfo";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/GetEntityInfo_Request";
        std::string entity;  ///< its name

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("entity", m.entity);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/GetEntityInfo_Response";
        Result result;    ///< how it went
        EntityInfo info;  ///< as it was set

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
            visit("info", m.info);
        }
    };
};

/// simulation_interfaces/srv/SetEntityInfo
struct SetEntityInfo {
    static constexpr const char* kName = "simulation_interfaces/srv/SetEntityInfo";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/SetEntityInfo_Request";
        std::string entity;  ///< its name
        EntityInfo info;     ///< replaces what there was

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("entity", m.entity);
            visit("info", m.info);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/SetEntityInfo_Response";
        Result result;  ///< how it went

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
        }
    };
};

/// simulation_interfaces/srv/GetEntityState
struct GetEntityState {
    static constexpr const char* kName = "simulation_interfaces/srv/GetEntityState";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/GetEntityState_Request";
        std::string entity;  ///< its name

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("entity", m.entity);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/GetEntityState_Response";
        Result result;      ///< how it went
        EntityState state;  ///< in the world

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
            visit("state", m.state);
        }
    };
};

/// simulation_interfaces/srv/SetEntityState
struct SetEntityState {
    static constexpr const char* kName = "simulation_interfaces/srv/SetEntityState";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/SetEntityState_Request";
        std::string entity;             ///< its name
        EntityState state;              ///< the new values
        bool set_pose = false;          ///< the pose is set
        bool set_twist = false;         ///< the velocities are set
        bool set_acceleration = false;  ///< the accelerations are set

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("entity", m.entity);
            visit("state", m.state);
            visit("set_pose", m.set_pose);
            visit("set_twist", m.set_twist);
            visit("set_acceleration", m.set_acceleration);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/SetEntityState_Response";
        static constexpr std::uint8_t kInvalidPose = 101;
        Result result;  ///< how it went

        /// Calls visit(name, value) for each constant of the definition.
        template <class Visitor>
        static void constants(Visitor&& visit) {
            visit("INVALID_POSE", kInvalidPose);
        }
        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
        }
    };
};

}  // namespace roboss::ros2::simulation_interfaces
