// Services of simulation_interfaces 2.1 that add and remove entities, which are the robots of a world.
#pragma once

#include "ros2_types/messages/simulation_messages.h"

namespace roboss::ros2::simulation_interfaces {

/// simulation_interfaces/msg/SpawnEntity
struct SpawnRequest {
    static constexpr const char* kName = "simulation_interfaces/msg/SpawnEntity";
    std::string name;              ///< in the world; empty: as in the description
    bool allow_renaming = false;   ///< a name that is taken is changed
    Resource entity_resource;      ///< the description
    std::string entity_namespace;  ///< of its interfaces
    PoseStamped initial_pose;      ///< m; frame empty: the world

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("name", m.name);
        visit("allow_renaming", m.allow_renaming);
        visit("entity_resource", m.entity_resource);
        visit("entity_namespace", m.entity_namespace);
        visit("initial_pose", m.initial_pose);
    }
};

/// simulation_interfaces/msg/SpawnResult
struct SpawnResult {
    static constexpr const char* kName = "simulation_interfaces/msg/SpawnResult";
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

/// simulation_interfaces/srv/SpawnEntity
struct SpawnEntity {
    static constexpr const char* kName = "simulation_interfaces/srv/SpawnEntity";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/SpawnEntity_Request";
        std::string name;              ///< in the world; empty: as in the description
        bool allow_renaming = false;   ///< a name that is taken is changed
        Resource entity_resource;      ///< the description
        std::string entity_namespace;  ///< of its interfaces
        PoseStamped initial_pose;      ///< m; frame empty: the world

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("name", m.name);
            visit("allow_renaming", m.allow_renaming);
            visit("entity_resource", m.entity_resource);
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

/// simulation_interfaces/srv/SpawnEntities
struct SpawnEntities {
    static constexpr const char* kName = "simulation_interfaces/srv/SpawnEntities";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/SpawnEntities_Request";
        std::vector<SpawnRequest> spawn_requests;  ///< each as of SpawnEntity

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("spawn_requests", m.spawn_requests);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/SpawnEntities_Response";
        static constexpr std::uint8_t kEntitiesSpawnFailed = 150;
        Result result;                     ///< how it went
        std::vector<SpawnResult> results;  ///< of each

        /// Calls visit(name, value) for each constant of the definition.
        template <class Visitor>
        static void constants(Visitor&& visit) {
            visit("ENTITIES_SPAWN_FAILED", kEntitiesSpawnFailed);
        }
        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
            visit("results", m.results);
        }
    };
};

/// simulation_interfaces/srv/DeleteEntity
struct DeleteEntity {
    static constexpr const char* kName = "simulation_interfaces/srv/DeleteEntity";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/DeleteEntity_Request";
        std::string entity;  ///< its name

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("entity", m.entity);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/DeleteEntity_Response";
        Result result;  ///< how it went

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
        }
    };
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

}  // namespace roboss::ros2::simulation_interfaces
