// Messages of Gazebo in protobuf's text format, as plugins write them: `linear: {x: 3}`, `data: true`. They
// become a flat list of fields.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace roboss::sdf_import {

/// A field that is set. Names of nested fields are joined by "_": "linear_x". Elements of a repeated field
/// are numbered: "data_0". An entry of a map (`data {key: "state" value: "1"}` of a header) is named by its
/// key.
struct MessageField {
    std::string name;      ///< see above
    double number = 0;     ///< true is 1, false 0
    bool is_text = false;  ///< whether `text` counts
    std::string text;      ///< quoted text or name of an enumerator
};

/// What is known of a type of message.
struct MessageType {
    const char* name;    ///< without "gz.msgs."
    const char* fields;  ///< all that are single values, "a|b"; "": none, or only those that are named count
};

/// The type "gz.msgs.X" (or "ignition.msgs.X"); nullptr: it is not known.
const MessageType* find_message_type(std::string_view written);

/// The fields of a message of this type; nullopt: the text is malformed.
std::optional<std::vector<MessageField>> parse_message(std::string_view text, const MessageType& type);

/// The fields that `value` sets below the field "a.b" of a message; nullopt: malformed.
std::optional<std::vector<MessageField>> parse_field(const std::string& path, const std::string& value,
                                                     const MessageType& type);

}  // namespace roboss::sdf_import
