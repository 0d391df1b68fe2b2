// Services of simulation_interfaces 2.1 about worlds and named poses.
#pragma once

#include "ros2_types/messages/simulation_messages.h"

namespace roboss::ros2::simulation_interfaces {

/// simulation_interfaces/srv/GetNamedPoses
struct GetNamedPoses {
    static constexpr const char* kName = "simulation_interfaces/srv/GetNamedPoses";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/GetNamedPoses_Request";
        TagsFilter tags;  ///< of the poses

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("tags", m.tags);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/GetNamedPoses_Response";
        Result result;                 ///< how it went
        std::vector<NamedPose> poses;  ///< in the order of their names

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
            visit("poses", m.poses);
        }
    };
};

/// simulation_interfaces/srv/GetNamedPoseBounds
struct GetNamedPoseBounds {
    static constexpr const char* kName = "simulation_interfaces/srv/GetNamedPoseBounds";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/GetNamedPoseBounds_Request";
        std::string name;  ///< of a named pose

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("name", m.name);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/GetNamedPoseBounds_Response";
        Result result;  ///< how it went
        Bounds bounds;  ///< around it

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
            visit("bounds", m.bounds);
        }
    };
};

/// simulation_interfaces/srv/GetAvailableWorlds
struct GetAvailableWorlds {
    static constexpr const char* kName = "simulation_interfaces/srv/GetAvailableWorlds";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/GetAvailableWorlds_Request";
        std::vector<std::string> additional_sources;  ///< more places to look at
        TagsFilter filter;                            ///< of the worlds
        bool offline_only = false;                    ///< only files
        bool continue_on_error = false;               ///< sources that fail are left out

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("additional_sources", m.additional_sources);
            visit("filter", m.filter);
            visit("offline_only", m.offline_only);
            visit("continue_on_error", m.continue_on_error);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/GetAvailableWorlds_Response";
        static constexpr std::uint8_t kDefaultSourcesFailed = 101;
        Result result;                      ///< how it went
        std::vector<WorldResource> worlds;  ///< for LoadWorld

        /// Calls visit(name, value) for each constant of the definition.
        template <class Visitor>
        static void constants(Visitor&& visit) {
            visit("DEFAULT_SOURCES_FAILED", kDefaultSourcesFailed);
        }
        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
            visit("worlds", m.worlds);
        }
    };
};

/// simulation_interfaces/srv/GetCurrentWorld
struct GetCurrentWorld {
    static constexpr const char* kName = "simulation_interfaces/srv/GetCurrentWorld";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/GetCurrentWorld_Request";
        std::uint8_t placeholder = 0;  ///< a message has at least one byte

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit(kNoField, m.placeholder);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/GetCurrentWorld_Response";
        static constexpr std::uint8_t kNoWorldLoaded = 101;
        Result result;        ///< how it went
        WorldResource world;  ///< of the run

        /// Calls visit(name, value) for each constant of the definition.
        template <class Visitor>
        static void constants(Visitor&& visit) {
            visit("NO_WORLD_LOADED", kNoWorldLoaded);
        }
        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
            visit("world", m.world);
        }
    };
};

/// simulation_interfaces/srv/LoadWorld
struct LoadWorld {
    static constexpr const char* kName = "simulation_interfaces/srv/LoadWorld";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/LoadWorld_Request";
        Resource world_resource;                            ///< the world
        bool fail_on_unsupported_element = false;           ///< instead of leaving it out
        bool ignore_missing_or_unsupported_assets = false;  ///< instead of failing

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("world_resource", m.world_resource);
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
        Result result;        ///< how it went
        WorldResource world;  ///< that was loaded

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

/// simulation_interfaces/srv/UnloadWorld
struct UnloadWorld {
    static constexpr const char* kName = "simulation_interfaces/srv/UnloadWorld";
    /// The call.
    struct Request {
        static constexpr const char* kName = "simulation_interfaces/srv/UnloadWorld_Request";
        std::uint8_t placeholder = 0;  ///< a message has at least one byte

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit(kNoField, m.placeholder);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "simulation_interfaces/srv/UnloadWorld_Response";
        static constexpr std::uint8_t kNoWorldLoaded = 101;
        Result result;  ///< how it went

        /// Calls visit(name, value) for each constant of the definition.
        template <class Visitor>
        static void constants(Visitor&& visit) {
            visit("NO_WORLD_LOADED", kNoWorldLoaded);
        }
        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
        }
    };
};

}  // namespace roboss::ros2::simulation_interfaces
