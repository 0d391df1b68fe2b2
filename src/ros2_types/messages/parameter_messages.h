// Messages of rcl_interfaces about parameters of nodes.
#pragma once

#include "ros2_types/messages/standard_messages.h"

namespace roboss::ros2::rcl_interfaces {

/// Values of ParameterValue::type (rcl_interfaces/msg/ParameterType).
enum ParameterType : std::uint8_t {
    kNotSet,
    kBool,
    kInteger,
    kDouble,
    kString,
    kByteArray,
    kBoolArray,
    kIntegerArray,
    kDoubleArray,
    kStringArray
};

/// rcl_interfaces/msg/ParameterValue
struct ParameterValue {
    static constexpr const char* kName = "rcl_interfaces/msg/ParameterValue";
    std::uint8_t type = 0;                          ///< ParameterType; the field that holds the value
    bool bool_value = false;                        ///< of kBool
    std::int64_t integer_value = 0;                 ///< of kInteger
    double double_value = 0;                        ///< of kDouble
    std::string string_value;                       ///< of kString
    std::vector<std::byte> byte_array_value;        ///< of kByteArray
    std::vector<bool> bool_array_value;             ///< of kBoolArray
    std::vector<std::int64_t> integer_array_value;  ///< of kIntegerArray
    std::vector<double> double_array_value;         ///< of kDoubleArray
    std::vector<std::string> string_array_value;    ///< of kStringArray

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("type", m.type);
        visit("bool_value", m.bool_value);
        visit("integer_value", m.integer_value);
        visit("double_value", m.double_value);
        visit("string_value", m.string_value);
        visit("byte_array_value", m.byte_array_value);
        visit("bool_array_value", m.bool_array_value);
        visit("integer_array_value", m.integer_array_value);
        visit("double_array_value", m.double_array_value);
        visit("string_array_value", m.string_array_value);
    }
};

/// rcl_interfaces/msg/Parameter
struct Parameter {
    static constexpr const char* kName = "rcl_interfaces/msg/Parameter";
    std::string name;      ///< in its node
    ParameterValue value;  ///< its value

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("name", m.name);
        visit("value", m.value);
    }
};

/// rcl_interfaces/msg/FloatingPointRange
struct FloatingPointRange {
    static constexpr const char* kName = "rcl_interfaces/msg/FloatingPointRange";
    double from_value = 0;  ///< least
    double to_value = 0;    ///< most
    double step = 0;        ///< 0: any between

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("from_value", m.from_value);
        visit("to_value", m.to_value);
        visit("step", m.step);
    }
};

/// rcl_interfaces/msg/IntegerRange
struct IntegerRange {
    static constexpr const char* kName = "rcl_interfaces/msg/IntegerRange";
    std::int64_t from_value = 0;  ///< least
    std::int64_t to_value = 0;    ///< most
    std::uint64_t step = 0;       ///< 0: any between

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("from_value", m.from_value);
        visit("to_value", m.to_value);
        visit("step", m.step);
    }
};

/// rcl_interfaces/msg/ParameterDescriptor
struct ParameterDescriptor {
    static constexpr const char* kName = "rcl_interfaces/msg/ParameterDescriptor";
    std::string name;                                     ///< in its node
    std::uint8_t type = 0;                                ///< ParameterType
    std::string description;                              ///< for people
    std::string additional_constraints;                   ///< for people
    bool read_only = false;                               ///< it cannot be set
    bool dynamic_typing = false;                          ///< its type may change
    Bounded<FloatingPointRange, 1> floating_point_range;  ///< of numbers
    Bounded<IntegerRange, 1> integer_range;               ///< of integers

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("name", m.name);
        visit("type", m.type);
        visit("description", m.description);
        visit("additional_constraints", m.additional_constraints);
        visit("read_only", m.read_only);
        visit("dynamic_typing", m.dynamic_typing);
        visit("floating_point_range", m.floating_point_range);
        visit("integer_range", m.integer_range);
    }
};

/// rcl_interfaces/msg/SetParametersResult
struct SetParametersResult {
    static constexpr const char* kName = "rcl_interfaces/msg/SetParametersResult";
    bool successful = false;  ///< it was set
    std::string reason;       ///< why not

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("successful", m.successful);
        visit("reason", m.reason);
    }
};

/// rcl_interfaces/msg/ListParametersResult
struct ListParametersResult {
    static constexpr const char* kName = "rcl_interfaces/msg/ListParametersResult";
    std::vector<std::string> names;     ///< of parameters
    std::vector<std::string> prefixes;  ///< of these names, up to the last dot

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("names", m.names);
        visit("prefixes", m.prefixes);
    }
};

/// rcl_interfaces/msg/ParameterEvent
struct ParameterEvent {
    static constexpr const char* kName = "rcl_interfaces/msg/ParameterEvent";
    Time stamp;                                 ///< when
    std::string node;                           ///< full name
    std::vector<Parameter> new_parameters;      ///< that the node got
    std::vector<Parameter> changed_parameters;  ///< with their new values
    std::vector<Parameter> deleted_parameters;  ///< with their last values

    /// Calls visit(name, value) for each field, always in the same order.
    template <class Visitor, class Self>
    static void fields(Visitor&& visit, Self& m) {
        visit("stamp", m.stamp);
        visit("node", m.node);
        visit("new_parameters", m.new_parameters);
        visit("changed_parameters", m.changed_parameters);
        visit("deleted_parameters", m.deleted_parameters);
    }
};

}  // namespace roboss::ros2::rcl_interfaces
