// Services of rcl_interfaces, which each node has for its parameters.
#pragma once

#include "ros2_types/messages/parameter_messages.h"

namespace roboss::ros2::rcl_interfaces {

/// rcl_interfaces/srv/GetParameters
struct GetParameters {
    static constexpr const char* kName = "rcl_interfaces/srv/GetParameters";
    /// The call.
    struct Request {
        static constexpr const char* kName = "rcl_interfaces/srv/GetParameters_Request";
        std::vector<std::string> names;  ///< of parameters

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("names", m.names);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "rcl_interfaces/srv/GetParameters_Response";
        std::vector<ParameterValue> values;  ///< in the same order; not set where there is none

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("values", m.values);
        }
    };
};

/// rcl_interfaces/srv/GetParameterTypes
struct GetParameterTypes {
    static constexpr const char* kName = "rcl_interfaces/srv/GetParameterTypes";
    /// The call.
    struct Request {
        static constexpr const char* kName = "rcl_interfaces/srv/GetParameterTypes_Request";
        std::vector<std::string> names;  ///< of parameters

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("names", m.names);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "rcl_interfaces/srv/GetParameterTypes_Response";
        std::vector<std::uint8_t> types;  ///< ParameterType, in the same order

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("types", m.types);
        }
    };
};

/// rcl_interfaces/srv/DescribeParameters
struct DescribeParameters {
    static constexpr const char* kName = "rcl_interfaces/srv/DescribeParameters";
    /// The call.
    struct Request {
        static constexpr const char* kName = "rcl_interfaces/srv/DescribeParameters_Request";
        std::vector<std::string> names;  ///< of parameters

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("names", m.names);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "rcl_interfaces/srv/DescribeParameters_Response";
        std::vector<ParameterDescriptor> descriptors;  ///< in the same order

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("descriptors", m.descriptors);
        }
    };
};

/// rcl_interfaces/srv/ListParameters
struct ListParameters {
    static constexpr const char* kName = "rcl_interfaces/srv/ListParameters";
    /// The call.
    struct Request {
        static constexpr const char* kName = "rcl_interfaces/srv/ListParameters_Request";
        std::vector<std::string> prefixes;  ///< whose parameters; none: all
        std::uint64_t depth = 0;            ///< of names below the prefixes; 0: any

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("prefixes", m.prefixes);
            visit("depth", m.depth);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "rcl_interfaces/srv/ListParameters_Response";
        ListParametersResult result;  ///< those that there are

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
        }
    };
};

/// rcl_interfaces/srv/SetParameters
struct SetParameters {
    static constexpr const char* kName = "rcl_interfaces/srv/SetParameters";
    /// The call.
    struct Request {
        static constexpr const char* kName = "rcl_interfaces/srv/SetParameters_Request";
        std::vector<Parameter> parameters;  ///< new values

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("parameters", m.parameters);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "rcl_interfaces/srv/SetParameters_Response";
        std::vector<SetParametersResult> results;  ///< of each

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("results", m.results);
        }
    };
};

/// rcl_interfaces/srv/SetParametersAtomically
struct SetParametersAtomically {
    static constexpr const char* kName = "rcl_interfaces/srv/SetParametersAtomically";
    /// The call.
    struct Request {
        static constexpr const char* kName = "rcl_interfaces/srv/SetParametersAtomically_Request";
        std::vector<Parameter> parameters;  ///< new values, all or none

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("parameters", m.parameters);
        }
    };
    /// The reply.
    struct Response {
        static constexpr const char* kName = "rcl_interfaces/srv/SetParametersAtomically_Response";
        SetParametersResult result;  ///< of all

        /// Calls visit(name, value) for each field, always in the same order.
        template <class Visitor, class Self>
        static void fields(Visitor&& visit, Self& m) {
            visit("result", m.result);
        }
    };
};

}  // namespace roboss::ros2::rcl_interfaces
