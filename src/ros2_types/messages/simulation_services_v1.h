// The services of simulation_interfaces 1.x (Humble, Jazzy, Kilted) whose layout is another one than in 2.1.
// The others, SpawnEntities apart, are the same.
#pragma once

#include "ros2_types/messages/simulation_messages.h"

namespace roboss::ros2::simulation_interfaces_v1 {

using simulation_interfaces::Bounds;
using simulation_interfaces::EntityState;
using simulation_interfaces::Result;

/// simulation_interfaces/msg/Spawnable
struct Spawnable {
    static constexpr const char* kName = "simulation_interfaces/msg/Spawnable";
    std::string uri;          ///< a file, for SpawnEntity
    std::string description;  ///< for people
    Bounds spawn_bounds;      ///< around it; empty: not known

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("uri", m.uri);
        visit("description", m.description);
        visit("spawn_bounds", m.spawn_bounds);
    }
};

/// simulation_interfaces/srv/GetSpawnables
struct GetSpawnables {
    static constexpr const char* kName = "simulation_interfaces/srv/GetSpawnables";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/GetSpawnables_Request";
        std::vector<std::string> sources;  ///< more places to look at

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("sources", m.sources);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/GetSpawnables_Response";
        Result result;                      ///< how it went
        std::vector<Spawnable> spawnables;  ///< files

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
            visit("spawnables", m.spawnables);
        }
    };
};

/// simulation_interfaces/srv/SpawnEntity
struct SpawnEntity {
    static constexpr const char* kName = "simulation_interfaces/srv/SpawnEntity";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/SpawnEntity_Request";
        std::string name;              ///< in the world; empty: as in the description
        bool allow_renaming = false;   ///< a name that is taken is changed
        std::string uri;               ///< a file; empty: the text counts
        std::string resource_string;   ///< the description as text
        std::string entity_namespace;  ///< of its interfaces
        PoseStamped initial_pose;      ///< m; frame empty: the world

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("name", m.name);
            visit("allow_renaming", m.allow_renaming);
            visit("uri", m.uri);
            visit("resource_string", m.resource_string);
            visit("entity_namespace", m.entity_namespace);
            visit("initial_pose", m.initial_pose);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/SpawnEntity_Response";
        static constexpr std::uint8_t kNameNotUnique = 101;
        static constexpr std::uint8_t kNameInvalid = 102;
        static constexpr std::uint8_t kUnsupportedFormat = 103;
        static constexpr std::uint8_t kNoResource = 104;
        static constexpr std::uint8_t kNamespaceInvalid = 105;
        static constexpr std::uint8_t kResourceParseError = 106;
        static constexpr std::uint8_t kMissingAssets = 107;
        static constexpr std::uint8_t kUnsupportedAssets = 108;
        static constexpr std::uint8_t kInvalidPose = 109;
        Result result;            ///< how it went
        std::string entity_name;  ///< that it got

        /// Calls visit(name, value) for each constant of the definition.
        template <class Visitor>
        static void constants(Visitor&& visit) {
            visit("NAME_NOT_UNIQUE", kNameNotUnique);
            visit("NAME_INVALID", kNameInvalid);
            visit("UNSUPPORTED_FORMAT", kUnsupportedFormat);
            visit("NO_RESOURCE", kNoResource);
            visit("NAMESPACE_INVALID", kNamespaceInvalid);
            visit("RESOURCE_PARSE_ERROR", kResourceParseError);
            visit("MISSING_ASSETS", kMissingAssets);
            visit("UNSUPPORTED_ASSETS", kUnsupportedAssets);
            visit("INVALID_POSE", kInvalidPose);
        }
        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
            visit("entity_name", m.entity_name);
        }
    };
};

/// simulation_interfaces/srv/SetEntityState
struct SetEntityState {
    static constexpr const char* kName = "simulation_interfaces/srv/SetEntityState";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/SetEntityState_Request";
        std::string entity;  ///< its name
        EntityState state;   ///< the new values; all are set

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("entity", m.entity);
            visit("state", m.state);
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

/// simulation_interfaces/srv/LoadWorld
struct LoadWorld {
    static constexpr const char* kName = "simulation_interfaces/srv/LoadWorld";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/LoadWorld_Request";
        std::string uri;                                    ///< the world's file; empty: the text counts
        std::string resource_string;                        ///< the world as text
        bool fail_on_unsupported_element = false;           ///< instead of leaving it out
        bool ignore_missing_or_unsupported_assets = false;  ///< instead of failing

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("uri", m.uri);
            visit("resource_string", m.resource_string);
            visit("fail_on_unsupported_element", m.fail_on_unsupported_element);
            visit("ignore_missing_or_unsupported_assets", m.ignore_missing_or_unsupported_assets);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/LoadWorld_Response";
        static constexpr std::uint8_t kUnsupportedFormat = 101;
        static constexpr std::uint8_t kNoResource = 102;
        static constexpr std::uint8_t kResourceParseError = 103;
        static constexpr std::uint8_t kMissingAssets = 104;
        static constexpr std::uint8_t kUnsupportedAssets = 105;
        static constexpr std::uint8_t kUnsupportedElements = 106;
        Result result;                               ///< how it went
        simulation_interfaces::WorldResource world;  ///< that was loaded

        /// Calls visit(name, value) for each constant of the definition.
        template <class Visitor>
        static void constants(Visitor&& visit) {
            visit("UNSUPPORTED_FORMAT", kUnsupportedFormat);
            visit("NO_RESOURCE", kNoResource);
            visit("RESOURCE_PARSE_ERROR", kResourceParseError);
            visit("MISSING_ASSETS", kMissingAssets);
            visit("UNSUPPORTED_ASSETS", kUnsupportedAssets);
            visit("UNSUPPORTED_ELEMENTS", kUnsupportedElements);
        }
        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
            visit("world", m.world);
        }
    };
};

}  // namespace roboss::ros2::simulation_interfaces_v1
