// TypeDescription: what ROS 2 says of a type of messages, so that others know it: its definition as text,
// which recordings carry, and the hash RIHS01 by which two programs find out whether they mean the same type.
// Source: REP 2011 and 2016; numbers of types as in type_description_interfaces/msg/FieldType.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ros2_types/field_types.h"

namespace roboss::ros2 {

/// A field of a type.
struct FieldDescription {
    std::string name;            ///< unique in its type
    std::uint8_t type = 0;       ///< number of the type of one element: kNested, or a primitive
    std::uint8_t container = 0;  ///< kSingle, kArray, kBounded or kSequence
    std::uint64_t capacity = 0;  ///< of an array: how many elements; of a bounded sequence: how many at most
    std::string nested;          ///< name of the type, of kNested
};

/// A type and the types that it consists of.
struct TypeDescription {
    std::string name;                      ///< "std_msgs/msg/Header"
    std::vector<FieldDescription> fields;  ///< in their order
    std::vector<TypeDescription> nested;   ///< all that it consists of, also indirectly, by name, each once
    std::vector<std::string> constants{};  ///< lines of the definition; the hash leaves them out
};

/// Values of FieldDescription::container.
inline constexpr std::uint8_t kSingle = 0, kArray = 48, kBounded = 96, kSequence = 144;
/// Value of FieldDescription::type.
inline constexpr std::uint8_t kNested = 1;

/// "RIHS01_" and 64 hexadecimal digits.
std::string type_hash(const TypeDescription& type);
/// The definition in the format ros2msg: that of the type, then those of the types that it consists of.
std::string definition_text(const TypeDescription& type);

/// "geometry_msgs/msg/Twist" of that or of "geometry_msgs/Twist"; `middle`: "msg" or "srv".
std::string full_type_name(const std::string& type, const std::string& middle = "msg");

/// Adds `part` and what it consists of to type.nested.
void add_nested(TypeDescription& type, TypeDescription part);

/// The line of a constant in a definition: "int8 STATUS_UNKNOWN=0".
std::string constant_line(std::uint8_t type, const char* name, std::int64_t value);

/// The number of a primitive type or of a string; kNested of messages.
template <class T>
constexpr std::uint8_t type_number() {
    if constexpr (Message<T>)
        return kNested;
    else if constexpr (std::is_same_v<T, std::int8_t>)
        return 2;
    else if constexpr (std::is_same_v<T, std::uint8_t>)
        return 3;
    else if constexpr (std::is_same_v<T, std::int16_t>)
        return 4;
    else if constexpr (std::is_same_v<T, std::uint16_t>)
        return 5;
    else if constexpr (std::is_same_v<T, std::int32_t>)
        return 6;
    else if constexpr (std::is_same_v<T, std::uint32_t>)
        return 7;
    else if constexpr (std::is_same_v<T, std::int64_t>)
        return 8;
    else if constexpr (std::is_same_v<T, std::uint64_t>)
        return 9;
    else if constexpr (std::is_same_v<T, float>)
        return 10;
    else if constexpr (std::is_same_v<T, double>)
        return 11;
    else if constexpr (std::is_same_v<T, bool>)
        return 15;
    else if constexpr (std::is_same_v<T, std::byte>)
        return 16;
    else {
        static_assert(std::is_same_v<T, std::string>);
        return 17;
    }
}

/// The description of a message.
template <Message M>
TypeDescription describe() {
    TypeDescription type{M::kName, {}, {}, {}};
    M message;
    M::fields(
        [&]<class T>(const char* name, const T& value) {
            FieldDescription field{name, 0, kSingle, 0, ""};
            const auto set_element = [&]<class E>(const E*) {
                field.type = type_number<E>();
                if constexpr (Message<E>) {
                    field.nested = E::kName;
                    add_nested(type, describe<E>());
                }
            };
            if constexpr (kIsSequence<T>) {
                field.container = kBound<T> > 0 ? kBounded : kSequence, field.capacity = kBound<T>;
                set_element(static_cast<const typename T::value_type*>(nullptr));
            } else if constexpr (kIsArray<T>) {
                field.container = kArray, field.capacity = value.size();
                set_element(static_cast<const typename T::value_type*>(nullptr));
            } else
                set_element(&value);
            type.fields.push_back(std::move(field));
        },
        message);
    if constexpr (requires { M::constants([](const char*, auto) {}); })
        M::constants([&]<class T>(const char* name, T value) {
            type.constants.push_back(constant_line(type_number<T>(), name, value));
        });
    return type;
}

}  // namespace roboss::ros2
