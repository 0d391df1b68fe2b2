// Messages of simulation_interfaces 2.1, by which tools control any simulator. Those of 1.x are the same but
// for Spawnable (simulation_services_v1.h).
#pragma once

#include "ros2_types/messages/command_messages.h"

namespace roboss::ros2::simulation_interfaces {

/// simulation_interfaces/msg/Result
struct Result {
    static constexpr const char* kName = "simulation_interfaces/msg/Result";
    static constexpr std::uint8_t kFeatureUnsupported = 0;
    static constexpr std::uint8_t kOk = 1;
    static constexpr std::uint8_t kNotFound = 2;
    static constexpr std::uint8_t kIncorrectState = 3;
    static constexpr std::uint8_t kOperationFailed = 4;
    std::uint8_t result = 0;    ///< one of the constants, or of those of the response
    std::string error_message;  ///< for people

    /// Calls visit(name, value) for each constant of the definition.
    template <class Visitor>
    static void constants(Visitor&& visit) {
        visit("RESULT_FEATURE_UNSUPPORTED", kFeatureUnsupported);
        visit("RESULT_OK", kOk);
        visit("RESULT_NOT_FOUND", kNotFound);
        visit("RESULT_INCORRECT_STATE", kIncorrectState);
        visit("RESULT_OPERATION_FAILED", kOperationFailed);
    }
    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("result", m.result);
        visit("error_message", m.error_message);
    }
};

/// simulation_interfaces/msg/Resource
struct Resource {
    static constexpr const char* kName = "simulation_interfaces/msg/Resource";
    std::string uri;              ///< a file; empty: the text counts
    std::string resource_string;  ///< the description as text

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("uri", m.uri);
        visit("resource_string", m.resource_string);
    }
};

/// simulation_interfaces/msg/Bounds
struct Bounds {
    static constexpr const char* kName = "simulation_interfaces/msg/Bounds";
    static constexpr std::uint8_t kEmpty = 0;
    static constexpr std::uint8_t kBox = 1;
    static constexpr std::uint8_t kConvexHull = 2;
    static constexpr std::uint8_t kSphere = 3;
    std::uint8_t type = 0;  ///< one of the constants
    std::vector<Vector3>
        points;  ///< box: upper and lower corner; sphere: centre, and its radius as x; else the hull

    /// Calls visit(name, value) for each constant of the definition.
    template <class Visitor>
    static void constants(Visitor&& visit) {
        visit("TYPE_EMPTY", kEmpty);
        visit("TYPE_BOX", kBox);
        visit("TYPE_CONVEX_HULL", kConvexHull);
        visit("TYPE_SPHERE", kSphere);
    }
    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("type", m.type);
        visit("points", m.points);
    }
};

/// simulation_interfaces/msg/TagsFilter
struct TagsFilter {
    static constexpr const char* kName = "simulation_interfaces/msg/TagsFilter";
    static constexpr std::uint8_t kAny = 0;
    static constexpr std::uint8_t kAll = 1;
    std::vector<std::string> tags;  ///< none: all match
    std::uint8_t filter_mode = 0;   ///< one of the constants

    /// Calls visit(name, value) for each constant of the definition.
    template <class Visitor>
    static void constants(Visitor&& visit) {
        visit("FILTER_MODE_ANY", kAny);
        visit("FILTER_MODE_ALL", kAll);
    }
    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("tags", m.tags);
        visit("filter_mode", m.filter_mode);
    }
};

/// simulation_interfaces/msg/EntityCategory
struct EntityCategory {
    static constexpr const char* kName = "simulation_interfaces/msg/EntityCategory";
    static constexpr std::uint8_t kObject = 0;
    static constexpr std::uint8_t kRobot = 1;
    static constexpr std::uint8_t kHuman = 2;
    static constexpr std::uint8_t kDynamicObject = 4;
    static constexpr std::uint8_t kStaticObject = 5;
    std::uint8_t category = 0;  ///< one of the constants

    /// Calls visit(name, value) for each constant of the definition.
    template <class Visitor>
    static void constants(Visitor&& visit) {
        visit("CATEGORY_OBJECT", kObject);
        visit("CATEGORY_ROBOT", kRobot);
        visit("CATEGORY_HUMAN", kHuman);
        visit("CATEGORY_DYNAMIC_OBJECT", kDynamicObject);
        visit("CATEGORY_STATIC_OBJECT", kStaticObject);
    }
    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("category", m.category);
    }
};

/// simulation_interfaces/msg/EntityFilters
struct EntityFilters {
    static constexpr const char* kName = "simulation_interfaces/msg/EntityFilters";
    std::string filter;                      ///< POSIX extended regular expression; empty: all
    std::vector<EntityCategory> categories;  ///< any of them; none: all
    TagsFilter tags;                         ///< of the entities
    Bounds bounds;                           ///< that they overlap, world; empty: all

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("filter", m.filter);
        visit("categories", m.categories);
        visit("tags", m.tags);
        visit("bounds", m.bounds);
    }
};

/// simulation_interfaces/msg/EntityInfo
struct EntityInfo {
    static constexpr const char* kName = "simulation_interfaces/msg/EntityInfo";
    EntityCategory category;        ///< the main one
    std::string description;        ///< for people
    std::vector<std::string> tags;  ///< for filters

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("category", m.category);
        visit("description", m.description);
        visit("tags", m.tags);
    }
};

/// simulation_interfaces/msg/EntityState
struct EntityState {
    static constexpr const char* kName = "simulation_interfaces/msg/EntityState";
    Header header;              ///< time, and the frame of the values; empty: the world
    PoseMessage pose;           ///< m
    TwistMessage twist;         ///< m/s, rad/s
    AccelMessage acceleration;  ///< m/s^2, rad/s^2

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("header", m.header);
        visit("pose", m.pose);
        visit("twist", m.twist);
        visit("acceleration", m.acceleration);
    }
};

/// simulation_interfaces/msg/NamedPose
struct NamedPose {
    static constexpr const char* kName = "simulation_interfaces/msg/NamedPose";
    std::string name;               ///< unique
    std::string description;        ///< for people
    std::vector<std::string> tags;  ///< for filters
    PoseMessage pose;               ///< in the world, m

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("name", m.name);
        visit("description", m.description);
        visit("tags", m.tags);
        visit("pose", m.pose);
    }
};

/// simulation_interfaces/msg/Spawnable
struct Spawnable {
    static constexpr const char* kName = "simulation_interfaces/msg/Spawnable";
    Resource entity_resource;  ///< for SpawnEntity
    std::string description;   ///< for people
    Bounds spawn_bounds;       ///< around it; empty: not known

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("entity_resource", m.entity_resource);
        visit("description", m.description);
        visit("spawn_bounds", m.spawn_bounds);
    }
};

/// simulation_interfaces/msg/WorldResource
struct WorldResource {
    static constexpr const char* kName = "simulation_interfaces/msg/WorldResource";
    std::string name;               ///< of the world
    Resource world_resource;        ///< for LoadWorld
    std::string description;        ///< for people
    std::vector<std::string> tags;  ///< for filters

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("name", m.name);
        visit("world_resource", m.world_resource);
        visit("description", m.description);
        visit("tags", m.tags);
    }
};

}  // namespace roboss::ros2::simulation_interfaces
